/// Captures as stores keep them: colours as pictures, everything else bit for bit.

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "engine/base/file.h"
#include "engine/image/colour.h"
#include "engine/image/plane_numbers.h"
#include "engine/store/capture_store.h"
#include "engine/store/colour_picture.h"
#include "engine/store/deep_colours.h"
#include "engine/store/distance_model.h"
#include "engine/store/sample_coder.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

const ContentKey kPackKey{5, 6};
constexpr int kQuality = kUsualColourQuality;

/// Colours that change slowly over the picture, from dark to ten times white; deeper layers have others.
Capture smoothly(Capture capture) {
  const auto paint = [&](CaptureSamples& samples) {
    for (std::size_t k = 0; k + 1 < samples.columnStart.size(); ++k)
      for (std::size_t i = samples.columnStart[k]; i < samples.columnStart[k + 1]; ++i) {
        const float x = float(k) / 40, y = float(samples.row[i]) / 30;
        const float light = 0.02f + 0.5f * (1 + std::sin(x)) * (1 + std::cos(y));
        const float scale = samples.row[i] < 20 ? 10.0f : 1.0f;
        const std::uint16_t alpha = samples.colour[i].a;
        samples.colour[i] = packColour({scale * light, light * 0.7f, 0.3f, 1});
        samples.colour[i].a = alpha;
      }
  };
  paint(capture), paint(capture.reflections);
  return capture;
}

/// As displayed, over all samples of both lists.
double psnr(const Capture& a, const Capture& b, float exposure = 1) {
  double squares = 0, count = 0;
  const auto add = [&](const CaptureSamples& x, const CaptureSamples& y) {
    for (std::size_t i = 0; i < x.sampleCount(); ++i) {
      const glm::vec3 second(unpackColour(y.colour[i]));
      const glm::vec3 p = toneMap(glm::vec3(unpackColour(x.colour[i])), exposure),
                      q = b.shown ? second : toneMap(second, exposure);
      for (int c = 0; c < 3; ++c, ++count)
        squares += std::pow(double(srgbFromLinear(p[c])) - double(srgbFromLinear(q[c])), 2);
    }
  };
  add(a, b), add(a.reflections, b.reflections);
  return -10 * std::log10(std::max(squares / std::max(count, 1.0), 1e-12));
}

/// With the colours of another, its own alpha.
Capture withColoursOf(Capture capture, const Capture& other) {
  const auto take = [](CaptureSamples& to, const CaptureSamples& from) {
    for (std::size_t i = 0; i < to.sampleCount(); ++i)
      to.colour[i] = {from.colour[i].r, from.colour[i].g, from.colour[i].b, to.colour[i].a};
  };
  take(capture, other), take(capture.reflections, other.reflections);
  return capture;
}

class CodedPack : public FolderTest {
 protected:
  fs::path file() const { return folder_ / "c.pack"; }
  Result<Capture> thereAndBack(const Capture& capture, int quality) const {
    const Status written = writeCodedPack(capture, kPackKey, file(), quality);
    EXPECT_TRUE(written) << written.error().describe();
    return readCapturePack(file());
  }
};

std::vector<Capture> everyShape() {
  std::vector<Capture> captures;
  for (const bool mirrors : {false, true})
    for (const SyntheticOptions& options :
         {SyntheticOptions{48, 40, false, false, 2, mirrors},
          SyntheticOptions{48, 40, true, true, 3, mirrors}, SyntheticOptions{1, 1, false, false, 4, mirrors},
          SyntheticOptions{1, 33, true, false, 5, mirrors},
          SyntheticOptions{300, 260, true, true, 6, mirrors}}) {
      captures.push_back(smoothly(syntheticCapture(options)));
      captures.push_back(withSilhouettes(captures.back()));
    }
  return captures;
}

TEST_F(CodedPack, KeepsAllButColoursBitForBitAndColoursClosely) {
  for (const Capture& capture : everyShape()) {
    ASSERT_TRUE(capture.check()) << capture.check().error().describe();
    const auto back = thereAndBack(capture, kQuality);
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(withColoursOf(*back, capture), capture);
    if (capture.sampleCount() > 100) {
      EXPECT_GT(psnr(capture, *back), 40);
    }
    const auto exact = thereAndBack(capture, kLosslessColours);
    ASSERT_TRUE(exact) << exact.error().describe();
    EXPECT_EQ(*exact, capture);
  }
}

TEST_F(CodedPack, KeepsDistancesThatNoStepDivides) {
  Capture capture = syntheticCapture({4, 8, false, false, 1});
  const double odd[] = {7.5, 1e-38, 1e-40, 1e-4, 3.3e38, 1000, 1 + 0x1p-15, 1.0 / 3};
  for (const double step : {0.0, 1.0 / (1 << 14), 0.3}) {
    capture.distanceStep = step;
    for (std::size_t i = 0; i < capture.sampleCount(); ++i)
      capture.inverseDistance[i] = storedInverseDistance(odd[i % 8], 0);
    const auto back = thereAndBack(capture, kLosslessColours);
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(*back, capture);
  }
}

TEST_F(CodedPack, KeepsEveryDistanceOfAStep) {
  Capture capture = syntheticCapture({64, 64, false, false, 1});
  std::mt19937 random(3);
  capture.distanceStep = 0x1p-10;
  for (float& w : capture.inverseDistance)
    w = storedInverseDistance(std::exp2(double(random() % 400) / 10 - 20), capture.distanceStep);
  ASSERT_GT(codedStep(capture, capture.distanceStep), 0);
  const auto back = thereAndBack(capture, kLosslessColours);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, capture);
}

/// A wall and a floor, whose samples lie on them.
Capture wallAndFloor() {
  Capture capture = syntheticCapture({200, 160, false, false, 1});
  const glm::vec3 wall(0.15f * std::cos(0.8f), 0.15f * std::sin(0.8f), 0), floor(0, 0, -1 / 1.6f);
  capture.planes = {{wall}, {floor}};
  std::ranges::fill(capture.roles, std::uint8_t(1));
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k)
    for (std::size_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i) {
      const auto on = [&](std::uint32_t plane) {
        return capture.planes[plane].inverseDistance(capture.camera.directionAt(double(k) + 0.5),
                                                     capture.camera.tangentAt(capture.row[i] + 0.5));
      };
      const std::uint32_t nearer = on(1) > on(0) ? 1 : 0;
      capture.plane.push_back(nearer);
      capture.coverage.push_back(kWholePixel);
      capture.inverseDistance[i] = storedInverseDistance(on(nearer), capture.distanceStep);
    }
  capture.planeTolerance = 1.0 / (1 << 12);
  return capture;
}

std::size_t streamBytes(const Capture& capture) {
  const SampleShape shape{capture.camera, capture.sampleCount(), false, capture.planes.size(),
                          codedStep(capture, capture.distanceStep)};
  return codeSamples(capture, shape).size();
}

TEST_F(CodedPack, TakesNextToNothingForSamplesThatLieOnTheirPlanes) {
  const Capture capture = wallAndFloor();
  const auto back = thereAndBack(capture, kLosslessColours);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, capture);
  EXPECT_LT(streamBytes(capture), capture.sampleCount() / 50);
}

TEST_F(CodedPack, KeepsWhatPlanesForetellBadly) {
  Capture capture = wallAndFloor();
  capture.planes[0].normal *= -1;     // behind the camera
  capture.planes[1].normal *= 1e30f;  // in its eye
  for (std::size_t i = 0; i < capture.sampleCount(); i += 7) capture.plane[i] ^= 1u;
  for (const double step : {capture.distanceStep, 0.0}) {
    capture.distanceStep = step;
    const auto back = thereAndBack(capture, kLosslessColours);
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(*back, capture);
  }
}

TEST_F(CodedPack, KeepsPlanesInWhicheverOrderTheyAreNumbered) {
  std::mt19937 random(5);
  for (Capture capture : everyShape()) {
    for (CaptureSamples* list : {static_cast<CaptureSamples*>(&capture), &capture.reflections}) {
      if (!list->hasSilhouettes()) continue;
      for (int k = 0; k < 3; ++k) list->planes.insert(list->planes.begin(), {{0.5f, float(k), -1}, 1});
      std::vector<std::uint32_t> numbers(list->planes.size());
      for (std::uint32_t k = 0; k < numbers.size(); ++k) numbers[k] = k;
      std::ranges::shuffle(numbers, random);
      const std::vector<SurfacePlane> before = list->planes;
      for (std::size_t k = 0; k < before.size(); ++k) list->planes[numbers[k]] = before[k];
      for (std::uint32_t& plane : list->plane) plane = numbers[plane + 3];
    }
    const auto back = thereAndBack(capture, kLosslessColours);
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(*back, capture);
  }
}

/// A ball of small facets, each seen in a pixel or two.
Capture facets() {
  Capture capture = wallAndFloor();
  capture.planes.clear();
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k)
    for (std::size_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i) {
      const double tilt = 0.5 * std::sin(double(k) / 30), lean = 0.5 * std::cos(capture.row[i] / 20.0);
      const double azimuth = capture.camera.azimuthAt(double(k) + 0.5) + tilt;
      const double tangent = capture.camera.tangentAt(capture.row[i] + 0.5);
      glm::dvec3 normal(std::cos(azimuth), std::sin(azimuth), lean);
      const glm::dvec2 direction = capture.camera.directionAt(double(k) + 0.5);
      normal *= double(capture.inverseDistance[i]) / glm::dot(normal, glm::dvec3(direction, tangent));
      capture.plane[i] = std::uint32_t(capture.planes.size());
      capture.planes.push_back({glm::vec3(normal)});
    }
  return capture;
}

TEST_F(CodedPack, TakesThreeBytesForThePlaneOfASmallFacet) {
  Capture capture = facets();
  roundPlanes(capture, capture.camera, capture.distanceStep);
  EXPECT_LT(streamBytes(capture), 3 * capture.planes.size());
  const auto back = thereAndBack(capture, kLosslessColours);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, capture);
}

/// Glass that looks different to each region has samples on one plane in each pixel, one after the other.
TEST_F(CodedPack, TakesNoMoreForSamplesOnThePlaneOfTheOneBefore) {
  const Capture once = wallAndFloor();
  Capture twice = once;
  static_cast<CaptureSamples&>(twice) = {};
  twice.planes = once.planes, twice.columnStart = {0};
  for (std::size_t k = 0; k + 1 < once.columnStart.size(); ++k) {
    for (std::size_t i = once.columnStart[k]; i < once.columnStart[k + 1]; ++i)
      for (int look = 0; look < 2; ++look) {
        twice.row.push_back(once.row[i]), twice.inverseDistance.push_back(once.inverseDistance[i]);
        twice.colour.push_back(packColour({0.5f, 0.5f, 0.5f, 0.25f}));
        twice.roles.push_back(std::uint8_t(1 << look));
        twice.coverage.push_back(once.coverage[i]), twice.plane.push_back(once.plane[i]);
      }
    twice.columnStart.push_back(std::uint32_t(twice.sampleCount()));
  }
  const auto back = thereAndBack(twice, kLosslessColours);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, twice);
  EXPECT_LT(streamBytes(twice), once.sampleCount() / 40);
}

TEST_F(CodedPack, IsAsTrueAsItsQualityAndAsSmall) {
  Capture capture = smoothly(syntheticCapture({300, 260, true, false, 6}));
  std::ranges::fill(capture.roles, std::uint8_t(3));  // as in a bake, where they change at borders of regions
  double before = 0;
  std::uintmax_t bytes = 0;
  for (const int quality : {0, 50, 90, 99}) {
    const auto back = thereAndBack(capture, quality);
    ASSERT_TRUE(back);
    EXPECT_GT(psnr(capture, *back), before) << quality;
    EXPECT_GE(fs::file_size(file()), bytes) << quality;
    before = psnr(capture, *back), bytes = fs::file_size(file());
  }
  EXPECT_GT(before, 50);
  const auto best = thereAndBack(capture, 99);
  for (const float exposure : {0.25f, 4.0f}) EXPECT_GT(psnr(capture, *best, exposure), 42) << exposure;
  ASSERT_TRUE(thereAndBack(capture, kQuality));
  const std::uintmax_t usual = fs::file_size(file());
  ASSERT_TRUE(thereAndBack(capture, kLosslessColours));
  EXPECT_LT(usual, fs::file_size(file()));
  EXPECT_LT(fs::file_size(file()), 15 * capture.sampleCount())
      << "row, distance, colour and roles as they are";
}

TEST_F(CodedPack, IsTheSameBytesEachTime) {
  const Capture capture = smoothly(syntheticCapture({300, 260, true, true, 6, true}));
  ASSERT_TRUE(writeCodedPack(capture, kPackKey, file(), kQuality));
  const auto first = readFile(file());
  ASSERT_TRUE(writeCodedPack(capture, kPackKey, file(), kQuality));
  EXPECT_EQ(*first, *readFile(file()));
}

TEST_F(CodedPack, StoppedIsNotThere) {
  std::stop_source stop;
  stop.request_stop();
  const Status written = writeCodedPack(syntheticCapture({}), kPackKey, file(), kQuality, stop.get_token());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::cancelled);
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// Gives changed bytes the checksum that they need to be believed.
void seal(std::vector<std::byte>& pack) {
  const std::size_t checked = pack.size() - 16;
  const std::uint64_t fileBytes = pack.size();
  std::memcpy(pack.data() + 32, &fileBytes, sizeof fileBytes);
  const ContentKey checksum = Hasher().bytes(pack.data(), checked).finish();
  std::memcpy(pack.data() + checked, &checksum.high, 8);
  std::memcpy(pack.data() + checked + 8, &checksum.low, 8);
}

TEST_F(CodedPack, ForgedIsRefusedOrACapture) {
  std::mt19937 random(31);
  for (const int quality : {kQuality, kLosslessColours}) {
    ASSERT_TRUE(writeCodedPack(withSilhouettes(syntheticCapture({32, 24, true, true, 1, true})), kPackKey,
                               file(), quality));
    const auto sound = readFile(file()).value();
    constexpr std::size_t kHead = 56 + 199 + 8 * 7;
    int refused = 0;
    for (int round = 0; round < 600; ++round) {
      auto bytes = sound;
      const std::size_t checked = bytes.size() - 16;
      const std::size_t at = round % 2 ? 32 + random() % (kHead - 32) : kHead + random() % (checked - kHead);
      const std::byte values[] = {std::byte(0), std::byte(0xff), std::byte(0x7f),
                                  bytes[at] ^ std::byte(1u << (random() % 8))};
      bytes[at] = values[random() % 4];
      seal(bytes);
      writeQuickly(file(), bytes);
      const auto read = readCapturePack(file());
      if (read) {
        EXPECT_TRUE(read->check());
        continue;
      }
      ++refused;
      EXPECT_TRUE(read.error().kind == ErrorKind::malformed || read.error().kind == ErrorKind::unsupported)
          << read.error().describe();
    }
    EXPECT_GT(refused, 200);
  }
}

TEST_F(CodedPack, OfAHugeEmptyPictureIsRefusedUnlessItsFileIsAsLarge) {
  ASSERT_TRUE(writeCodedPack(syntheticCapture({32, 24, false, true, 1}), kPackKey, file(), kLosslessColours));
  auto bytes = readFile(file()).value();
  const std::uint32_t huge = 65535;
  std::memcpy(bytes.data() + 56 + 64, &huge, 4);  // columns
  std::memcpy(bytes.data() + 56 + 68, &huge, 4);  // rows
  seal(bytes);
  writeQuickly(file(), bytes);
  const auto read = readCapturePack(file());
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, testing::HasSubstr("contradicts its size"));
}

TEST_F(CodedPack, OfDisplaysShowsWhatTheCaptureDoesAtItsExposure) {
  for (const Capture& shape : everyShape())
    for (const float exposure : {1.0f, 2.5f}) {
      const Capture capture = smoothly(shape);
      ASSERT_TRUE(writeDisplayPack(capture, kPackKey, file(), kQuality, exposure));
      const auto back = readCapturePack(file());
      ASSERT_TRUE(back) << back.error().describe();
      ASSERT_TRUE(back->shown);
      Capture expected = withColoursOf(capture, *back);
      expected.shown = true;
      EXPECT_EQ(expected, *back);
      EXPECT_GT(psnr(capture, *back, exposure), 38);
    }
}

TEST_F(CodedPack, OfDisplaysHasPictures) {
  ASSERT_TRUE(writeDisplayPack(smoothly(everyShape().front()), kPackKey, file(), kQuality, 1));
  std::vector<std::byte> bytes = *readFile(file());
  bytes[56 + 124] = std::byte(kLosslessColours);
  seal(bytes);
  writeQuickly(file(), bytes);
  const auto read = readCapturePack(file());
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, testing::HasSubstr("makes no sense"));
}

TEST(ColourCodes, AreWithinAPartOfAnEighthBitCodeAndCoverAllThatHalvesHold) {
  const ColourCoder coder(ColourScale::radiance);
  for (std::uint16_t half = 0; half < 0x7c00; half = std::uint16_t(half + 7)) {
    const float radiance = floatFromHalf(half);
    const HalfColour back = coder.colourOf(coder.codesOf(HalfColour(half, half, half, 0x3c00)));
    const float grey = floatFromHalf(back.g);
    if (radiance <= 1) {
      ASSERT_NEAR(srgbFromLinear(grey), srgbFromLinear(radiance), 0.6 / 271) << radiance;
    } else {
      ASSERT_NEAR(grey / radiance, 1, 0.012) << radiance;
    }
  }
  const HalfColour red = packColour({4, 0.1f, 0.02f, 1});
  const glm::vec4 back = unpackColour(coder.colourOf(coder.codesOf(red)));
  EXPECT_NEAR(back.r, 4, 0.06);
  EXPECT_NEAR(back.g, 0.1, 0.01);
  EXPECT_NEAR(back.b, 0.02, 0.01);
}

TEST(ColourCodes, OfDisplaysAreShownWithinACode) {
  for (const float exposure : {0.25f, 1.0f, 8.0f}) {
    const ColourCoder coder(ColourScale::display, exposure);
    for (float bright = 0.01f; bright < 60; bright *= 1.3f)
      for (const glm::vec3& tint : {glm::vec3(1), glm::vec3(1, 0.5f, 0.2f), glm::vec3(0.05f, 0.3f, 1)}) {
        const HalfColour colour = packColour(glm::vec4(bright * tint, 1));
        const glm::vec3 shown = toneMap(glm::vec3(unpackColour(colour)), exposure),
                        back = glm::vec3(unpackColour(coder.colourOf(coder.codesOf(colour))));
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(srgbFromLinear(back[c]), srgbFromLinear(shown[c]), 1.6 / 255) << bright << ' ' << c;
      }
  }
}

std::vector<ColourCodes> codesOf(const CaptureSamples& samples) {
  const ColourCoder coder(ColourScale::radiance);
  std::vector<ColourCodes> codes;
  for (const HalfColour& colour : samples.colour) codes.push_back(coder.codesOf(colour));
  return codes;
}
bool isFirst(const CaptureSamples& samples, std::size_t column, std::size_t i) {
  return i == samples.columnStart[column] || samples.row[i] != samples.row[i - 1];
}

TEST(ColourPicture, HoldsTheFirstSamplesWhereTheyAre) {
  const Capture capture = smoothly(syntheticCapture({300, 260, true, true, 6, true}));
  for (const CaptureSamples* list : {static_cast<const CaptureSamples*>(&capture), &capture.reflections}) {
    const PictureArea area = areaOf(*list);
    const std::vector<ColourCodes> codes = codesOf(*list);
    const StillPicture picture = pictureOf(*list, area, codes, 10);
    std::vector<ColourCodes> back(codes.size());
    for (const PictureArea& piece : piecesOf(area))
      takePiece(pieceOf(picture, piece), area, piece, *list, back);
    for (std::size_t k = 0; k < 300; ++k)
      for (std::size_t i = list->columnStart[k]; i < list->columnStart[k + 1]; ++i) {
        if (!isFirst(*list, k, i)) continue;
        ASSERT_EQ(back[i], codes[i]);
        ASSERT_EQ(picture.planes[0][std::size_t(list->row[i] - area.row) * std::size_t(area.columns) + k -
                                    std::size_t(area.column)],
                  codes[i][0]);
      }
  }
}

TEST(ColourPicture, IsNoLargerThanWhatHoldsSamples) {
  CaptureSamples few;
  few.columnStart.assign(301, 0);
  for (std::size_t k = 8; k <= 300; ++k) few.columnStart[k] = k <= 20 ? 1 : 2;
  few.row = {100, 104};
  const PictureArea area = areaOf(few);
  EXPECT_EQ(area.column, 7);
  EXPECT_EQ(area.columns, 14);
  EXPECT_EQ(area.row, 100);
  EXPECT_EQ(area.rows, 5);
  EXPECT_EQ(areaOf(CaptureSamples{}).pixels(), 0u);
  EXPECT_TRUE(piecesOf({}).empty());
}

TEST(ColourPicture, IsCutIntoPiecesThatPicturesMayBe) {
  for (const PictureArea& area : {PictureArea{3, 5, 65535, 70}, PictureArea{0, 0, 1, 65535},
                                  PictureArea{9, 2, 5000, 3000}, PictureArea{0, 0, 1, 1}}) {
    std::uint64_t pixels = 0;
    for (const PictureArea& piece : piecesOf(area)) {
      pixels += piece.pixels();
      EXPECT_LE(piece.pixels(), 1u << 22);
      EXPECT_LE(std::max(piece.columns, piece.rows), kMostPictureSide);
      EXPECT_GE(std::min(piece.columns, piece.rows), 1);
    }
    EXPECT_EQ(pixels, area.pixels());
  }
}

TEST(DeepColours, AreWithinHalfAStepAndReadAsTheyWereWritten) {
  for (const bool silhouettes : {false, true})
    for (const int quality : {0, 50, 90, 94, 99}) {
      Capture capture = smoothly(syntheticCapture({120, 90, true, true, 3}));
      if (silhouettes) capture = withSilhouettes(capture);
      const std::vector<ColourCodes> exact = codesOf(capture);
      std::vector<ColourCodes> written = exact;
      const DeepColourShape shape{90, quality, mostCodeOf(ColourScale::radiance)};
      const auto bytes = codeDeepColours(capture, shape, written);
      std::vector<ColourCodes> read(exact.size());
      int deep = 0;
      for (std::size_t k = 0; k < 120; ++k)
        for (std::size_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i)
          if (isFirst(capture, k, i))
            read[i] = exact[i];
          else
            ++deep;
      ASSERT_GT(deep, 500);
      ASSERT_TRUE(decodeDeepColours(bytes, capture, shape, read));
      EXPECT_EQ(read, written);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        const DeepColourSteps steps(quality);
        ASSERT_NEAR(written[i][0], exact[i][0], steps.luma / 2.0) << quality;
        for (std::size_t p = 1; p < 3; ++p)
          ASSERT_NEAR(written[i][p], exact[i][p], steps.chroma / 2.0) << quality;
      }
      EXPECT_FALSE(decodeDeepColours(std::span(bytes).first(bytes.size() / 2), capture, shape, read));
    }
}

/// Behind the edge of what is before it a surface goes on as it is beside that.
TEST(DeepColours, TakeNextToNothingWhereTheirSurfaceGoesOnBesideThem) {
  Capture capture = wallAndFloor();
  CaptureSamples edged;
  edged.planes = capture.planes, edged.columnStart = {0};
  std::size_t deep = 0;
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k) {
    for (std::size_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i)
      for (int layer = k % 10 == 3 ? 0 : 1; layer < 2; ++layer) {  // an edge of a third surface
        edged.row.push_back(capture.row[i]);
        edged.inverseDistance.push_back(capture.inverseDistance[i] + (layer == 0 ? 1 : 0));
        edged.plane.push_back(layer == 0 ? std::uint32_t(edged.planes.size()) : capture.plane[i]);
        const float x = float(k) / 100;
        edged.colour.push_back(layer == 0 ? packColour({5, 0.1f, 3, 1})
                                          : packColour({x, 0.5f, 1 - x / 2, 1}));
        edged.coverage.push_back(kWholePixel), edged.roles.push_back(1);
        deep += layer == 0;
      }
    edged.columnStart.push_back(std::uint32_t(edged.sampleCount()));
  }
  edged.planes.push_back({{0.5f, 0.5f, 0}});
  std::vector<ColourCodes> codes = codesOf(edged);
  EXPECT_LT(codeDeepColours(edged, {160, kQuality, mostCodeOf(ColourScale::radiance)}, codes).size(),
            deep / 10);
}

/// A damaged file may tell of a plane that its step hardly measures.
TEST(DistanceNumbers, OfWhatIsFartherThanAnyStepStayInRange) {
  for (const double step : {1e-24, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    const DistanceNumbers numbers(step);
    const std::int64_t number = numbers.numberOf(1);
    EXPECT_EQ(numbers.numberOf(1e9f), number);
    EXPECT_GE(number, 0);
    EXPECT_TRUE(numbers.at(number));
  }
  const DistanceNumbers usual(0x1p-12);
  for (const float w : {0.0f, 0.25f, 1.0f, 15.75f}) EXPECT_EQ(usual.at(usual.numberOf(w)), w);
}

}  // namespace
}  // namespace acentric
