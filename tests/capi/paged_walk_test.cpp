/// Walks that the C library reads page by page against the same walk of which it has the whole index.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <mutex>
#include <numeric>
#include <random>
#include <set>
#include <thread>

#include "engine/bench/repeated_walk.h"
#include "engine/capi/acentric_runtime.h"
#include "engine/export/counted_ranges.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// What is read of a walk, of which a part may be damaged.
class WatchedWalk {
 public:
  explicit WatchedWalk(std::shared_ptr<const RepeatedWalk> walk) : walk_(std::move(walk)) {}

  struct Read {
    std::uint64_t at = 0, bytes = 0;
    std::thread::id thread = {};
  };
  acentric_ranges ranges() {
    acentric_ranges ranges;
    ranges.user = this;
    ranges.size = [](void* user, std::uint64_t* bytes) -> acentric_status {
      *bytes = *static_cast<WatchedWalk*>(user)->walk_->size();
      return ACENTRIC_OK;
    };
    ranges.read = [](void* user, std::uint64_t at, void* into, std::uint64_t bytes) -> acentric_status {
      return static_cast<WatchedWalk*>(user)->read(at, into, bytes);
    };
    return ranges;
  }
  acentric_bundle* open() {
    acentric_bundle* bundle = nullptr;
    const acentric_ranges from = ranges();
    EXPECT_EQ(acentric_open_ranges(&from, &bundle), ACENTRIC_OK) << acentric_message(bundle);
    return bundle;
  }
  /// Of the index, since the last call.
  std::vector<Read> indexReads() {
    const std::lock_guard lock(mutex_);
    return std::exchange(reads_, {});
  }

  Read damaged;                          ///< its first byte is another
  acentric_status answer = ACENTRIC_OK;  ///< to whoever reads the index

 private:
  acentric_status read(std::uint64_t at, void* into, std::uint64_t bytes) {
    const bool index = at < walk_->indexBytes();
    if (index && answer != ACENTRIC_OK) return answer;
    if (!walk_->read(at, {static_cast<std::byte*>(into), bytes})) return ACENTRIC_ERROR_UNREADABLE;
    if (at == damaged.at && bytes == damaged.bytes) *static_cast<std::uint8_t*>(into) ^= 1;
    const std::lock_guard lock(mutex_);
    if (index) reads_.push_back({at, bytes, std::this_thread::get_id()});
    return ACENTRIC_OK;
  }
  std::shared_ptr<const RepeatedWalk> walk_;
  std::mutex mutex_;
  std::vector<Read> reads_;
};

std::uint64_t bytesOf(const std::vector<WatchedWalk::Read>& reads) {
  std::uint64_t bytes = 0;
  for (const auto& read : reads) bytes += read.bytes;
  return bytes;
}

/// The same with its whole index: the files of a bundle.
class WholeWalk {
 public:
  explicit WholeWalk(std::shared_ptr<const RepeatedWalk> walk) {
    auto files = walkFiles(std::make_unique<CountedRanges>(std::move(walk)), "whole");
    EXPECT_TRUE(files) << files.error().describe();
    files_ = std::move(*files);
  }
  acentric_bundle* open() {
    acentric_files files;
    files.user = this;
    files.size = [](void* user, const char* name, std::uint64_t* bytes) -> acentric_status {
      auto& self = *static_cast<WholeWalk*>(user);
      auto read = self.files_->read(name, std::uint64_t(1) << 30);
      if (!read) return ACENTRIC_ERROR_NOT_FOUND;
      *bytes = read->size();
      return ACENTRIC_OK;
    };
    files.read = [](void* user, const char* name, void* into, std::uint64_t bytes) -> acentric_status {
      const auto read = static_cast<WholeWalk*>(user)->files_->read(name, bytes);
      if (!read || read->size() != bytes) return ACENTRIC_ERROR_UNREADABLE;
      std::memcpy(into, read->data(), bytes);
      return ACENTRIC_OK;
    };
    acentric_bundle* bundle = nullptr;
    EXPECT_EQ(acentric_open_files(&files, &bundle), ACENTRIC_OK) << acentric_message(bundle);
    return bundle;
  }

 private:
  std::unique_ptr<BundleFiles> files_;
};

using Handle = std::unique_ptr<acentric_bundle, decltype(&acentric_close)>;
Handle handle(acentric_bundle* bundle) { return {bundle, &acentric_close}; }

struct Picture {
  std::vector<std::uint8_t> rgba, holes;
  std::vector<float> zDepth;
  bool operator==(const Picture&) const = default;
};

Picture draw(const Handle& bundle, const acentric_view& view) {
  const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
  Picture out{std::vector<std::uint8_t>(4 * pixels), std::vector<std::uint8_t>(pixels),
              std::vector<float>(pixels)};
  const acentric_picture picture{out.rgba.data(), 0, out.holes.data(), out.zDepth.data()};
  EXPECT_EQ(acentric_render(bundle.get(), &view, nullptr, &picture), ACENTRIC_OK)
      << acentric_message(bundle.get());
  return out;
}

std::vector<acentric_need> needsOf(const Handle& bundle, const acentric_view& view, acentric_needs& needs) {
  std::vector<acentric_need> list(200);
  EXPECT_EQ(acentric_view_needs(bundle.get(), &view, nullptr, list.data(), list.size(), &needs), ACENTRIC_OK)
      << acentric_message(bundle.get());
  list.resize(needs.count);
  return list;
}

acentric_view startOf(const Handle& bundle) {
  acentric_view view{};
  EXPECT_EQ(acentric_start_view(bundle.get(), &view), ACENTRIC_OK) << acentric_message(bundle.get());
  view.width = 96, view.height = 64;
  return view;
}

void expectSameCamera(const acentric_camera& a, const acentric_camera& b) {
  EXPECT_EQ(a.position[0], b.position[0]);
  EXPECT_EQ(a.position[1], b.position[1]);
  EXPECT_EQ(a.low_azimuth, b.low_azimuth);
  EXPECT_EQ(a.fov, b.fov);
  EXPECT_EQ(a.top_elevation, b.top_elevation);
  EXPECT_EQ(a.bottom_elevation, b.bottom_elevation);
  for (const auto rendition : {&acentric_camera::full, &acentric_camera::coarse}) {
    EXPECT_EQ((a.*rendition).columns, (b.*rendition).columns);
    EXPECT_EQ((a.*rendition).rows, (b.*rendition).rows);
    EXPECT_EQ((a.*rendition).samples, (b.*rendition).samples);
    EXPECT_EQ((a.*rendition).reflections, (b.*rendition).reflections);
    EXPECT_EQ((a.*rendition).file_bytes, (b.*rendition).file_bytes);
  }
}

void expectSameRegion(const acentric_region& a, const acentric_region& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.file_bytes, b.file_bytes);
  ASSERT_EQ(a.corners, b.corners);
  ASSERT_EQ(a.grown_corners, b.grown_corners);
  ASSERT_EQ(a.neighbour_count, b.neighbour_count);
  const auto same = [](const auto* x, const auto* y, std::int32_t count) {
    return std::equal(x, x + count, y);
  };
  EXPECT_TRUE(same(a.polygon, b.polygon, 2 * a.corners));
  EXPECT_TRUE(same(a.grown, b.grown, 2 * a.grown_corners));
  EXPECT_TRUE(same(a.neighbours, b.neighbours, a.neighbour_count));
}

class CapiPagedWalk : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("acentric-capi-paged-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    RepeatedCellOptions options;
    options.samplesPerDegree = 1;
    auto made = RepeatedCell::make(options, folder, runner);
    ASSERT_TRUE(made) << made.error().describe();
    cell = *made;
    walk = walkOf(250);
  }
  static void TearDownTestSuite() {
    fs::remove_all(folder);
    cell = nullptr, walk = nullptr;
  }
  static std::shared_ptr<const RepeatedWalk> walkOf(std::uint64_t regions, int regionsPerPage = 16) {
    auto made = RepeatedWalk::make(cell, {regions, regionsPerPage}, runner);
    EXPECT_TRUE(made) << made.error().describe();
    return made ? *made : nullptr;
  }
  /// Along and across the rows of cells, over many borders of pages.
  static std::vector<acentric_view> path(const acentric_view& like) {
    std::vector<acentric_view> views;
    const double across = glm::length(cell->step(1, 0)) * walk->cells().x;
    for (int i = 0; i < 60; ++i) {
      acentric_view view = like;
      const double along = double(i) / 59;
      view.eye[0] = across * (0.05 + 0.85 * along), view.eye[1] = across * (0.1 + 0.7 * along * along);
      view.yaw = 0.37 * i, view.pitch = 0.2 * std::sin(i);
      views.push_back(view);
    }
    return views;
  }

  static inline fs::path folder;
  static inline TaskRunner runner{1};
  static inline std::shared_ptr<const RepeatedCell> cell;
  static inline std::shared_ptr<const RepeatedWalk> walk;
};

TEST_F(CapiPagedWalk, FramesAndNeedsAlongAPathAreThoseOfTheWholeIndex) {
  WatchedWalk watched(walk);
  WholeWalk all(walk);
  const Handle paged = handle(watched.open()), whole = handle(all.open());
  EXPECT_EQ(watched.indexReads().size(), 2U) << "header and root";
  const acentric_view start = startOf(paged);
  EXPECT_EQ(std::memcmp(start.eye, startOf(whole).eye, sizeof start.eye), 0);
  std::size_t pages = 0;
  int drawn = 0;
  for (const acentric_view& view : path(start)) {
    std::int32_t storey[2], region[2];
    const acentric_bundle* const both[2] = {paged.get(), whole.get()};
    for (int i = 0; i < 2; ++i) {
      auto* bundle = const_cast<acentric_bundle*>(both[i]);
      EXPECT_EQ(acentric_storey_at(bundle, view.eye, &storey[i]), ACENTRIC_OK);
      EXPECT_EQ(acentric_region_at(bundle, 0, view.eye, &region[i]), ACENTRIC_OK);
      const std::int32_t detail = drawn % 3 == 1 ? ACENTRIC_COARSE : ACENTRIC_FULL;
      ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, detail), ACENTRIC_OK) << acentric_message(bundle);
    }
    EXPECT_EQ(storey[0], storey[1]);
    EXPECT_EQ(region[0], region[1]);
    acentric_needs needs[2];
    const auto list = needsOf(paged, view, needs[0]), expected = needsOf(whole, view, needs[1]);
    EXPECT_EQ(needs[0].region, needs[1].region);
    EXPECT_EQ(needs[0].region, region[0]);
    ASSERT_EQ(list.size(), expected.size());
    for (std::size_t n = 0; n < list.size(); ++n) {
      EXPECT_EQ(list[n].kind, expected[n].kind);
      EXPECT_EQ(list[n].number, expected[n].number);
      EXPECT_EQ(list[n].loaded, expected[n].loaded);
      EXPECT_EQ(list[n].roles, expected[n].roles);
    }
    EXPECT_EQ(acentric_memory(paged.get()), acentric_memory(whole.get()));
    const Picture a = draw(paged, view), b = draw(whole, view);
    EXPECT_TRUE(a == b) << "step " << drawn;
    EXPECT_LT(std::ranges::count(a.holes, 255), 96 * 64 / 2);
    if (++drawn % 20 == 0)
      for (const Handle& bundle : {std::cref(paged), std::cref(whole)}) {
        EXPECT_EQ(acentric_unload_beyond(bundle.get(), &view, nullptr, 3 << 20), ACENTRIC_OK);
        EXPECT_LE(acentric_memory(bundle.get()), acentric_memory(paged.get()));
      }
    pages += watched.indexReads().size();
  }
  EXPECT_GT(pages, 6U) << "the path crosses borders of pages";
}

TEST_F(CapiPagedWalk, PlacesAreThoseOfTheWholeIndex) {
  WatchedWalk watched(walk);
  WholeWalk all(walk);
  const Handle paged = handle(watched.open()), whole = handle(all.open());
  std::mt19937 random(5);
  const double across = glm::length(cell->step(1, 0)) * walk->cells().x;
  std::uniform_real_distribution<double> anywhere(-0.3 * across, 1.3 * across);
  int outside = 0;
  for (int i = 0; i < 300; ++i) {
    double at[2][2];
    std::int32_t region[2];
    acentric_status found[2], moved[2];
    at[0][0] = at[1][0] = anywhere(random), at[0][1] = at[1][1] = anywhere(random);
    for (int b = 0; b < 2; ++b) {
      acentric_bundle* bundle = b == 0 ? paged.get() : whole.get();
      found[b] = acentric_region_at(bundle, 0, at[b], &region[b]);
      moved[b] = acentric_clamp(bundle, 0, at[b]);
    }
    outside += found[0] == ACENTRIC_ERROR_OUTSIDE;
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(region[0], region[1]);
    EXPECT_EQ(moved[0], ACENTRIC_OK);
    EXPECT_EQ(moved[1], ACENTRIC_OK);
    EXPECT_EQ(at[0][0], at[1][0]);
    EXPECT_EQ(at[0][1], at[1][1]);
  }
  EXPECT_GT(outside, 30);
  EXPECT_LT(outside, 270);
  const double nowhere[3] = {std::nan(""), HUGE_VAL, 0};
  double place[2] = {HUGE_VAL, 0};
  std::int32_t number = 0;
  EXPECT_EQ(acentric_region_at(paged.get(), 0, nowhere, &number), ACENTRIC_ERROR_OUTSIDE);
  EXPECT_EQ(number, -1);
  EXPECT_EQ(acentric_clamp(paged.get(), 0, place), ACENTRIC_ERROR_OUTSIDE);
  EXPECT_EQ(acentric_storey_at(paged.get(), nowhere, &number), ACENTRIC_OK);
  EXPECT_EQ(number, 0);
}

TEST_F(CapiPagedWalk, AllRegionsAndCamerasAreThoseOfTheWholeIndexInAnyOrder) {
  WholeWalk all(walk);
  const Handle whole = handle(all.open());
  acentric_storey counts, expectedCounts;
  ASSERT_EQ(acentric_get_storey(whole.get(), 0, &expectedCounts), ACENTRIC_OK);
  std::mt19937 random(3);
  for (const bool shuffled : {false, true}) {
    WatchedWalk watched(walk);
    const Handle paged = handle(watched.open());
    ASSERT_EQ(acentric_get_storey(paged.get(), 0, &counts), ACENTRIC_OK);
    ASSERT_EQ(counts.regions, expectedCounts.regions);
    ASSERT_EQ(counts.cameras, expectedCounts.cameras);
    EXPECT_EQ(counts.regions, int(walk->regions()));
    std::vector<std::int32_t> regions(std::size_t(counts.regions)), cameras(std::size_t(counts.cameras));
    std::iota(regions.begin(), regions.end(), 0), std::iota(cameras.begin(), cameras.end(), 0);
    if (shuffled) std::ranges::shuffle(regions, random), std::ranges::shuffle(cameras, random);
    std::vector<acentric_region> told(regions.size());
    for (const std::int32_t r : regions)
      ASSERT_EQ(acentric_get_region(paged.get(), 0, r, &told[std::size_t(r)]), ACENTRIC_OK)
          << acentric_message(paged.get());
    for (const std::int32_t c : cameras) {
      acentric_camera camera, expected;
      ASSERT_EQ(acentric_get_camera(paged.get(), 0, c, &camera), ACENTRIC_OK)
          << acentric_message(paged.get());
      ASSERT_EQ(acentric_get_camera(whole.get(), 0, c, &expected), ACENTRIC_OK);
      expectSameCamera(camera, expected);
    }
    // What was given out first is still there, and the same.
    for (std::size_t r = 0; r < told.size(); ++r) {
      acentric_region expected, again;
      ASSERT_EQ(acentric_get_region(whole.get(), 0, int(r), &expected), ACENTRIC_OK);
      expectSameRegion(told[r], expected);
      ASSERT_EQ(acentric_get_region(paged.get(), 0, int(r), &again), ACENTRIC_OK);
      EXPECT_EQ(again.polygon, told[r].polygon);
      EXPECT_EQ(again.neighbours, told[r].neighbours);
    }
    EXPECT_LT(watched.indexReads().size(), 3 * walk->pages() + 10) << "leaves are looked through once";
    EXPECT_EQ(acentric_get_region(paged.get(), 0, counts.regions, &told[0]), ACENTRIC_ERROR_ARGUMENT);
    EXPECT_EQ(acentric_get_region(paged.get(), 0, -1, &told[0]), ACENTRIC_ERROR_ARGUMENT);
  }
}

TEST_F(CapiPagedWalk, NumbersOfTheViewAreKnownWithoutAnotherPage) {
  WatchedWalk watched(walk);
  const Handle paged = handle(watched.open());
  const acentric_view view = startOf(paged);
  acentric_needs needs;
  const auto list = needsOf(paged, view, needs);
  EXPECT_GT(watched.indexReads().size(), 2U);
  for (const acentric_need& need : list) {
    acentric_camera camera;
    acentric_region region;
    if (need.kind == ACENTRIC_CAPTURE) {
      EXPECT_EQ(acentric_get_camera(paged.get(), 0, need.number, &camera), ACENTRIC_OK);
      EXPECT_EQ(acentric_load_capture(paged.get(), 0, need.number, ACENTRIC_COARSE), ACENTRIC_OK);
    } else {
      ASSERT_EQ(acentric_get_region(paged.get(), 0, need.number, &region), ACENTRIC_OK);
      for (int n = 0; n < region.neighbour_count; ++n)
        EXPECT_EQ(acentric_load_region(paged.get(), 0, region.neighbours[n]), ACENTRIC_OK);
    }
  }
  EXPECT_TRUE(watched.indexReads().empty());
  // Regions around the page are in it without all of their neighbours: they take the page that has these.
  acentric_region region;
  ASSERT_EQ(acentric_get_region(paged.get(), 0, needs.region, &region), ACENTRIC_OK);
  std::set<std::int32_t> around{needs.region};
  for (int step = 0; step < 3; ++step)
    for (const std::int32_t r : std::set(around)) {
      ASSERT_EQ(acentric_get_region(paged.get(), 0, r, &region), ACENTRIC_OK);
      around.insert(region.neighbours, region.neighbours + region.neighbour_count);
    }
  EXPECT_GT(around.size(), 30U);
  EXPECT_LT(watched.indexReads().size(), walk->pages() / 2) << "of those nearby";
}

TEST_F(CapiPagedWalk, WhatIsReadBeforeTheFirstFrameDoesNotGrowWithTheRegions) {
  std::vector<std::uint64_t> bytes, requests;
  for (const std::uint64_t regions : {1000, 20000}) {
    WatchedWalk watched(walkOf(regions, 64));
    const Handle paged = handle(watched.open());
    const acentric_view view = startOf(paged);
    ASSERT_EQ(acentric_load_view(paged.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
    const Picture picture = draw(paged, view);
    EXPECT_LT(std::ranges::count(picture.holes, 255), 96 * 64 / 2);
    const auto reads = watched.indexReads();
    bytes.push_back(bytesOf(reads)), requests.push_back(reads.size());
  }
  EXPECT_LT(bytes[1], 1'000'000U);
  EXPECT_LT(double(bytes[1]), 1.5 * double(bytes[0]));
  EXPECT_LE(requests[1], requests[0] + 3);
}

TEST_F(CapiPagedWalk, ADamagedPageIsNamedAndTheWalkGoesOnElsewhere) {
  WatchedWalk watched(walk);
  acentric_view view{}, far{};
  std::int32_t farRegion = -1, farCamera = -1;
  {
    const Handle sound = handle(watched.open());
    view = startOf(sound), far = path(view).front();
    acentric_needs needs;
    needsOf(sound, view, needs);
    watched.indexReads();
    const auto list = needsOf(sound, far, needs);
    farRegion = needs.region, farCamera = list.front().number;
    const auto reads = watched.indexReads();
    ASSERT_FALSE(reads.empty());
    watched.damaged = reads.back();
  }
  const Handle paged = handle(watched.open());
  ASSERT_EQ(acentric_load_view(paged.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const Picture before = draw(paged, view);
  const auto expectNamed = [&](acentric_status status) {
    EXPECT_EQ(status, ACENTRIC_ERROR_MALFORMED);
    EXPECT_NE(std::string(acentric_message(paged.get())).find("walk, the page at"), std::string::npos)
        << acentric_message(paged.get());
  };
  std::int32_t number = 0;
  acentric_region region;
  expectNamed(acentric_load_view(paged.get(), &far, nullptr, ACENTRIC_FULL));
  expectNamed(acentric_request_view(paged.get(), &far, nullptr, ACENTRIC_FULL));
  expectNamed(acentric_region_at(paged.get(), 0, far.eye, &number));
  EXPECT_EQ(number, -1);
  expectNamed(acentric_get_region(paged.get(), 0, farRegion, &region));
  EXPECT_EQ(draw(paged, view), before);
  // All others are found, and what the damaged page shares with them.
  int regions = 0, lost = 0;
  for (int r = 0; r < int(walk->regions()); ++r) {
    const acentric_status told = acentric_get_region(paged.get(), 0, r, &region);
    told == ACENTRIC_OK ? ++regions : ++lost;
    if (told != ACENTRIC_OK) expectNamed(told);
  }
  EXPECT_GT(lost, 0);
  EXPECT_LE(lost, 16);
  EXPECT_GT(regions, lost);
  watched.damaged = {};
  EXPECT_EQ(acentric_get_region(paged.get(), 0, farRegion, &region), ACENTRIC_OK) << "it is tried again";
  EXPECT_EQ(acentric_load_capture(paged.get(), 0, farCamera, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_load_view(paged.get(), &far, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
}

TEST_F(CapiPagedWalk, APageThatCannotBeHadIsNoEyeOutsideAndIsTriedAgain) {
  WatchedWalk watched(walk);
  const Handle paged = handle(watched.open());
  for (const acentric_status answer : {ACENTRIC_ERROR_NOT_FOUND, ACENTRIC_ERROR_UNREADABLE}) {
    watched.answer = answer;
    acentric_view view{{4, 4, 1.6}, 0, 0, 1, 96, 64};
    acentric_camera camera;
    EXPECT_EQ(acentric_load_view(paged.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_ERROR_UNREADABLE);
    EXPECT_EQ(acentric_start_view(paged.get(), &view), answer);
    EXPECT_EQ(acentric_get_camera(paged.get(), 0, 7, &camera), answer);
  }
  watched.answer = ACENTRIC_OK;
  const acentric_view view = startOf(paged);
  acentric_camera camera;
  EXPECT_EQ(acentric_get_camera(paged.get(), 0, 7, &camera), ACENTRIC_OK);
  EXPECT_EQ(acentric_load_view(paged.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
}

TEST_F(CapiPagedWalk, WhatIsLoadedOutlivesItsPage) {
  WatchedWalk watched(walk);
  const Handle paged = handle(watched.open());
  const acentric_view start = startOf(paged);
  const auto views = path(start);
  acentric_needs needs;
  ASSERT_EQ(acentric_load_view(paged.get(), &views.front(), nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const auto list = needsOf(paged, views.front(), needs);
  const std::int32_t region = needs.region;
  const Picture first = draw(paged, views.front());
  const std::uint64_t memory = acentric_memory(paged.get());
  acentric_capture_data data;
  ASSERT_EQ(acentric_get_capture_data(paged.get(), 0, list.front().number, ACENTRIC_FULL, &data),
            ACENTRIC_OK);
  const std::vector<acentric_sample> samples(data.surfaces.samples,
                                             data.surfaces.samples + data.surfaces.count);
  for (const acentric_view& view : views) draw(paged, view);  // over all pages, with what is there
  EXPECT_EQ(acentric_memory(paged.get()), memory);
  acentric_capture_data again;
  ASSERT_EQ(acentric_get_capture_data(paged.get(), 0, list.front().number, ACENTRIC_FULL, &again),
            ACENTRIC_OK);
  EXPECT_EQ(again.surfaces.samples, data.surfaces.samples);
  EXPECT_EQ(std::memcmp(samples.data(), again.surfaces.samples, samples.size() * sizeof samples[0]), 0);
  for (const acentric_need& need : needsOf(paged, views.front(), needs))
    EXPECT_EQ(need.loaded, ACENTRIC_FULL);
  EXPECT_TRUE(draw(paged, views.front()) == first) << "back where it was";
  draw(paged, views.back());
  watched.indexReads();
  for (const acentric_need& need : list) {
    if (need.kind != ACENTRIC_CAPTURE) continue;
    EXPECT_EQ(acentric_unload_capture(paged.get(), 0, need.number, ACENTRIC_FULL), ACENTRIC_OK);
  }
  EXPECT_EQ(acentric_unload_region(paged.get(), 0, region), ACENTRIC_OK);
  EXPECT_EQ(acentric_unload_textures(paged.get()), ACENTRIC_OK);
  EXPECT_EQ(acentric_memory(paged.get()), 0U);
  EXPECT_TRUE(watched.indexReads().empty()) << "unloading reads nothing";
}

TEST_F(CapiPagedWalk, LoadsInTheBackgroundOverBordersOfPages) {
  WatchedWalk watched(walk);
  WholeWalk all(walk);
  const Handle paged = handle(watched.open()), whole = handle(all.open());
  ASSERT_EQ(acentric_set_threads(paged.get(), 2), ACENTRIC_OK);
  const acentric_view start = startOf(paged);
  const auto views = path(start);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const acentric_view& view = views[i];
    ASSERT_EQ(acentric_request_view(paged.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK)
        << acentric_message(paged.get());
    if (i % 10 != 9) continue;  // what was begun for another page still comes
    while (acentric_waiting(paged.get()) > 0) {
      EXPECT_EQ(acentric_poll(paged.get(), nullptr), ACENTRIC_OK) << acentric_message(paged.get());
      std::this_thread::yield();
    }
    ASSERT_EQ(acentric_load_view(whole.get(), &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
    EXPECT_TRUE(draw(paged, view) == draw(whole, view)) << i;
  }
}

TEST_F(CapiPagedWalk, PagesBesideTheEyesAreReadInTheBackground) {
  WatchedWalk watched(walk);
  const Handle paged = handle(watched.open());
  acentric_view view = startOf(paged);
  ASSERT_EQ(acentric_request_view(paged.get(), &view, nullptr, ACENTRIC_COARSE), ACENTRIC_OK);
  std::vector<WatchedWalk::Read> reads;
  watched.indexReads();
  for (int step = 0; step < 120; ++step) {
    view.eye[0] += 0.1;
    std::int32_t region = -1;
    if (acentric_region_at(paged.get(), 0, view.eye, &region) != ACENTRIC_OK) break;
    ASSERT_EQ(acentric_request_view(paged.get(), &view, nullptr, ACENTRIC_COARSE), ACENTRIC_OK);
    while (acentric_waiting(paged.get()) > 0) {
      EXPECT_EQ(acentric_poll(paged.get(), nullptr), ACENTRIC_OK);
      std::this_thread::yield();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ranges::copy(watched.indexReads(), std::back_inserter(reads));
  }
  EXPECT_GE(reads.size(), 3U) << "the way crosses borders of pages";
  const auto waited = std::ranges::count(reads, std::this_thread::get_id(), &WatchedWalk::Read::thread);
  EXPECT_LE(2 * std::size_t(waited), reads.size()) << "whatever else this machine does";
}

TEST_F(CapiPagedWalk, ModelsAreThoseOfTheWholeIndex) {
  WatchedWalk watched(walk);
  WholeWalk all(walk);
  const Handle paged = handle(watched.open()), whole = handle(all.open());
  acentric_storey storey;
  ASSERT_EQ(acentric_get_storey(paged.get(), 0, &storey), ACENTRIC_OK);
  for (const auto& [kind, number] : {std::pair{ACENTRIC_REGION, storey.regions / 2},
                                     {ACENTRIC_REGION, 1},
                                     {ACENTRIC_CAPTURE, storey.cameras / 3},
                                     {ACENTRIC_CAPTURE, storey.cameras - 1}}) {
    const acentric_model *a = nullptr, *b = nullptr;
    ASSERT_EQ(acentric_make_model(paged.get(), 0, kind, number, ACENTRIC_FULL, 256, &a), ACENTRIC_OK)
        << acentric_message(paged.get());
    ASSERT_EQ(acentric_make_model(whole.get(), 0, kind, number, ACENTRIC_FULL, 256, &b), ACENTRIC_OK);
    EXPECT_EQ(std::memcmp(a->origin, b->origin, sizeof a->origin), 0);
    ASSERT_EQ(a->vertex_count, b->vertex_count);
    EXPECT_GT(a->vertex_count, 0U);
    EXPECT_EQ(std::memcmp(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices), 0);
    acentric_free_model(a), acentric_free_model(b);
  }
}

}  // namespace
}  // namespace acentric
