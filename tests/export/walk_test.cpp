#include "engine/export/walk_read.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "engine/base/file.h"
#include "engine/export/walk_write.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// Square regions in rows, each with a camera of its own and that of its right neighbour; files of any bytes.
class WalkTest : public FolderTest {
 protected:
  static constexpr int kSide = 14;

  void SetUp() override {
    FolderTest::SetUp();
    bundle_.name = "grid", bundle_.generator = "test", bundle_.fov = 1;
    BundleTexture texture{file("textures/a.png"), 1, 1};
    bundle_.textures.push_back(texture);
    bundle_.storeys.push_back(storey("low")), bundle_.storeys.push_back(storey("high"));
    bundle_.storey = 1;
    ASSERT_TRUE(writeTextAtomically(folder_ / "bundle" / kBundleIndex, formatBundle(bundle_)));
  }

  BundleFile file(const std::string& name) {
    std::vector<std::byte> bytes(20 + random_() % 200);
    for (std::byte& byte : bytes) byte = std::byte(random_());
    const fs::path path = folder_ / "bundle" / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    files_[name] = bytes;
    return {name, bytes.size(), Hasher().bytes(bytes.data(), bytes.size()).finish()};
  }

  BundleStorey storey(const std::string& name) {
    BundleStorey storey;
    storey.name = name;
    storey.layout.spec.nearBand = 1;
    storey.start = {7.5, 3.5};
    for (int r = 0; r < kSide * kSide; ++r) {
      const glm::dvec2 low(r % kSide, r / kSide);
      LayoutCamera camera;
      camera.position = low, camera.fovRadians = 1, camera.roles.resize(8);
      storey.layout.cameras.push_back(camera);
      BundleCamera renditions{0.5, -0.5, {}, {}};
      renditions.full = BundleCapture{file(name + "/full" + std::to_string(r) + ".pack"), 8, 8, 5, 0};
      if (r % 3 != 0)
        renditions.coarse = BundleCapture{file(name + "/coarse" + std::to_string(r) + ".pack"), 1, 1, 1, 0};
      storey.cameras.push_back(renditions);
      Region region;
      region.polygon.corners = {low, low + glm::dvec2(1, 0), low + glm::dvec2(1, 1), low + glm::dvec2(0, 1)};
      region.grown = region.polygon;
      Cover cover;
      for (const int c : {r, (r + 1) % (kSide * kSide)}) {
        Piece piece;
        piece.camera = c, piece.apex = low, piece.role = 2;
        piece.low = {low, low + glm::dvec2(1, 0)}, piece.high = {low, low + glm::dvec2(0, 1)};
        cover.pieces.push_back(piece);
      }
      region.covers.push_back(cover);
      storey.layout.regions.push_back(region);
      storey.layout.panoramas.emplace_back();
      std::vector<int> neighbours;
      for (int other = 0; other < kSide * kSide; ++other)
        if (other != r && std::abs(other % kSide - r % kSide) <= 1 &&
            std::abs(other / kSide - r / kSide) <= 1)
          neighbours.push_back(other);
      storey.neighbours.push_back(neighbours);
      storey.local.emplace_back();
      if (r % 2 == 0) storey.local.back() = BundleLocal{file(name + "/" + std::to_string(r) + ".local"), 3};
    }
    storey.layout.cameras.push_back(storey.layout.cameras.back());  // which nothing shows
    storey.cameras.push_back({0.5, -0.5, {}, {}});
    return storey;
  }

  fs::path walk() const { return folder_ / "grid.acentric"; }
  std::vector<std::byte> written(const WalkOptions& options) {
    const auto size = writeWalk(folder_ / "bundle", walk(), options);
    EXPECT_TRUE(size) << size.error().describe();
    auto bytes = *readFile(walk());
    EXPECT_EQ(bytes.size(), *size);
    return bytes;
  }

  std::mt19937 random_{1};
  Bundle bundle_;
  std::map<std::string, std::vector<std::byte>> files_;
};

/// Remembers what is read.
class CountedRanges final : public ByteRanges {
 public:
  CountedRanges(std::vector<std::byte> bytes, std::vector<std::pair<std::uint64_t, std::size_t>>& reads)
      : bytes_(std::move(bytes)), reads_(reads) {}
  Result<std::uint64_t> size() const override { return bytes_.size(); }
  Status read(std::uint64_t at, std::span<std::byte> into) const override {
    if (at > bytes_.size() || into.size() > bytes_.size() - at)
      return fail(ErrorKind::unreadable, "beyond the end");
    std::copy_n(bytes_.begin() + std::ptrdiff_t(at), into.size(), into.begin());
    reads_.emplace_back(at, into.size());
    return {};
  }

 private:
  std::vector<std::byte> bytes_;
  std::vector<std::pair<std::uint64_t, std::size_t>>& reads_;
};

TEST_F(WalkTest, HoldsTheBundleItWasMadeFrom) {
  for (const int regionsPerPage : {1, 5, 4096}) {
    written({regionsPerPage});
    const auto files = bundleAt(walk());
    ASSERT_TRUE(files) << files.error().describe();
    const auto bundle = readBundle(**files);
    ASSERT_TRUE(bundle) << bundle.error().describe();
    EXPECT_EQ(formatBundle(*bundle), formatBundle(bundle_));
    for (const auto& [name, bytes] : files_) EXPECT_EQ(*(*files)->read(name, 1 << 20), bytes) << name;
    EXPECT_FALSE((*files)->read("captures/none.pack", 1 << 20));
    EXPECT_EQ((*files)->read("textures/a.png", 3).error().kind, ErrorKind::tooLarge);
  }
}

TEST_F(WalkTest, HasTheSameBytesEachTimeAndBeginsWhereTheWalkDoes) {
  const std::vector<std::byte> first = written({16}), second = written({16});
  EXPECT_EQ(first, second);
  std::vector<std::pair<std::uint64_t, std::size_t>> reads;
  const auto files = walkFiles(std::make_unique<CountedRanges>(first, reads), "grid");
  ASSERT_TRUE(files);
  const auto placeOf = [&](const std::string& name) {
    reads.clear();
    EXPECT_TRUE((*files)->read(name, 1 << 20));
    return reads.front().first;
  };
  // Region 49 is where the storey "high" begins; its cameras are 49 and 50.
  const std::uint64_t start = placeOf("high/coarse49.pack");
  for (const char* later : {"high/full49.pack", "high/full50.pack", "textures/a.png", "high/coarse91.pack",
                            "low/coarse49.pack", "high/full0.pack"})
    EXPECT_GT(placeOf(later), start) << later;
  EXPECT_LT(placeOf("high/full49.pack"), placeOf("high/full63.pack"));
  EXPECT_LT(placeOf("high/full63.pack"), placeOf("high/full195.pack"));
}

TEST_F(WalkTest, RefusesWhatIsDamagedOrCutOff) {
  const std::vector<std::byte> sound = written({8});
  std::vector<std::pair<std::uint64_t, std::size_t>> reads;
  const auto opened = [&](std::vector<std::byte> bytes) {
    return walkFiles(std::make_unique<CountedRanges>(std::move(bytes), reads), "grid");
  };
  ASSERT_TRUE(opened(sound));
  std::uint64_t indexEnd = 0;
  for (const auto& [at, size] : reads) indexEnd = std::max(indexEnd, at + size);
  for (std::uint64_t at = 0; at < indexEnd; at += 1 + indexEnd / 100) {
    std::vector<std::byte> bytes = sound;
    bytes[at] ^= std::byte(0x20);
    const auto files = opened(std::move(bytes));
    EXPECT_FALSE(files) << "byte " << at;
    if (!files) {
      EXPECT_NE(files.error().describe().find("grid"), std::string::npos);
    }
  }
  for (const std::size_t length : {std::size_t(0), std::size_t(50), std::size_t(88), sound.size() - 1})
    EXPECT_FALSE(opened({sound.begin(), sound.begin() + std::ptrdiff_t(length)})) << length;
}

TEST_F(WalkTest, OpensByWhatAnEyeNeedsOfItsIndex) {
  // All pages that lead to one region, the root with them: little, however many regions there are.
  const std::vector<std::byte> bytes = written({4});
  const auto u64 = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::uint64_t root = u64(24), pageStart = u64(40), dataStart = u64(48);
  EXPECT_EQ(pageStart, 88 + root);
  EXPECT_LT(root, (dataStart - pageStart) / 20);
}

}  // namespace
}  // namespace acentric
