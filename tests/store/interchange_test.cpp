/// The OpenEXR files as another program sees them: through OpenImageIO, which knows nothing of captures.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <map>

#include "engine/store/capture_exr.h"
#include "engine/store/capture_store.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class Interchange : public FolderTest {
 protected:
  std::unique_ptr<OIIO::ImageInput> writeAndOpen(const Capture& capture) {
    const auto path = folder_ / "c.exr";
    const Status written = writeCaptureExr(capture, {7, 9}, path);
    EXPECT_TRUE(written);
    auto input = OIIO::ImageInput::open(path.string());
    EXPECT_TRUE(input) << OIIO::geterror();
    return input;
  }
};

std::map<std::string, int> channelNumbers(const OIIO::ImageSpec& spec) {
  std::map<std::string, int> numbers;
  for (int c = 0; c < spec.nchannels; ++c) numbers[spec.channelnames[static_cast<std::size_t>(c)]] = c;
  return numbers;
}

double rayDistanceOf(const ColumnCamera& camera, const CaptureSamples& samples, std::size_t sample) {
  const double t = camera.tangentAt(samples.row[sample] + 0.5);
  return std::sqrt(1 + t * t) / static_cast<double>(samples.inverseDistance[sample]);
}

void expectAttributes(const OIIO::ImageSpec& spec, const ColumnCamera& camera) {
  EXPECT_EQ(spec.width, camera.columns);
  EXPECT_EQ(spec.height, camera.rows);
  EXPECT_EQ(spec.get_int_attribute("acentricVersion"), 4);
  EXPECT_EQ(spec.get_string_attribute("acentricKey"), "00000000000000070000000000000009");
  double centre[3] = {0, 0, 0}, fov = 0;
  EXPECT_TRUE(spec.getattribute("acentricCentreOfProjection",
                                OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE, OIIO::TypeDesc::VEC3), centre));
  EXPECT_EQ(glm::dvec3(centre[0], centre[1], centre[2]), camera.centreOfProjection);
  EXPECT_TRUE(spec.getattribute("acentricFov", OIIO::TypeDesc::DOUBLE, &fov));
  EXPECT_EQ(fov, camera.fovRadians);
}

TEST_F(Interchange, FlatFilesOpenElsewhereUnmirrored) {
  const Capture capture = syntheticCapture({20, 16, false, true, 1});
  auto input = writeAndOpen(capture);
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_FALSE(spec.deep);
  expectAttributes(spec, capture.camera);
  auto channel = channelNumbers(spec);
  for (const char* name : {"R", "G", "B", "A", "Z", "W"}) ASSERT_TRUE(channel.contains(name)) << name;
  const std::size_t n = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> pixels(static_cast<std::size_t>(spec.width * spec.height) * n);
  ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));

  const CaptureSamples all = withBackground(capture, capture.colour);
  int empty = 0, sky = 0;
  for (int x = 0; x < spec.width; ++x) {
    const int column = spec.width - 1 - x;  // column 0 is the most clockwise, so the rightmost
    std::size_t next = all.columnStart[static_cast<std::size_t>(column)];
    for (int y = 0; y < spec.height; ++y) {
      const float* pixel = &pixels[static_cast<std::size_t>(y * spec.width + x) * n];
      const float z = pixel[channel["Z"]], w = pixel[channel["W"]];
      if (next == all.columnStart[static_cast<std::size_t>(column) + 1] || all.row[next] != y) {
        ++empty;
        EXPECT_EQ(pixel[channel["A"]], 0);
        EXPECT_EQ(w, -1);
        EXPECT_TRUE(std::isinf(z));
        continue;
      }
      const glm::vec4 colour = unpackColour(all.colour[next]);
      EXPECT_EQ(glm::vec4(pixel[channel["R"]], pixel[channel["G"]], pixel[channel["B"]], pixel[channel["A"]]),
                colour);
      EXPECT_EQ(w, all.inverseDistance[next]);
      if (w == 0) {
        ++sky;
        EXPECT_TRUE(std::isinf(z));
      } else {
        EXPECT_NEAR(z, rayDistanceOf(capture.camera, all, next), 1e-6 * static_cast<double>(z));
      }
      ++next;
    }
  }
  EXPECT_GT(empty, 0);
  EXPECT_GT(sky, 0);
}

TEST_F(Interchange, DeepFilesOpenElsewhereNearestFirst) {
  const Capture capture = syntheticCapture({20, 16, true, true, 2});
  ASSERT_GT(capture.maxLayers(), 1);
  auto input = writeAndOpen(capture);
  ASSERT_TRUE(input);
  const OIIO::ImageSpec spec = input->spec();
  EXPECT_TRUE(spec.deep);
  expectAttributes(spec, capture.camera);
  OIIO::DeepData deep;
  ASSERT_TRUE(input->read_native_deep_image(0, 0, deep));
  auto channel = channelNumbers(spec);
  std::vector<HalfColour> colours;
  for (const HalfColour& colour : capture.colour) colours.push_back(premultiplied(colour));
  const CaptureSamples all = withBackground(capture, colours);
  std::size_t seen = 0;
  for (int x = 0; x < spec.width; ++x) {
    std::size_t next = all.columnStart[static_cast<std::size_t>(spec.width - 1 - x)];
    for (int y = 0; y < spec.height; ++y) {
      const int pixel = y * spec.width + x;
      float last = 0;
      for (int s = 0; s < deep.samples(pixel); ++s, ++next, ++seen) {
        ASSERT_LT(next, all.sampleCount());
        ASSERT_EQ(all.row[next], y);
        const glm::vec4 colour = unpackColour(all.colour[next]);
        const auto value = [&](const char* name) { return deep.deep_value(pixel, channel[name], s); };
        EXPECT_EQ(value("W"), all.inverseDistance[next]);
        EXPECT_EQ(value("A"), colour.a);
        EXPECT_EQ(value("R"), colour.r) << "colour is premultiplied";
        EXPECT_GE(value("Z"), last) << "nearest first";
        last = value("Z");
      }
    }
  }
  EXPECT_EQ(seen, all.sampleCount());
}

TEST_F(Interchange, ReflectionsAreAPartOfTheirOwn) {
  const Capture capture = syntheticCapture({20, 16, true, true, 2, true});
  auto input = writeAndOpen(capture);
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("oiio:subimagename"), "surfaces");
  expectAttributes(input->spec(), capture.camera);
  ASSERT_TRUE(input->seek_subimage(1, 0));
  const OIIO::ImageSpec spec = input->spec();
  EXPECT_EQ(spec.get_string_attribute("oiio:subimagename"), "reflections");
  OIIO::DeepData deep;
  ASSERT_TRUE(input->read_native_deep_image(1, 0, deep));
  auto channel = channelNumbers(spec);
  const CaptureSamples& shown = capture.reflections;
  std::size_t seen = 0;
  for (int x = 0; x < spec.width; ++x) {
    std::size_t next = shown.columnStart[static_cast<std::size_t>(spec.width - 1 - x)];
    for (int y = 0; y < spec.height; ++y) {
      const int pixel = y * spec.width + x;
      for (int s = 0; s < deep.samples(pixel); ++s, ++next, ++seen) {
        ASSERT_LT(next, shown.sampleCount());
        ASSERT_EQ(shown.row[next], y);
        EXPECT_EQ(deep.deep_value(pixel, channel["W"], s), shown.inverseDistance[next]);
        EXPECT_EQ(deep.deep_value(pixel, channel["R"], s), unpackColour(shown.colour[next]).r);
        EXPECT_EQ(deep.deep_value_uint(pixel, channel["mirror"], s), shown.mirror[next]);
      }
    }
  }
  EXPECT_EQ(seen, shown.sampleCount());
  EXPECT_FALSE(input->seek_subimage(2, 0));
}

}  // namespace
}  // namespace acentric
