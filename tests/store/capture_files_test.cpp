#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "engine/base/file.h"
#include "engine/store/capture_exr.h"
#include "engine/store/capture_store.h"
#include "tests/store/sealed_pack.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

const ContentKey kKey{0x0123456789abcdef, 0xfedcba9876543210};

struct CaptureFormat {
  const char* name;
  Status (*stoppableWrite)(const Capture&, const ContentKey&, const fs::path&, const std::stop_token&);
  Result<Capture> (*read)(const fs::path&);
  Status write(const Capture& capture, const ContentKey& key, const fs::path& path) const {
    return stoppableWrite(capture, key, path, {});
  }
};
const CaptureFormat kPack = {"c.pack", writeCapturePack, readCapturePack};
Status writeLossless(const Capture& capture, const ContentKey& key, const fs::path& path,
                     const std::stop_token& stop) {
  return writeCodedPack(capture, key, path, kLosslessColours, stop);
}
const CaptureFormat kCoded = {"c.coded.pack", writeLossless, readCapturePack};
const CaptureFormat kExr = {"c.exr", writeCaptureExr, readCaptureExr};

/// Everything but the colour of samples that are not opaque, which OpenEXR's premultiplication rounds.
void expectSame(const Capture& a, const Capture& b, bool coloursExact) {
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.columnStart, b.columnStart);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.inverseDistance, b.inverseDistance);
  EXPECT_EQ(a.distanceStep, b.distanceStep);
  EXPECT_EQ(a.roles, b.roles);
  EXPECT_EQ(a.mirror, b.mirror);
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.reflections, b.reflections);
  ASSERT_EQ(a.colour.size(), b.colour.size());
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    ASSERT_EQ(a.colour[i].a, b.colour[i].a) << i;
    if (coloursExact || a.colour[i].a == 0x3c00) {
      ASSERT_EQ(a.colour[i], b.colour[i]) << i;
      continue;
    }
    const glm::vec4 x = unpackColour(a.colour[i]), y = unpackColour(b.colour[i]);
    for (int channel = 0; channel < 3; ++channel)
      ASSERT_NEAR(x[channel], y[channel], x[channel] * 0x1p-9f + 1e-6f);
  }
}

Capture emptyCapture() {
  Capture capture = syntheticCapture({});
  capture.row.clear();
  capture.inverseDistance.clear();
  capture.colour.clear();
  capture.roles.clear();
  capture.background = {};
  std::fill(capture.columnStart.begin(), capture.columnStart.end(), 0u);
  return capture;
}

/// Every surface lies too near to be stored, what mirrors among them show does not.
Capture reflectionsAlone(bool background) {
  Capture capture = syntheticCapture({48, 40, true, true, 11, true});
  static_cast<CaptureSamples&>(capture) = {};
  capture.columnStart.assign(capture.reflections.columnStart.size(), 0);
  if (!background) capture.background = {};
  return capture;
}

Capture deepButEmptyColumns() {
  Capture capture = emptyCapture();
  capture.row = {3, 3};
  capture.inverseDistance = {1, 0.5f};
  capture.colour = {packColour({1, 2, 3, 0.5f}), packColour({0, 0, 0, 1})};
  capture.roles = {1, 0xff};
  for (std::size_t k = 8; k < capture.columnStart.size(); ++k) capture.columnStart[k] = 2;
  return capture;
}

void PrintTo(const CaptureFormat* format, std::ostream* out) { *out << format->name; }

/// Writes a capture and reads the file's bytes back; none if either fails.
std::vector<std::byte> bytesOf(const Capture& capture, const CaptureFormat& format, const fs::path& path) {
  const Status written = format.write(capture, kKey, path);
  EXPECT_TRUE(written) << (written ? "" : written.error().describe());
  const auto bytes = readFile(path);
  EXPECT_TRUE(bytes && !bytes->empty());
  return bytes ? *bytes : std::vector<std::byte>();
}

bool names(const std::vector<std::byte>& file, std::string_view word) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  return text.find(word) != std::string_view::npos;
}

class CaptureFiles : public FolderTest, public testing::WithParamInterface<const CaptureFormat*> {};
INSTANTIATE_TEST_SUITE_P(Formats, CaptureFiles, testing::Values(&kPack, &kCoded, &kExr),
                         [](const auto& format) {
                           return format.param == &kPack    ? "Pack"
                                  : format.param == &kCoded ? "Coded"
                                                            : "OpenExr";
                         });

TEST_P(CaptureFiles, RoundTripsEveryShape) {
  const Capture captures[] = {syntheticCapture({}),
                              syntheticCapture({48, 40, false, false, 2}),
                              syntheticCapture({48, 40, true, true, 3}),
                              syntheticCapture({1, 1, false, false, 4}),
                              syntheticCapture({1, 33, true, false, 5}),
                              syntheticCapture({300, 260, true, true, 6}),
                              syntheticCapture({48, 40, false, true, 7, true}),
                              syntheticCapture({48, 40, true, true, 8, true}),
                              syntheticCapture({1, 1, false, false, 9, true}),
                              syntheticCapture({300, 260, true, true, 10, true}),
                              emptyCapture(),
                              deepButEmptyColumns(),
                              reflectionsAlone(true),
                              reflectionsAlone(false)};
  const fs::path path = folder_ / GetParam()->name;
  for (const Capture& capture : captures) {
    ASSERT_TRUE(capture.check());
    const Status written = GetParam()->write(capture, kKey, path);
    ASSERT_TRUE(written) << written.error().describe();
    const auto back = GetParam()->read(path);
    ASSERT_TRUE(back) << back.error().describe();
    expectSame(capture, *back, GetParam() != &kExr);
  }
}

TEST_P(CaptureFiles, KeepExtremeDistancesBitForBit) {
  Capture capture = syntheticCapture({4, 8, false, false, 1});
  const double exact[] = {7.5, 1e-38, 1e-40, 1e-4, 3.3e38, 1000, 1 + 0x1p-15, 1.0 / 3};
  float extremes[8];
  std::transform(std::begin(exact), std::end(exact), extremes,
                 [](double w) { return storedInverseDistance(w, 0); });
  for (std::size_t i = 0; i < capture.sampleCount(); ++i) capture.inverseDistance[i] = extremes[i % 8];
  capture.colour[0] = HalfColour(0x7bff, 1, 0, 0x3c00);
  ASSERT_TRUE(GetParam()->write(capture, kKey, folder_ / GetParam()->name));
  const auto back = GetParam()->read(folder_ / GetParam()->name);
  ASSERT_TRUE(back) << back.error().describe();
  expectSame(capture, *back, true);
}

TEST_P(CaptureFiles, AreNeverWrittenFromABrokenCapture) {
  Capture capture = syntheticCapture({});
  capture.inverseDistance[5] = -1;
  EXPECT_FALSE(GetParam()->write(capture, kKey, folder_ / GetParam()->name));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_P(CaptureFiles, SayWhichFileIsMissing) {
  const auto missing = GetParam()->read(folder_ / GetParam()->name);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  EXPECT_NE(missing.error().describe().find(GetParam()->name), std::string::npos);
}

TEST_P(CaptureFiles, CutAnywhereAreMalformed) {
  const fs::path path = folder_ / GetParam()->name;
  for (const bool mirrors : {false, true}) {
    const auto bytes = bytesOf(syntheticCapture({16, 12, true, true, 1, mirrors}), *GetParam(), path);
    const std::size_t step = std::max<std::size_t>(1, bytes.size() / 400);
    for (std::size_t size = 0; size < bytes.size(); size += step) {
      writeQuickly(path, std::span(bytes).first(size));
      const auto read = GetParam()->read(path);
      ASSERT_FALSE(read) << size;
      EXPECT_EQ(read.error().kind, ErrorKind::malformed) << read.error().describe();
    }
  }
}

/// A mirror's list costs nothing where there is no mirror: the file of the surfaces alone is the shorter one
/// by all that the list takes.
TEST_P(CaptureFiles, WithoutMirrorsHoldNoByteForThem) {
  const fs::path path = folder_ / GetParam()->name;
  Capture capture = syntheticCapture({64, 64, true, true, 3, true});
  const std::size_t withList = bytesOf(capture, *GetParam(), path).size();
  capture.mirror.clear();
  capture.reflections = {};
  const auto without = bytesOf(capture, *GetParam(), path);
  EXPECT_GT(withList, without.size());
  EXPECT_FALSE(names(without, "mirror") || names(without, "reflections"));
  if (GetParam() == &kPack) {
    std::uint32_t descriptionBytes = 0;
    std::memcpy(&descriptionBytes, without.data() + 48, sizeof descriptionBytes);
    EXPECT_EQ(descriptionBytes, 124u);
  }
}

/// Nor does a capture that shows none hold anything of the background.
TEST_P(CaptureFiles, HoldTheBackgroundAsRunsOfRows) {
  const fs::path path = folder_ / GetParam()->name;
  Capture capture = syntheticCapture({64, 64, false, false, 3});
  ASSERT_GE(capture.background.pixelCount(), 64u * 10u);
  ASSERT_LE(capture.background.runCount(), 64u);
  const std::size_t withRuns = bytesOf(capture, *GetParam(), path).size();
  capture.background = {};
  const auto without = bytesOf(capture, *GetParam(), path);
  EXPECT_LT(without.size(), withRuns);
  if (GetParam() == &kPack) {
    EXPECT_LT(withRuns - without.size(), 64u * 6u);
  }
  EXPECT_FALSE(names(without, "acentricSky"));
}

TEST(CaptureExr, BackgroundIsTakenOutOfTheSamplesAsItWasPutIn) {
  for (const bool mirrors : {false, true}) {
    const Capture capture = syntheticCapture({40, 30, true, true, 6, mirrors});
    CaptureSamples all = withBackground(capture, capture.colour);
    EXPECT_EQ(all.sampleCount(), capture.sampleCount() + capture.background.pixelCount());
    CaptureBackground background;
    ASSERT_TRUE(takeBackground(all, capture.background.sky, background));
    EXPECT_EQ(all, static_cast<const CaptureSamples&>(capture));
    EXPECT_EQ(background, capture.background);
  }
}

TEST(CaptureExr, BackgroundThatIsNotLastOrIsAMirrorIsRefused) {
  const CaptureSamples sound{{0, 2}, {3, 3}, {1, 0}, std::vector(2, packColour({1, 1, 1, 1})),
                             {1, 1}, {0, 0}};
  CaptureBackground background;
  CaptureSamples samples = sound;
  EXPECT_TRUE(takeBackground(samples, {}, background));
  EXPECT_EQ(background.pixelCount(), 1u);
  samples = sound;
  samples.inverseDistance = {0, 1};
  EXPECT_EQ(takeBackground(samples, {}, background).error().kind, ErrorKind::malformed);
  samples = sound;
  samples.inverseDistance = {0, 0};
  EXPECT_EQ(takeBackground(samples, {}, background).error().kind, ErrorKind::malformed);
  samples = sound;
  samples.mirror = {0, 7};
  EXPECT_EQ(takeBackground(samples, {}, background).error().kind, ErrorKind::malformed);
}

TEST_P(CaptureFiles, DamagedByChanceAreRefusedOrUnharmed) {
  const fs::path path = folder_ / GetParam()->name;
  std::mt19937 random(17);
  for (const bool layered : {false, true}) {
    const auto sound = bytesOf(syntheticCapture({16, 12, layered, true, 1, layered}), *GetParam(), path);
    const auto original = GetParam()->read(path);
    ASSERT_TRUE(original);
    int refused = 0;
    constexpr int kRounds = 400;
    for (int round = 0; round < kRounds; ++round) {
      auto bytes = sound;
      const int damages = 1 + static_cast<int>(random() % 4);
      for (int i = 0; i < damages; ++i) {
        // Every other round in the first kilobytes, where sizes and counts are.
        const std::size_t at =
            random() % (round % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500));
        bytes[at] = random() % 3 ? bytes[at] ^ std::byte(1u << (random() % 8)) : std::byte(random() % 256);
      }
      writeQuickly(path, bytes);
      const auto read = GetParam()->read(path);
      if (read) {
        expectSame(*original, *read, true);
      } else {
        ++refused;
        EXPECT_NE(read.error().describe().find(GetParam()->name), std::string::npos);
        EXPECT_TRUE(read.error().kind == ErrorKind::malformed ||
                    read.error().kind == ErrorKind::unsupported || read.error().kind == ErrorKind::outOfSpace)
            << read.error().describe();
      }
    }
    EXPECT_GT(refused, kRounds / 2);
  }
}

TEST_F(FolderTest, PacksKeepSilhouettes) {
  for (const bool mirrors : {false, true}) {
    const Capture capture = withSilhouettes(syntheticCapture({48, 40, true, true, 11, mirrors}));
    ASSERT_TRUE(capture.check()) << capture.check().error().describe();
    const fs::path path = folder_ / kPack.name;
    ASSERT_TRUE(writeCapturePack(capture, Hasher().finish(), path));
    const auto read = readCapturePack(path);
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(*read, capture);
  }
}

TEST_F(FolderTest, PacksForgedWithAMatchingChecksumAreHarmless) {
  const fs::path path = folder_ / kPack.name;
  std::mt19937 random(29);
  for (const bool mirrors : {false, true}) {
    const auto sound = bytesOf(syntheticCapture({16, 12, true, true, 1, mirrors}), kPack, path);
    // Preamble, description and table fill the first bytes; the key's 16 bytes and the magic are left alone.
    const std::size_t head = mirrors ? 244 : 194;
    int refused = 0;
    for (int round = 0; round < 2000; ++round) {
      auto bytes = sound;
      const std::size_t checked = bytes.size() - 16;
      const std::size_t at = round % 4 ? 32 + random() % (head - 32) : head + random() % (checked - head);
      const std::byte values[] = {std::byte(0), std::byte(0xff), std::byte(0x7f),
                                  bytes[at] ^ std::byte(1u << (random() % 8))};
      bytes[at] = values[random() % 4];
      test::seal(bytes);
      writeQuickly(path, bytes);
      const auto read = kPack.read(path);
      if (read) {
        EXPECT_TRUE(read->check());
      } else {
        ++refused;
        EXPECT_EQ(read.error().kind, ErrorKind::malformed) << read.error().describe();
      }
    }
    EXPECT_GT(refused, 500);
  }
}

TEST_F(FolderTest, PacksThatClaimReflectionsTheyDoNotHaveAreRefused) {
  const fs::path path = folder_ / kPack.name;
  const auto sound = bytesOf(syntheticCapture({16, 12, true, true, 1, true}), kPack, path);
  constexpr std::size_t kReflectionCount = 56 + 124;
  std::uint64_t count = 0;
  std::memcpy(&count, sound.data() + kReflectionCount, sizeof count);
  ASSERT_EQ(count, syntheticCapture({16, 12, true, true, 1, true}).reflections.sampleCount());
  for (const std::uint64_t claimed :
       {std::uint64_t(0), count - 1, count + 1, count << 32, std::uint64_t(1) << 31, ~std::uint64_t(0),
        // as many bytes again as the address space has: the sum of all sizes is the same modulo 2^64
        count + (std::uint64_t(1) << 60)}) {
    auto bytes = sound;
    std::memcpy(bytes.data() + kReflectionCount, &claimed, sizeof claimed);
    test::seal(bytes);
    writeQuickly(path, bytes);
    const auto read = kPack.read(path);
    ASSERT_FALSE(read) << claimed;
    EXPECT_EQ(read.error().kind, ErrorKind::malformed) << read.error().describe();
  }
}

TEST_P(CaptureFiles, OfOtherProgramsAreRefused) {
  const fs::path path = folder_ / GetParam()->name;
  for (const std::string& text : {std::string(), std::string("not a capture"), std::string(100000, '\0')}) {
    ASSERT_TRUE(writeTextAtomically(path, text));
    const auto read = GetParam()->read(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::malformed);
  }
}

}  // namespace
}  // namespace acentric
