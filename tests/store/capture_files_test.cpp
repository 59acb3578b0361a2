#include <algorithm>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

const ContentKey kKey{0x0123456789abcdef, 0xfedcba9876543210};

struct CaptureFormat {
  const char* name;
  Status (*stoppableWrite)(const Capture&, const ContentKey&, const fs::path&, const std::stop_token&);
  Status write(const Capture& capture, const ContentKey& key, const fs::path& path) const {
    return stoppableWrite(capture, key, path, {});
  }
};
Status writeLossless(const Capture& capture, const ContentKey& key, const fs::path& path,
                     const std::stop_token& stop) {
  return writeCodedPack(capture, key, path, kLosslessColours, stop);
}
const CaptureFormat kPack = {"c.pack", writeLossless};
const CaptureFormat kExr = {"c.exr", writeCaptureExr};

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
INSTANTIATE_TEST_SUITE_P(Formats, CaptureFiles, testing::Values(&kPack, &kExr),
                         [](const auto& format) { return format.param == &kPack ? "Pack" : "OpenExr"; });
class CapturePacks : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    path_ = folder_ / kPack.name;
  }
  fs::path path_;
};

TEST_F(CapturePacks, RoundTripsEveryShape) {
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
  for (const Capture& capture : captures) {
    ASSERT_TRUE(capture.check());
    const Status written = kPack.write(capture, kKey, path_);
    ASSERT_TRUE(written) << written.error().describe();
    const auto back = readCapturePack(path_);
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(*back, capture);
  }
}

TEST_F(CapturePacks, KeepExtremeDistancesBitForBit) {
  Capture capture = syntheticCapture({4, 8, false, false, 1});
  const double exact[] = {7.5, 1e-38, 1e-40, 1e-4, 3.3e38, 1000, 1 + 0x1p-15, 1.0 / 3};
  float extremes[8];
  std::transform(std::begin(exact), std::end(exact), extremes,
                 [](double w) { return storedInverseDistance(w, 0); });
  for (std::size_t i = 0; i < capture.sampleCount(); ++i) capture.inverseDistance[i] = extremes[i % 8];
  capture.colour[0] = HalfColour(0x7bff, 1, 0, 0x3c00);
  ASSERT_TRUE(kPack.write(capture, kKey, path_));
  const auto back = readCapturePack(path_);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, capture);
}

TEST_P(CaptureFiles, AreNeverWrittenFromABrokenCapture) {
  Capture capture = syntheticCapture({});
  capture.inverseDistance[5] = -1;
  EXPECT_FALSE(GetParam()->write(capture, kKey, folder_ / GetParam()->name));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(CapturePacks, SayWhichFileIsMissing) {
  const auto missing = readCapturePack(path_);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  EXPECT_NE(missing.error().describe().find(kPack.name), std::string::npos);
}

TEST_F(CapturePacks, CutAnywhereAreMalformed) {
  for (const bool mirrors : {false, true}) {
    const auto bytes = bytesOf(syntheticCapture({16, 12, true, true, 1, mirrors}), kPack, path_);
    const std::size_t step = std::max<std::size_t>(1, bytes.size() / 400);
    for (std::size_t size = 0; size < bytes.size(); size += step) {
      writeQuickly(path_, std::span(bytes).first(size));
      const auto read = readCapturePack(path_);
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

TEST_F(CapturePacks, DamagedByChanceAreRefusedOrUnharmed) {
  std::mt19937 random(17);
  for (const bool layered : {false, true}) {
    const auto sound = bytesOf(syntheticCapture({16, 12, layered, true, 1, layered}), kPack, path_);
    const auto original = readCapturePack(path_);
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
      writeQuickly(path_, bytes);
      const auto read = readCapturePack(path_);
      if (read) {
        EXPECT_EQ(*read, *original);
      } else {
        ++refused;
        EXPECT_NE(read.error().describe().find(kPack.name), std::string::npos);
        EXPECT_TRUE(read.error().kind == ErrorKind::malformed ||
                    read.error().kind == ErrorKind::unsupported || read.error().kind == ErrorKind::outOfSpace)
            << read.error().describe();
      }
    }
    EXPECT_GT(refused, kRounds / 2);
  }
}

TEST_F(CapturePacks, OfOtherProgramsAreRefused) {
  for (const std::string& text : {std::string(), std::string("not a capture"), std::string(100000, '\0')}) {
    ASSERT_TRUE(writeTextAtomically(path_, text));
    const auto read = readCapturePack(path_);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::malformed);
  }
}

}  // namespace
}  // namespace acentric
