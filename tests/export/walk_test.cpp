#include "engine/export/walk_read.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/export/bundle_json.h"
#include "engine/export/walk_format.h"
#include "engine/export/walk_pages.h"
#include "engine/export/walk_write.h"
#include "engine/store/packed_text.h"
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

  /// Regions reach so far into those beside them.
  BundleStorey storey(const std::string& name, double overlap = 0) {
    BundleStorey storey;
    storey.name = name;
    storey.layout.spec.floorHeight = name == "low" ? 0 : 3;
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
      const double from = -overlap, to = 1 + overlap;
      for (const glm::dvec2 corner : {glm::dvec2(from), {to, from}, {to, to}, {from, to}})
        region.polygon.corners.push_back(low + corner);
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

void expectSame(const CameraFacts& a, const CameraFacts& b) {
  const auto numbers = [](const CameraFacts& f) {
    return std::vector<double>{f.position.x, f.position.y,   f.lowAzimuth,
                               f.fovRadians, f.topElevation, f.bottomElevation};
  };
  const auto rendition = [](const CameraFacts::Rendition& r) {
    return std::vector<std::uint64_t>{std::uint64_t(r.columns), std::uint64_t(r.rows), r.samples,
                                      r.reflections, r.bytes};
  };
  EXPECT_EQ(numbers(a), numbers(b));
  EXPECT_EQ(rendition(a.full), rendition(b.full));
  EXPECT_EQ(rendition(a.coarse), rendition(b.coarse));
}

void expectSame(const RegionFacts& a, const RegionFacts& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_TRUE(std::ranges::equal(a.polygon, b.polygon));
  EXPECT_TRUE(std::ranges::equal(a.grown, b.grown));
  EXPECT_TRUE(std::ranges::equal(a.neighbours, b.neighbours));
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.bytes, b.bytes);
}

TEST_F(WalkTest, PlacesAndNumbersAreThoseOfTheWholeIndex) {
  std::uniform_real_distribution<double> anywhere(-2, kSide + 2), height(-2, 8);
  for (const double overlap : {0.0, 0.3})
    for (const int regionsPerPage : {1, 5, 64}) {
      bundle_.storeys = {storey("low", overlap), storey("high", overlap)};
      ASSERT_TRUE(writeTextAtomically(folder_ / "bundle" / kBundleIndex, formatBundle(bundle_)));
      std::vector<std::pair<std::uint64_t, std::size_t>> reads;
      const std::vector<std::byte> bytes = written({regionsPerPage});
      const auto opened = [&] {
        auto pages = WalkPages::open(std::make_shared<CountedRanges>(bytes, reads), "grid");
        EXPECT_TRUE(pages) << pages.error().describe();
        return std::move(*pages);
      };
      const auto whole = wholeBundle(std::move(*bundleAt(walk())));
      ASSERT_TRUE(whole) << whole.error().describe();
      const auto pages = opened();
      for (int n = 0; n < 60; ++n) {
        const glm::dvec3 eye = n % 5 == 0 ? glm::dvec3(n % kSide, n / 5 % kSide, height(random_))
                                          : glm::dvec3(anywhere(random_), anywhere(random_), height(random_));
        EXPECT_EQ(*pages->storeyAt(eye), *(*whole)->storeyAt(eye));
        for (const std::size_t s : {0U, 1U}) {
          const Layout& all = bundle_.storeys[s].layout;
          const auto place = pages->placeAt(s, eye);
          ASSERT_TRUE(place) << place.error().describe();
          const auto expected = all.regionAt(eye), here = (*place)->here().layout.regionAt(eye);
          ASSERT_EQ(here.has_value(), expected.has_value());
          if (here) {
            EXPECT_EQ((*place)->regions[std::size_t(*here)], std::uint64_t(*expected));
            EXPECT_EQ((*place)->own[std::size_t(*here)], 1);
          }
          EXPECT_EQ((*place)->here().layout.nearestRegion(eye).point, all.nearestRegion(eye).point);
        }
      }
      for (std::size_t n = 0; n < 120; ++n) {
        const std::size_t s = random_() % 2, region = random_() % (kSide * kSide),
                          camera = random_() % (kSide * kSide + 1);
        const auto fresh = n % 10 == 0 ? opened() : nullptr;
        WalkPages& from = fresh ? *fresh : *pages;
        const auto its = from.region(s, region);
        ASSERT_TRUE(its) << its.error().describe();
        expectSame(*its, *(*whole)->region(s, region));
        const auto facts = from.camera(s, camera);
        ASSERT_TRUE(facts) << facts.error().describe();
        expectSame(*facts, *(*whole)->camera(s, camera));
        const auto around = from.placeOfRegion(s, region), by = from.placeOfCamera(s, camera);
        ASSERT_TRUE(around && by);
        const auto r = (*around)->regionIn(region), c = (*by)->cameraIn(camera);
        ASSERT_TRUE(r && c);
        EXPECT_EQ((*around)->here().local[*r], bundle_.storeys[s].local[region]);
        EXPECT_EQ((*by)->here().cameras[*c], bundle_.storeys[s].cameras[camera]);
      }
      // Of a storey that is far below the eye no page is read.
      const auto fresh = opened();
      reads.clear();
      EXPECT_EQ(*fresh->storeyAt({7.2, 3.7, 3 + fresh->root().storeys[1].layout.spec.eyeHeight}), 1U);
      const std::size_t before = reads.size();
      ASSERT_TRUE(fresh->placeAt(1, {7.2, 3.7}));
      EXPECT_EQ(reads.size(), before);
      ASSERT_TRUE(fresh->placeAt(0, {7.2, 3.7}));
      EXPECT_GT(reads.size(), before);
    }
}

/// A walk whose root says so many regions, however few its pages have.
std::vector<std::byte> withCount(const std::vector<std::byte>& walk, const char* count,
                                 std::uint64_t number) {
  walk_format::Header header = *walk_format::headerOf(walk, "grid");
  const auto part = [&](std::uint64_t at, std::uint64_t bytes) {
    return std::vector<std::byte>(walk.begin() + std::ptrdiff_t(at),
                                  walk.begin() + std::ptrdiff_t(at + bytes));
  };
  auto root = *parseJson<BundleJson>(
      *unpackedText(part(walk_format::kHeaderBytes, header.rootBytes), header.rootRaw), "root");
  for (BundleJson& storey : root["storeys"]) storey[count] = number;
  const std::string text = jsonText(root);
  const std::vector<std::byte> packed = packedText(text),
                               pages = part(header.pageStart, header.dataStart - header.pageStart),
                               data = part(header.dataStart, header.fileBytes - header.dataStart);
  header.rootBytes = packed.size(), header.rootRaw = text.size();
  header.pageStart = walk_format::kHeaderBytes + packed.size();
  header.dataStart = header.pageStart + pages.size();
  header.fileBytes = header.dataStart + data.size();
  const ContentKey hash = Hasher().bytes(packed.data(), packed.size()).finish();
  header.rootHash = {hash.high, hash.low};
  std::vector<std::byte> out;
  const auto first = walk_format::headerBytes(header);
  for (const std::span<const std::byte> next : {std::span<const std::byte>(first), {packed}, {pages}, {data}})
    out.insert(out.end(), next.begin(), next.end());
  return out;
}

TEST_F(WalkTest, AStoreyMayHaveMoreRegionsThanOneIndexIsReadFor) {
  std::vector<std::pair<std::uint64_t, std::size_t>> reads;
  const auto opened = [&](const char* count, std::uint64_t number) {
    return WalkPages::open(std::make_shared<CountedRanges>(withCount(written({4}), count, number), reads),
                           "grid");
  };
  const auto pages = opened("regionCount", 1'000'000);
  ASSERT_TRUE(pages) << pages.error().describe();
  EXPECT_EQ((*pages)->counts(1).regions, 1'000'000U);
  EXPECT_TRUE((*pages)->placeAt(1, {3.5, 4.5}));
  EXPECT_TRUE((*pages)->region(1, 20));
  for (int twice = 0; twice < 2; ++twice) {
    reads.clear();
    const auto missing = (*pages)->region(1, 900'000);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::malformed);
    EXPECT_NE(missing.error().describe().find("region 900000"), std::string::npos)
        << missing.error().describe();
  }
  EXPECT_TRUE(reads.empty()) << "looked through once";
  EXPECT_FALSE(opened("regionCount", std::uint64_t(1) << 31));
  EXPECT_FALSE(opened("cameraCount", std::uint64_t(1) << 31));
  EXPECT_FALSE(opened("regionCount", 0));
  const auto fewer = opened("regionCount", 10);
  ASSERT_TRUE(fewer);
  EXPECT_FALSE((*fewer)->placeAt(0, {13.5, 13.5})) << "its region is beyond the count";
}

/// Page by page against the whole.
TEST_F(WalkTest, APlaceIsWhatTheWholeBundleIsThere) {
  std::uniform_real_distribution<double> anywhere(-2, kSide + 2);
  for (const int regionsPerPage : {1, 5, 64, 4096}) {
    std::vector<std::pair<std::uint64_t, std::size_t>> reads;
    auto pages = WalkPages::open(std::make_shared<CountedRanges>(written({regionsPerPage}), reads), "grid");
    ASSERT_TRUE(pages) << pages.error().describe();
    EXPECT_EQ((*pages)->counts(0).regions, std::size_t(kSide * kSide));
    EXPECT_TRUE((*pages)->root().storeys[0].layout.regions.empty());
    EXPECT_EQ((*pages)->root().storeys[1].start, bundle_.storeys[1].start);
    for (int n = 0; n < 30; ++n) {
      const std::size_t s = n % 2;
      const BundleStorey& whole = bundle_.storeys[s];
      const glm::dvec2 point = n % 5 == 0 ? glm::dvec2(n % kSide, n / 5 % kSide)  // a corner of regions
                                          : glm::dvec2(anywhere(random_), anywhere(random_));
      const auto found = (*pages)->placeAt(s, point);
      ASSERT_TRUE(found) << found.error().describe();
      const BundlePlace& place = **found;
      const BundleStorey& here = place.here();
      EXPECT_TRUE(place.bundle->storeys[1 - s].layout.regions.empty());
      const auto number = whole.layout.regionAt(point), local = here.layout.regionAt(point);
      ASSERT_EQ(number.has_value(), local.has_value());
      const int nearest = here.layout.nearestRegion(point).region;
      const auto r = std::size_t(local.value_or(nearest));
      EXPECT_EQ(place.own[r], 1);
      if (number) {
        EXPECT_EQ(place.regions[r], std::uint64_t(*number));
      }
      EXPECT_NEAR(glm::distance(whole.layout.nearestRegion(point).point, point),
                  glm::distance(here.layout.nearestRegion(point).point, point), 1e-12);
      for (std::size_t i = 0; i < place.regions.size(); ++i) {
        const auto of = std::size_t(place.regions[i]);
        EXPECT_EQ(here.layout.regions[i].polygon.corners, whole.layout.regions[of].polygon.corners);
        EXPECT_EQ(here.local[i], whole.local[of]);
        const auto &pieces = here.layout.regions[i].covers[0].pieces,
                   &all = whole.layout.regions[of].covers[0].pieces;
        ASSERT_EQ(pieces.size(), all.size());
        for (std::size_t p = 0; p < pieces.size(); ++p)
          EXPECT_EQ(place.cameras[std::size_t(pieces[p].camera)], std::uint64_t(all[p].camera));
        if (place.own[i] == 0) continue;
        EXPECT_EQ(here.neighbours[i].size(), whole.neighbours[of].size()) << "all are in the page";
        for (std::size_t k = 0; k < here.neighbours[i].size(); ++k)
          EXPECT_EQ(place.regions[std::size_t(here.neighbours[i][k])],
                    std::uint64_t(whole.neighbours[of][k]));
      }
      for (std::size_t c = 0; c < place.cameras.size(); ++c) {
        EXPECT_EQ(here.cameras[c], whole.cameras[std::size_t(place.cameras[c])]);
        if (!here.cameras[c].full) continue;  // the one that nothing shows
        const std::string& path = here.cameras[c].full->file.path;
        EXPECT_EQ(*place.files->read(path, 1 << 20), files_[path]);
      }
      EXPECT_EQ(*place.files->read("textures/a.png", 1 << 20), files_["textures/a.png"]);
      const std::size_t before = reads.size();
      EXPECT_EQ(*(*pages)->placeAt(s, point), *found) << "it is kept";
      EXPECT_EQ(reads.size(), before);
    }
    EXPECT_FALSE((*pages)->placeAt(2, {0, 0}));
  }
}

TEST_F(WalkTest, APlaceThatIsDamagedIsNamedAndTheOthersAreStillThere) {
  std::vector<std::byte> bytes = written({4});
  const auto u64 = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::uint64_t pageStart = u64(40), dataStart = u64(48);
  const glm::dvec2 points[] = {{0.5, 0.5}, {13.5, 0.5}, {7.5, 7.5}, {0.5, 13.5}};
  std::vector<std::pair<std::uint64_t, std::size_t>> reads;
  int damaged = 0, sound = 0;
  for (std::uint64_t at = pageStart; at < dataStart; at += 1 + (dataStart - pageStart) / 60) {
    std::vector<std::byte> broken = bytes;
    broken[at] ^= std::byte(0x20);
    auto pages = WalkPages::open(std::make_shared<CountedRanges>(std::move(broken), reads), "grid");
    ASSERT_TRUE(pages) << "the root is sound";
    for (const glm::dvec2& point : points) {
      const auto place = (*pages)->placeAt(0, point);
      ++(place ? sound : damaged);
      if (!place) {
        EXPECT_NE(place.error().describe().find("grid"), std::string::npos);
      }
    }
  }
  EXPECT_GT(damaged, 0);
  EXPECT_GT(sound, damaged);
  bytes[100] ^= std::byte(1);
  EXPECT_FALSE(WalkPages::open(std::make_shared<CountedRanges>(bytes, reads), "grid"));
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
  std::vector<std::pair<std::uint64_t, std::size_t>> reads;
  auto pages = WalkPages::open(std::make_shared<CountedRanges>(bytes, reads), "grid");
  ASSERT_TRUE((*pages)->placeAt(0, {7.5, 3.5}));
  std::uint64_t read = 0;
  for (const auto& [at, size] : reads) read += size;
  EXPECT_EQ(read, (*pages)->stats().bytes);
  EXPECT_LT(read, dataStart / 5);
}

}  // namespace
}  // namespace acentric
