#include "engine/image/image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "engine/base/file.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

class ImageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric-image-test-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Writes raw channels with OpenImageIO itself, as another program would.
  template <class Value>
  fs::path writeForeign(const char* name, int width, int height, int channels,
                        const std::vector<Value>& values) {
    const fs::path path = folder_ / name;
    OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<Value>::value);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    auto output = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(output && output->open(path.string(), spec)) << OIIO::geterror();
    EXPECT_TRUE(output->write_image(OIIO::BaseTypeFromC<Value>::value, values.data()) && output->close());
    return path;
  }

  fs::path folder_;
};

ColourImage randomImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  ColourImage image(width, height);
  for (Rgba8& pixel : image.pixels)
    for (int channel = 0; channel < 4; ++channel) pixel[channel] = static_cast<std::uint8_t>(random() & 255);
  return image;
}

TEST_F(ImageFile, PngKeepsEveryCodeEvenUnderClearAlpha) {
  const ColourImage image = randomImage(37, 19, 1);
  const fs::path path = folder_ / "deeper" / "a.png";
  ASSERT_TRUE(writeColourImage(image, path));
  const auto back = readColourImage(path);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(back->width, 37);
  EXPECT_EQ(back->height, 19);
  EXPECT_EQ(back->pixels, image.pixels);
}

TEST_F(ImageFile, FormatsWithAlphaAndWithout) {
  ColourImage image(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) image.at(x, y) = Rgba8(x * 4, y * 5, 90, 255);
  for (const char* name : {"a.jpg", "a.bmp", "a.tif", "a.tga"}) {
    ASSERT_TRUE(writeColourImage(image, folder_ / name)) << name;
    const auto back = readColourImage(folder_ / name);
    ASSERT_TRUE(back) << back.error().describe();
    double error = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      for (int channel = 0; channel < 4; ++channel)
        error += std::abs(int(image.pixels[i][channel]) - int(back->pixels[i][channel]));
    EXPECT_LT(error / static_cast<double>(image.pixels.size()), std::string(name) == "a.jpg" ? 8.0 : 1e-9)
        << name;
  }
}

TEST_F(ImageFile, GreyAndGreyWithAlphaSpreadToRgba) {
  const auto grey = readColourImage(writeForeign<std::uint8_t>("grey.png", 2, 1, 1, {10, 200}));
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->pixels, (std::vector<Rgba8>{Rgba8(10, 10, 10, 255), Rgba8(200, 200, 200, 255)}));
  const auto pair = readColourImage(writeForeign<std::uint8_t>("pair.png", 2, 1, 2, {10, 128, 200, 0}));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->pixels, (std::vector<Rgba8>{Rgba8(10, 10, 10, 128), Rgba8(200, 200, 200, 0)}));
  const auto rgb = readColourImage(writeForeign<std::uint8_t>("rgb.png", 1, 1, 3, {1, 2, 3}));
  ASSERT_TRUE(rgb);
  EXPECT_EQ(rgb->pixels[0], Rgba8(1, 2, 3, 255));
}

TEST_F(ImageFile, SixteenBitsRoundToEight) {
  const auto image = readColourImage(
      writeForeign<std::uint16_t>("deep.png", 1, 2, 4, {0, 257, 65535, 32896, 128 * 257, 40000, 1, 65535}));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pixels[0], Rgba8(0, 1, 255, 128));
  EXPECT_EQ(image->pixels[1], Rgba8(128, 156, 0, 255));
}

TEST_F(ImageFile, PaletteIsLookedUp) {
  // A 4 x 2 PNG of two bits a pixel: red, green (half clear), blue, grey; then grey and three reds.
  constexpr std::array<unsigned char, 107> kPng = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
      0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x00, 0x02, 0x02, 0x03, 0x00, 0x00, 0x00, 0x02, 0xc6, 0x95,
      0xf0, 0x00, 0x00, 0x00, 0x0c, 0x50, 0x4c, 0x54, 0x45, 0xff, 0x00, 0x00, 0x00, 0xff, 0x00, 0x00,
      0x00, 0xff, 0x5a, 0x5b, 0x5c, 0xa1, 0x07, 0x74, 0xc2, 0x00, 0x00, 0x00, 0x02, 0x74, 0x52, 0x4e,
      0x53, 0xff, 0x80, 0x08, 0x0f, 0xb3, 0x6a, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
      0x9c, 0x63, 0x90, 0x66, 0x38, 0x00, 0x00, 0x01, 0x15, 0x00, 0xdc, 0xeb, 0x8e, 0x55, 0xd3, 0x00,
      0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const auto image = decodeColourImage(std::as_bytes(std::span(kPng)), "palette");
  ASSERT_TRUE(image) << image.error().describe();
  const Rgba8 red(255, 0, 0, 255), grey(90, 91, 92, 255);
  EXPECT_EQ(image->pixels, (std::vector<Rgba8>{red, Rgba8(0, 255, 0, 128), Rgba8(0, 0, 255, 255), grey, grey,
                                               red, red, red}));
}

TEST_F(ImageFile, FloatingPointPicturesAreEncoded) {
  const auto image =
      readColourImage(writeForeign<float>("f.exr", 1, 2, 4, {0.5f, 0, 4, 1, 0.25f, 0.1f, 0, 0.5f}));
  ASSERT_TRUE(image) << image.error().describe();
  EXPECT_EQ(image->pixels[0], Rgba8(188, 0, 255, 255));
  EXPECT_EQ(image->pixels[1], Rgba8(188, 124, 0, 128)) << "EXR colours are premultiplied; ours are straight";
}

TEST_F(ImageFile, BytesDecideTheFormatNotTheName) {
  const ColourImage image = randomImage(8, 8, 5);
  ASSERT_TRUE(writeColourImage(image, folder_ / "a.png"));
  fs::rename(folder_ / "a.png", folder_ / "a.jpg");
  const auto back = readColourImage(folder_ / "a.jpg");
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(back->pixels, image.pixels);
  const auto bytes = readFile(folder_ / "a.jpg");
  ASSERT_TRUE(bytes);
  const auto nameless = decodeColourImage(*bytes, "image 3");
  ASSERT_TRUE(nameless);
  EXPECT_EQ(nameless->pixels, image.pixels);
}

TEST_F(ImageFile, PicturesAboveTheLimitAreRefusedByTheirHeader) {
  ASSERT_TRUE(writeColourImage(ColourImage(100, 100), folder_ / "a.png"));
  const auto refused = readColourImage(folder_ / "a.png", 9999);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::tooLarge);
  EXPECT_TRUE(readColourImage(folder_ / "a.png", 10000));
}

TEST_F(ImageFile, WhatIsNoPictureIsRefusedByName) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.png", "this is no picture"));
  const auto noise = readColourImage(folder_ / "a.png");
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().kind, ErrorKind::unsupported);
  EXPECT_NE(noise.error().describe().find("a.png"), std::string::npos);
  EXPECT_EQ(readColourImage(folder_ / "none.png").error().kind, ErrorKind::notFound);
  EXPECT_FALSE(decodeColourImage({}, "empty"));
  EXPECT_FALSE(writeColourImage(ColourImage(), folder_ / "b.png"));
  const Status strange = writeColourImage(ColourImage(2, 2), folder_ / "b.nonsense");
  ASSERT_FALSE(strange);
  EXPECT_EQ(strange.error().kind, ErrorKind::unsupported);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing half-written stays";
}

TEST_F(ImageFile, DamagedPicturesNeverCrash) {
  const ColourImage image = randomImage(40, 30, 9);
  std::mt19937 random(2);
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.bmp", "a.tga"}) {
    ASSERT_TRUE(writeColourImage(image, folder_ / name));
    const auto sound = readFile(folder_ / name);
    ASSERT_TRUE(sound);
    for (int round = 0; round < 150; ++round) {
      auto bytes = *sound;
      if (round % 3 == 0) bytes.resize(random() % bytes.size());
      // The first bytes hold the sizes; damage them more often.
      for (int flips = 0; flips < 4 && !bytes.empty(); ++flips)
        bytes[random() % (round % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 64))] ^=
            std::byte(1u << (random() % 8));
      const auto read = decodeColourImage(bytes, name, 1 << 16);
      if (read) {
        EXPECT_EQ(read->pixels.size(),
                  static_cast<std::size_t>(read->width) * static_cast<std::size_t>(read->height));
        EXPECT_LE(read->pixels.size(), std::size_t(1) << 16);
      } else {
        EXPECT_NE(read.error().describe().find(name), std::string::npos);
      }
    }
  }
}

TEST_F(ImageFile, FloatImagesOpenAsOpenExr) {
  FloatImage image(3, 2);
  image.pixels = {0, 1.5f, -2, 1e30f, 0.1f, 7};
  ASSERT_TRUE(writeFloatImage(image, folder_ / "z.exr", "Z"));
  auto input = OIIO::ImageInput::open((folder_ / "z.exr").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().channelnames, std::vector<std::string>{"Z"});
  std::vector<float> back(6);
  ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_EQ(back, image.pixels);
  EXPECT_FALSE(writeFloatImage(image, folder_ / "z.png", "Z"));
  EXPECT_FALSE(writeFloatImage(FloatImage(), folder_ / "e.exr", "Z"));
}

TEST(SceneTextures, EveryPictureOfTheSharedScenesIsRead) {
  const char* given = std::getenv("ACENTRIC_SCENES");
  const fs::path root = given ? fs::path(given) : fs::path(ACENTRIC_SOURCE_DIR) / "../shared/scenes";
  if (!fs::is_directory(root)) GTEST_SKIP() << "no scenes at " << root << "; set ACENTRIC_SCENES";
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (entry.path().string().find("malformed") != std::string::npos ||
        (extension != ".png" && extension != ".jpg"))
      continue;
    if (++read > 12) break;  // enough kinds; reading all would be slow under sanitizers
    const auto image = readColourImage(entry.path());
    EXPECT_TRUE(image) << image.error().describe();
  }
  EXPECT_GT(read, 0);
}

TEST_F(ImageFile, PanoramasAreWhatOtherProgramsTakeForThem) {
  LinearImage radiance(4, 2, glm::vec3(0.25F, 2, 1e9F));
  FloatImage distance(4, 2, 3.14159F);
  radiance.at(3, 1) = {0.5F, 0, 0};
  distance.at(0, 1) = std::numeric_limits<float>::infinity();
  const fs::path file = folder_ / "all_around.exr";
  const Status written = writePanorama(radiance, distance, file);
  ASSERT_TRUE(written) << written.error().describe();

  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input) << OIIO::geterror();
  const OIIO::ImageSpec spec = input->spec();
  EXPECT_EQ(spec.channelnames, (std::vector<std::string>{"R", "G", "B", "Z"}));
  ASSERT_EQ(spec.channelformats.size(), 4U);
  EXPECT_EQ(spec.channelformats[0], OIIO::TypeDesc::HALF);
  EXPECT_EQ(spec.channelformats[3], OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec.get_string_attribute("textureformat"), "LatLong Environment");
  std::vector<float> values(4 * 8);
  ASSERT_TRUE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, values.data()));
  const auto at = [&](int x, int y, int channel) { return values[std::size_t((y * 4 + x) * 4 + channel)]; };
  EXPECT_EQ(at(0, 0, 0), 0.25F);
  EXPECT_EQ(at(0, 0, 1), 2.0F);
  EXPECT_EQ(at(0, 0, 2), 65504.0F) << "the largest half, not infinity";
  EXPECT_EQ(at(3, 1, 0), 0.5F);
  EXPECT_EQ(at(3, 1, 3), 3.14159F);
  EXPECT_TRUE(std::isinf(at(0, 1, 3)));

  EXPECT_FALSE(writePanorama(radiance, distance, folder_ / "all_around.png"));
}

}  // namespace
}  // namespace acentric
