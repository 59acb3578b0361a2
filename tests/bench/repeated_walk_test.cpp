/// Walks that are made as they are read, and walks that are read page by page: both against the ordinary way,
/// in which all of a bundle is read from files.

#include "engine/bench/repeated_walk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <numeric>
#include <set>
#include <thread>

#include "engine/base/file.h"
#include "engine/export/bundle_json.h"
#include "engine/export/counted_ranges.h"
#include "engine/export/walk_write.h"
#include "engine/pipeline/paged_walk.h"
#include "engine/view/view_cameras.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

class RepeatedWalkTest : public FolderTest {
 protected:
  std::shared_ptr<const RepeatedCell> cell(Configuration configuration) {
    RepeatedCellOptions options;
    options.configuration = configuration;
    options.samplesPerDegree = 1;
    const fs::path folder = folder_ / nameOf(configuration);
    fs::create_directories(folder);
    auto made = RepeatedCell::make(options, folder, runner_);
    EXPECT_TRUE(made) << made.error().describe();
    return made ? *made : nullptr;
  }
  std::shared_ptr<const RepeatedWalk> walkOf(const std::shared_ptr<const RepeatedCell>& cell,
                                             std::uint64_t regions, int regionsPerPage = 16) {
    auto made = RepeatedWalk::make(cell, {regions, regionsPerPage}, runner_);
    EXPECT_TRUE(made) << made.error().describe();
    return made ? *made : nullptr;
  }
  /// All files as those of a bundle on disk; returns it.
  Bundle written(const std::shared_ptr<const RepeatedWalk>& walk, const fs::path& folder) {
    const auto files = walkFiles(std::make_unique<CountedRanges>(walk), "repeated");
    EXPECT_TRUE(files) << files.error().describe();
    auto bundle = readBundle(**files);
    EXPECT_TRUE(bundle) << bundle.error().describe();
    const auto put = [&](const BundleFile& file) {
      const auto bytes = (*files)->read(file.path, file.bytes);
      ASSERT_TRUE(bytes) << bytes.error().describe();
      fs::create_directories((folder / file.path).parent_path());
      ASSERT_TRUE(writeFileAtomically(folder / file.path, *bytes));
    };
    for (const BundleCamera& camera : bundle->storeys.front().cameras)
      put(camera.full->file), put(camera.coarse->file);
    for (const auto& local : bundle->storeys.front().local)
      if (local) put(local->file);
    EXPECT_TRUE(writeTextAtomically(folder / kBundleIndex, formatBundle(*bundle)));
    return std::move(*bundle);
  }
  PerspectiveView viewAt(const Layout& layout, const glm::dvec2& eye, double yaw) const {
    PerspectiveView view;
    view.eye = {eye, layout.eyeZ()};
    view.yawRadians = yaw;
    view.fovRadians = 1;
    view.width = 96, view.height = 64;
    return view;
  }
  Frame frameOf(const WalkScene& walk, const PerspectiveView& view) {
    auto frame = renderFrame(walk, view, {}, runner_);
    EXPECT_TRUE(frame);
    return frame ? std::move(*frame) : Frame{};
  }
  /// All of a bundle's folder loaded.
  std::shared_ptr<const LoadedWalk> whole(const fs::path& folder) {
    const auto shipped = openShippedWalk(folder, runner_);
    EXPECT_TRUE(shipped) << shipped.error().describe();
    WalkStreamOptions options;
    options.memoryBytes = std::numeric_limits<std::size_t>::max();
    options.threads = 0;
    WalkStream stream(startWalk(*shipped, 0, nullptr), options);
    const Layout& layout = *stream.walk()->walk.layout;
    std::vector<int> cameras(layout.cameras.size()), regions(layout.regions.size());
    std::iota(cameras.begin(), cameras.end(), 0), std::iota(regions.begin(), regions.end(), 0);
    EXPECT_TRUE(stream.complete(cameras, regions, runner_));
    EXPECT_TRUE(stream.takeWarnings().empty());
    return stream.walk();
  }
  std::unique_ptr<WalkPages> pagesOf(std::shared_ptr<const ByteRanges> ranges) {
    auto pages = WalkPages::open(std::move(ranges), "repeated");
    EXPECT_TRUE(pages) << pages.error().describe();
    return pages ? std::move(*pages) : nullptr;
  }
  static void settle(const PagedWalk& walk) {
    for (int i = 0; i < 30000 && walk.busy(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_FALSE(walk.busy());
  }

  TaskRunner runner_{1};
};

/// What the writer of walks says of the same bundle: pages differ in how regions are shared out among them,
/// so they are compared as what readers of all pages make of them.
TEST_F(RepeatedWalkTest, IsAWalkAsTheWriterOfWalksMakesThem) {
  for (const Configuration configuration : {Configuration::b, Configuration::e}) {
    const auto walk = walkOf(cell(configuration), 30);
    ASSERT_NE(walk, nullptr);
    const fs::path folder = folder_ / (std::string("bundle-") + nameOf(configuration));
    const Bundle bundle = written(walk, folder);
    const BundleStorey& storey = bundle.storeys.front();
    EXPECT_EQ(storey.layout.regions.size(), walk->regions());
    EXPECT_GE(walk->regions(), 30U);
    EXPECT_EQ(storey.layout.cameras.size(), walk->cameras());

    // The layout is that of a project with the same cells.
    LayoutSpec spec = storey.layout.spec;
    spec.configuration = configuration;
    spec.cellSize = RepeatedCellOptions().cellSize;
    for (int j = 0; j < walk->cells().y; ++j)
      for (int i = 0; i < walk->cells().x; ++i)
        for (int slot = 0; slot < Lattice::of(spec)->slots(); ++slot) spec.added.insert({i, j, slot});
    const Layout layout = buildLayout(spec).value();
    ASSERT_EQ(layout.regions.size(), storey.layout.regions.size());
    ASSERT_EQ(layout.cameras.size(), storey.layout.cameras.size());
    for (const Region& region : storey.layout.regions) {
      const auto its = layout.regionAt(region.polygon.centroid());
      ASSERT_TRUE(its);
      EXPECT_EQ(layout.regions[std::size_t(*its)].polygon.corners, region.polygon.corners);
      EXPECT_EQ(layout.regions[std::size_t(*its)].grown.corners, region.grown.corners);
      ASSERT_EQ(layout.regions[std::size_t(*its)].covers.size(), region.covers.size());
      for (std::size_t c = 0; c < region.covers.size(); ++c) {
        const Cover &a = layout.regions[std::size_t(*its)].covers[c], &b = region.covers[c];
        ASSERT_EQ(a.pieces.size(), b.pieces.size());
        for (std::size_t p = 0; p < a.pieces.size(); ++p) {
          EXPECT_EQ(a.pieces[p].apex, b.pieces[p].apex);
          EXPECT_EQ(a.pieces[p].role, b.pieces[p].role);
          EXPECT_EQ(a.pieces[p].low, b.pieces[p].low);
          EXPECT_EQ(storey.layout.cameras[std::size_t(b.pieces[p].camera)].position, b.pieces[p].apex);
        }
      }
    }

    // Written as a file, it is the same walk again.
    const fs::path file = folder_ / (std::string(nameOf(configuration)) + ".acentric");
    ASSERT_TRUE(writeWalk(folder, file, {16}));
    const auto again = readBundle(**bundleAt(file));
    ASSERT_TRUE(again) << again.error().describe();
    EXPECT_EQ(formatBundle(*again), formatBundle(bundle));
  }
}

TEST_F(RepeatedWalkTest, TheBakedCellIsLeftAsItIsAndTheOthersSeeTheSame) {
  const auto made = cell(Configuration::b);
  const auto walk = walkOf(made, 100);
  const fs::path folder = folder_ / "walk";
  const Bundle bundle = written(walk, folder);
  const auto files = bundleFolder(folder);
  const Layout& layout = bundle.storeys.front().layout;
  const auto baked = readBundle(folder_ / "b" / "bundle");
  ASSERT_TRUE(baked);
  const auto bakedFiles = bundleFolder(folder_ / "b" / "bundle");
  int same = 0;
  for (std::size_t c = 0; c < baked->storeys.front().cameras.size(); ++c) {
    const auto& full = baked->storeys.front().cameras[c].full;
    if (!full) continue;
    const LayoutCamera& camera = baked->storeys.front().layout.cameras[c];
    const auto bytes = bakedFiles->read(full->file.path, full->file.bytes);
    for (std::size_t other = 0; other < layout.cameras.size(); ++other) {
      const LayoutCamera& there = layout.cameras[other];
      if (there.lowAzimuth != camera.lowAzimuth) continue;
      const BundleCapture& described = *bundle.storeys.front().cameras[other].full;
      const auto capture = readBundleCapture(*files, bundle.storeys.front(), other, described);
      ASSERT_TRUE(capture) << capture.error().describe();
      EXPECT_EQ(glm::dvec2(capture->camera.centreOfProjection), there.position);
      if (there.position == camera.position) {
        EXPECT_EQ(described.file.hash, full->file.hash);
        EXPECT_EQ(*files->read(described.file.path, described.file.bytes), *bytes);
        ++same;
      }
    }
  }
  EXPECT_EQ(same, 6) << "the cameras of the cell at the origin";
}

/// Each page against the whole: the frames, whichever page an eye's region is read from.
TEST_F(RepeatedWalkTest, FramesOfAPagedWalkAreThoseOfTheWholeBundle) {
  const auto walk = walkOf(cell(Configuration::b), 90);
  written(walk, folder_ / "walk");
  const auto all = whole(folder_ / "walk");
  const Layout& layout = *all->walk.layout;
  WalkStreamOptions options;
  options.memoryBytes = std::size_t(1) << 30;
  options.where.eye = layout.regions.front().polygon.centroid();
  auto opened = PagedWalk::open(pagesOf(walk), 0, "repeated", options, runner_);
  ASSERT_TRUE(opened) << opened.error().describe();
  PagedWalk& paged = **opened;
  for (std::size_t r = 0; r < layout.regions.size(); r += 4) {
    const glm::dvec2 eye = layout.regions[r].polygon.centroid() + glm::dvec2(0.05, 0.3);
    const double yaw = 0.9 * double(r);
    paged.go({eye, yaw, {}});
    settle(paged);
    if (HasFatalFailure()) return;
    const auto snapshot = paged.walk();
    const auto region = snapshot->walk.layout->regionAt(eye);
    ASSERT_TRUE(region);
    EXPECT_EQ(snapshot->walk.layout->regions[std::size_t(*region)].id.i, *layout.regionAt(eye));
    EXPECT_LT(snapshot->walk.layout->regions.size(), layout.regions.size());
    const PerspectiveView view = viewAt(layout, eye, yaw);
    const Frame a = frameOf(snapshot->walk, view), b = frameOf(all->walk, view);
    EXPECT_EQ(a.stats.missingImages, 0);
    EXPECT_EQ(a.colour.pixels, b.colour.pixels) << r;
    EXPECT_EQ(a.holeCount(), b.holeCount());
  }
  EXPECT_TRUE(paged.takeWarnings().empty());
  EXPECT_GT(paged.stats().changes, 3);
}

TEST_F(RepeatedWalkTest, APagedWalkKeepsToItsLimitAndFramesNeverWait) {
  const auto walk = walkOf(cell(Configuration::b), 1000);
  const double across = double(walk->cells().x) * 4;
  WalkStreamOptions options;
  options.memoryBytes = std::size_t(5) << 20;
  options.where.eye = {0.3 * across, 20};
  auto opened = PagedWalk::open(pagesOf(walk), 0, "repeated", options, runner_);
  ASSERT_TRUE(opened) << opened.error().describe();
  PagedWalk& paged = **opened;
  settle(paged);
  int changes = 0;
  for (int step = 0; step < 60; ++step) {
    const glm::dvec2 eye = glm::dvec2(0.3 * across + 0.4 * step, 20);
    paged.go({eye, 0, {1, 0}});
    const auto snapshot = paged.walk();  // perhaps of the page before: it knows where the eye is all the same
    ASSERT_TRUE(snapshot->walk.layout->regionAt(eye)) << step;
    settle(paged);
    if (HasFatalFailure()) return;
    const auto settled = paged.walk();
    const Layout& layout = *settled->walk.layout;
    const auto needed = camerasOf(layout, viewAt(layout, eye, 0), {});
    ASSERT_GE(needed.region, 0);
    for (const int camera : needed.cameras) {
      EXPECT_NE(settled->walk.captures[std::size_t(camera)], nullptr);
      EXPECT_FALSE(settled->standsIn[std::size_t(camera)]);
    }
    changes = paged.stats().changes;
  }
  const PagedWalkStats stats = paged.stats();
  EXPECT_GT(changes, 3);
  EXPECT_GT(stats.captures.evictions, 0);
  EXPECT_EQ(stats.captures.beyondLimit, 0U);
  EXPECT_LT(stats.captures.peakBytes, 3 * options.memoryBytes / 2) << "a little more while pages change";
  EXPECT_LT(stats.regions, 150U);
  EXPECT_LT(stats.index.bytes, 3000000U);
}

/// What both pages have is not read again.
TEST_F(RepeatedWalkTest, CapturesStayInMemoryOverABorderOfPages) {
  const auto walk = walkOf(cell(Configuration::b), 100, 12);
  WalkStreamOptions options;
  options.memoryBytes = std::size_t(1) << 30;  // holds all of a page
  options.where.eye = {4, 10};
  auto opened = PagedWalk::open(pagesOf(walk), 0, "repeated", options, runner_);
  ASSERT_TRUE(opened) << opened.error().describe();
  PagedWalk& paged = **opened;
  settle(paged);
  const auto before = paged.walk();
  std::set<int> had;
  for (const LayoutCamera& camera : before->walk.layout->cameras) had.insert(camera.id.i);
  const int loads = paged.stats().captures.loads;
  EXPECT_EQ(loads, int(had.size()));
  for (int step = 0; paged.stats().changes == 0 && step < 100; ++step) {
    paged.go({{4 + 0.2 * step, 10}, 0, {1, 0}});
    settle(paged);
  }
  ASSERT_EQ(paged.stats().changes, 1);
  const auto after = paged.walk();
  int fresh = 0;
  for (std::size_t c = 0; c < after->walk.captures.size(); ++c) {
    const int number = after->walk.layout->cameras[c].id.i;
    if (!had.contains(number)) {
      ++fresh;
      continue;
    }
    const auto same = std::ranges::find(before->walk.layout->cameras, number,
                                        [](const LayoutCamera& camera) { return camera.id.i; });
    EXPECT_EQ(after->walk.captures[c],
              before->walk.captures[std::size_t(same - before->walk.layout->cameras.begin())]);
  }
  EXPECT_GT(fresh, 0);
  EXPECT_EQ(paged.stats().captures.loads, loads + fresh);
}

TEST_F(RepeatedWalkTest, WhatIsReadAtFirstDoesNotGrowWithTheRegions) {
  const auto made = cell(Configuration::b);
  std::vector<std::uint64_t> bytes;
  for (const std::uint64_t regions : {400, 6400}) {
    const auto walk = walkOf(made, regions, 32);
    auto pages = pagesOf(walk);
    const glm::dvec2 middle = pages->root().storeys.front().start;
    const auto place = pages->placeAt(0, middle);
    ASSERT_TRUE(place) << place.error().describe();
    const auto region = (*place)->here().layout.regionAt(middle);
    ASSERT_TRUE(region);
    EXPECT_EQ((*place)->own[std::size_t(*region)], 1);
    bytes.push_back(pages->stats().bytes);
  }
  EXPECT_LT(double(bytes[1]), 1.3 * double(bytes[0]));
}

}  // namespace
}  // namespace acentric
