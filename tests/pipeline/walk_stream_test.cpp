/// The walk that is read while it is being walked: from a store that is as slow as the test wants, and from a
/// real one.

#include "engine/pipeline/walk_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <set>
#include <thread>

#include "engine/base/gate.h"
#include "engine/store/capture_store.h"
#include "engine/view/view_cameras.h"
#include "tests/layout/layout_fixtures.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

/// Answers as soon as the gate lets it.
class SlowSource final : public WalkSource {
 public:
  explicit SlowSource(const Layout& layout) : layout_(layout) {}

  std::uint64_t storedBytes(int camera, Detail detail) const override {
    if (detail == Detail::coarse) return previews ? 4000 : 0;
    return missing.contains(camera) ? 0 : 50000;
  }
  Result<Capture> capture(int camera, Detail detail) const override {
    (detail == Detail::full ? gate : coarseGate).pass();
    {
      const std::lock_guard lock(mutex_);
      asked_.emplace_back(camera, detail);
    }
    if (detail == Detail::full && damaged.contains(camera))
      return fail(ErrorKind::malformed, "is damaged", "camera " + std::to_string(camera));
    SyntheticOptions options;
    options.columns = detail == Detail::full ? 64 : 16;
    options.rows = detail == Detail::full ? 60 : 15;
    options.seed = unsigned(camera);
    Capture capture = syntheticCapture(options);
    const LayoutCamera& at = layout_.cameras[std::size_t(camera)];
    capture.camera.centreOfProjection = {at.position, layout_.eyeZ()};
    capture.camera.lowAzimuth = at.lowAzimuth;
    capture.camera.fovRadians = at.fovRadians;
    return capture;
  }
  LocalPart local(int, const std::stop_token&) const override {
    return {std::make_shared<const LocalGeometry>(), {}, {}};
  }
  std::vector<std::pair<int, Detail>> asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

  void forget() { asked_.clear(); }

  mutable Gate gate, coarseGate;
  bool previews = true;
  std::set<int> missing, damaged;

 private:
  const Layout& layout_;
  mutable std::mutex mutex_;
  mutable std::vector<std::pair<int, Detail>> asked_;
};

class SlowWalk : public testing::Test {
 protected:
  SlowWalk()
      : layout_(std::make_shared<const Layout>(test::makeLayout(Configuration::b, {}, 3))),
        source_(std::make_shared<SlowSource>(*layout_)) {
    bytesOfOne();
  }
  ~SlowWalk() override { openGates(); }

  WalkStart start() const {
    WalkStart start;
    start.walk.walk.layout = layout_;
    start.walk.walk.captures.resize(layout_->cameras.size());
    start.walk.walk.local.resize(layout_->regions.size());
    start.walk.keys.resize(layout_->cameras.size());
    start.walk.standsIn.assign(layout_->cameras.size(), false);
    start.source = source_;
    return start;
  }
  void openGates() const {
    source_->gate.open();
    source_->coarseGate.open();
  }
  static void settle(const WalkStream& stream) {
    for (int i = 0; i < 10000 && stream.busy(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_FALSE(stream.busy());
  }
  /// What a capture takes in memory.
  std::size_t bytesOfOne() {
    if (each_ > 0) return each_;
    WalkStreamOptions options;
    options.threads = 0;
    WalkStream stream(start(), options);
    TaskRunner runner;
    EXPECT_TRUE(stream.complete(std::vector{0}, {}, runner));
    source_->forget();
    return each_ = stream.stats().bytes;
  }
  std::set<int> neededAt(const glm::dvec2& eye) const {
    std::set<int> needed;
    for (const Cover& cover : layout_->regions[std::size_t(*layout_->regionAt(eye))].covers)
      for (const Piece& piece : cover.pieces) needed.insert(piece.camera);
    return needed;
  }
  PerspectiveView viewAt(const glm::dvec2& eye, double yaw) const {
    PerspectiveView view;
    view.eye = {eye, layout_->eyeZ()};
    view.yawRadians = yaw;
    view.width = 64;
    view.height = 40;
    return view;
  }

  std::shared_ptr<const Layout> layout_;
  std::shared_ptr<SlowSource> source_;
  std::size_t each_ = 0;
};

TEST_F(SlowWalk, NoFrameWaitsForTheDisk) {
  source_->gate.close();
  source_->coarseGate.close();  // the disk does not answer at all
  WalkStream stream(start(), {});
  TaskRunner runner;
  for (int i = 0; i < 50; ++i) {  // would never end if any of it waited
    const glm::dvec2 eye(0.01 * i, 0);
    stream.go({eye, 0.1 * i, {1, 0}});
    const auto frame = renderFrame(stream.walk()->walk, viewAt(eye, 0.1 * i), {}, runner);
    ASSERT_TRUE(frame);
    EXPECT_GT(frame->stats.missingImages, 0);
  }
  EXPECT_TRUE(stream.busy());
  openGates();
  settle(stream);
  EXPECT_EQ(renderFrame(stream.walk()->walk, viewAt({0, 0}, 0), {}, runner)->stats.missingImages, 0);
}

TEST_F(SlowWalk, CoarseOnesStandInUntilTheCapturesAreThere) {
  source_->gate.close();
  WalkStream stream(start(), {});
  const auto needed = neededAt({0, 0});
  const auto allThere = [&] {
    const auto walk = stream.walk();
    return std::ranges::all_of(needed, [&](int c) { return walk->walk.captures[std::size_t(c)] != nullptr; });
  };
  for (int i = 0; i < 10000 && !allThere(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto coarse = stream.walk();
  for (const int c : needed) {
    EXPECT_TRUE(coarse->standsIn[std::size_t(c)]);
    EXPECT_EQ(coarse->walk.captures[std::size_t(c)]->camera.columns, 16);
  }
  openGates();
  settle(stream);
  const auto full = stream.walk();
  for (std::size_t c = 0; c < full->walk.captures.size(); ++c) {
    EXPECT_FALSE(full->standsIn[c]);
    EXPECT_EQ(full->walk.captures[c]->camera.columns, 64);
  }
  EXPECT_TRUE(coarse->standsIn[std::size_t(*needed.begin())]) << "a snapshot never changes";
  EXPECT_EQ(stream.stats().coarse, 0);
  EXPECT_EQ(stream.stats().full, int(layout_->cameras.size()));
}

TEST_F(SlowWalk, ReadsWhatTheEyesRegionNeedsFirst) {
  WalkStreamOptions options;
  options.where = {{0.1, 0}, 0, {}};
  WalkStream stream(start(), options);
  settle(stream);
  const auto needed = neededAt({0.1, 0});
  const auto asked = source_->asked();
  ASSERT_GE(asked.size(), 2 * needed.size());
  // When the last of them is on its way, others may overtake it.
  for (std::size_t n = 0; n + 1 < 2 * needed.size(); ++n) {
    EXPECT_TRUE(needed.contains(asked[n].first)) << n;
    EXPECT_EQ(asked[n].second, n < needed.size() ? Detail::coarse : Detail::full) << n;
  }
}

TEST_F(SlowWalk, KeepsToTheLimitAlongAWalkAndTheCoarseOnesStay) {
  for (const bool previews : {true, false}) {
    source_->previews = previews;
    const std::size_t most = 60;
    WalkStreamOptions options;
    options.memoryBytes = most * bytesOfOne();
    options.threads = 2;
    ASSERT_GT(layout_->cameras.size(), most);
    WalkStream stream(start(), options);
    settle(stream);
    for (int i = 0; i <= 20; ++i) {
      const glm::dvec2 eye(-4 + 0.4 * i, 0.1);
      stream.go({eye, 0, {1, 0}});
      settle(stream);
      const auto walk = stream.walk();
      for (const int c : neededAt(eye)) EXPECT_FALSE(walk->standsIn[std::size_t(c)]) << i;
      for (const int c : neededAt(eye)) EXPECT_NE(walk->walk.captures[std::size_t(c)], nullptr) << i;
    }
    const WalkStreamStats stats = stream.stats();
    EXPECT_EQ(stats.beyondLimit, 0U);
    EXPECT_GT(stats.evictions, 0);
    EXPECT_LE(stats.bytes, options.memoryBytes);
    EXPECT_LE(stats.peakBytes, options.memoryBytes + 3 * bytesOfOne());
    EXPECT_GE(stats.coarse, int(layout_->cameras.size()) - int(most)) << "stand in for what is not there";
    EXPECT_EQ(stats.coarse + stats.full, int(layout_->cameras.size())) << previews;
  }
}

TEST_F(SlowWalk, ALimitBelowWhatTheRegionNeedsIsExceededAndThatIsSaid) {
  WalkStreamOptions options;
  options.memoryBytes = 4 * bytesOfOne();
  WalkStream stream(start(), options);
  settle(stream);
  EXPECT_GT(stream.stats().beyondLimit, 0U);
  const auto walk = stream.walk();
  for (const int c : neededAt({0, 0})) EXPECT_FALSE(walk->standsIn[std::size_t(c)]);
}

TEST_F(SlowWalk, WhatIsEvictedIsGoneWhenItsLastFrameIsDone) {
  WalkStreamOptions options;
  options.memoryBytes = 30 * bytesOfOne();
  options.where.eye = {-4, 0};
  WalkStream stream(start(), options);
  settle(stream);
  auto held = stream.walk();
  std::weak_ptr<const DisplayCapture> left = held->walk.captures[std::size_t(*neededAt({-4, 0}).begin())];
  ASSERT_FALSE(left.expired());
  for (int i = 0; i <= 16; ++i) {
    stream.go({{-4 + 0.5 * i, 0}, 0, {1, 0}});
    settle(stream);
  }
  EXPECT_FALSE(left.expired()) << "the frame still has it";
  held.reset();
  for (int i = 0; i < 2000 && !left.expired(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(left.expired()) << "cleared away by a loader, not by the frame";
}

/// Coarse copies that are made on the way take more than was guessed: at some limit the last one does not
/// fit.
TEST_F(SlowWalk, ComesToRestWhateverTheLimit) {
  for (int k = 0; k < 24; ++k) {
    WalkStreamOptions options;
    options.memoryBytes = 30 * bytesOfOne() + std::size_t(k) * 800;
    options.where.eye = {-4, 0};
    WalkStream stream(start(), options);
    for (int i = 0; i <= 16; ++i) {
      stream.go({{-4 + 0.5 * i, 0}, 0, {1, 0}});
      settle(stream);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_F(SlowWalk, ADamagedCaptureIsToldOfOnceAndItsCoarseOneStays) {
  const int bad = *neededAt({0, 0}).begin();
  source_->damaged = {bad};
  WalkStream stream(start(), {});
  settle(stream);
  const auto walk = stream.walk();
  EXPECT_EQ(stream.takeWarnings(),
            std::vector<std::string>{"camera " + std::to_string(bad) + ": is damaged"});
  EXPECT_TRUE(walk->standsIn[std::size_t(bad)]);
  stream.go({{1, 0}, 0, {}});
  stream.go({{0, 0}, 2, {}});
  settle(stream);
  EXPECT_TRUE(stream.takeWarnings().empty());
  EXPECT_EQ(stream.stats().full, int(layout_->cameras.size()) - 1);
  const auto asked = source_->asked();
  EXPECT_EQ(std::ranges::count(asked, std::pair{bad, Detail::full}), 1);
}

TEST_F(SlowWalk, WithoutThreadsItReadsWhatItIsToldAndEvictsTheLongestUnused) {
  WalkStreamOptions options;
  options.threads = 0;
  options.memoryBytes = 3 * bytesOfOne() + bytesOfOne() / 2;
  WalkStream stream(start(), options);
  TaskRunner runner(1);
  EXPECT_FALSE(stream.busy());
  for (const auto& cameras : std::vector<std::vector<int>>{{0, 1}, {2}, {0}, {3}})
    ASSERT_TRUE(stream.complete(cameras, std::vector{0}, runner));
  const auto walk = stream.walk();
  for (const int c : {0, 2, 3}) EXPECT_NE(walk->walk.captures[std::size_t(c)], nullptr) << c;
  EXPECT_EQ(walk->walk.captures[1], nullptr) << "used longest ago";
  EXPECT_NE(walk->walk.local[0], nullptr);
  EXPECT_EQ(walk->walk.local[1], nullptr);
  EXPECT_EQ(stream.stats().loads, 4);
  EXPECT_LE(stream.stats().peakBytes, options.memoryBytes);
}

TEST_F(SlowWalk, StoppedItEndsWithinOneCapture) {
  source_->gate.close();
  std::thread opener([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    openGates();
  });
  { WalkStream stream(start(), {}); }
  opener.join();
  EXPECT_LT(source_->asked().size(), 2 * layout_->cameras.size());
}

class StoredWalk : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::SceneBuilder builder;
    builder.box(builder.material(test::matte()), {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5f}, 50);
    Project project = test::smallProject(0.8, 2);
    project.bake.ambientRays = 0;
    open_ = test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
    TaskRunner runner(1);
    BakeRequest request;
    request.coarseFirst = true;
    EXPECT_TRUE(bakeProject(open_, request, runner));
  }
  CaptureStore store() const { return CaptureStore::open(captureFolderFor(open_.file)).value(); }
  /// Each capture read and prepared one by one, all regions clipped: no stream.
  WalkScene byHand() const {
    WalkScene walk;
    walk.scene = open_.scene;
    walk.layout = open_.layout;
    walk.plan = open_.plan;
    walk.exposure = open_.project.exposure;
    for (const ContentKey& key : open_.keys)
      walk.captures.push_back(
          std::make_shared<const DisplayCapture>(prepareForDisplay(store().get(key).value(), walk.exposure)));
    for (const Region& region : open_.layout->regions)
      walk.local.push_back(std::make_shared<const LocalGeometry>(clipToPolygon(*open_.scene, region.grown)));
    walk.surfaceLight =
        std::make_shared<const SurfaceLight>(store().getSurfaceLight(open_.surfaceLightKey).value());
    return walk;
  }
  std::vector<PerspectiveView> views() const {
    std::vector<PerspectiveView> all;
    for (std::size_t r = 0; r < open_.layout->regions.size(); ++r) {
      PerspectiveView view;
      view.eye = {open_.layout->regions[r].polygon.centroid(), open_.layout->eyeZ()};
      view.yawRadians = 0.7 * double(r);
      view.width = 96;
      view.height = 64;
      all.push_back(view);
    }
    return all;
  }
  static void expectSamePictures(const WalkScene& a, const WalkScene& b, const PerspectiveView& view) {
    TaskRunner runner;
    const auto one = renderFrame(a, view, {}, runner), other = renderFrame(b, view, {}, runner);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->colour.pixels, other->colour.pixels);
    EXPECT_EQ(one->source.pixels, other->source.pixels);
  }
  OpenProject open_;
};

TEST_F(StoredWalk, WhenAllIsReadThePicturesAreThoseOfTheCapturesBitForBit) {
  const WalkScene reference = byHand();
  WalkStreamOptions options;
  options.threads = 2;
  WalkStream stream(startWalk(open_, nullptr).value(), options);
  for (int i = 0; i < 10000 && stream.busy(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_FALSE(stream.busy());
  const auto walk = stream.walk();
  TaskRunner runner(1);
  const auto loaded = loadWalk(open_, nullptr, runner);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->missing, 0);
  for (const PerspectiveView& view : views()) {
    expectSamePictures(reference, walk->walk, view);
    expectSamePictures(reference, loaded->walk, view);
  }
}

TEST_F(StoredWalk, OneFrameAtATimeWithinALimitThePicturesAreTheSame) {
  const WalkScene reference = byHand();
  WalkStreamOptions options;
  options.threads = 0;
  options.memoryBytes = 1;  // each frame's captures alone take more
  WalkStream stream(startWalk(open_, nullptr).value(), options);
  TaskRunner runner(1);
  for (const PerspectiveView& view : views()) {
    const ViewCameras needed = camerasOf(*open_.layout, view, {});
    ASSERT_TRUE(stream.complete(needed.cameras, std::vector{needed.region}, runner));
    EXPECT_EQ(stream.stats().full, int(needed.cameras.size()));
    expectSamePictures(reference, stream.walk()->walk, view);
  }
  EXPECT_GT(stream.stats().evictions, 0);
}

TEST_F(StoredWalk, ADamagedCaptureFallsBackOnItsPreview) {
  std::ofstream(captureFolderFor(open_.file) / (open_.keys[1].toHex() + ".pack")) << "not a capture";
  TaskRunner runner(1);
  const auto loaded = loadWalk(open_, nullptr, runner);
  ASSERT_TRUE(loaded);
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_NE(loaded->warnings[0].find("damaged"), std::string::npos);
  ASSERT_NE(loaded->walk.captures[1], nullptr);
  EXPECT_TRUE(loaded->standsIn[1]);
  EXPECT_LT(loaded->walk.captures[1]->camera.columns, loaded->walk.captures[0]->camera.columns);
}

TEST_F(StoredWalk, ALaterWalkTakesOverWhatDidNotChange) {
  TaskRunner runner(1);
  const auto first = loadWalk(open_, nullptr, runner);
  ASSERT_TRUE(first);
  OpenProject changed = open_;
  changed.keys[0] = {7, 7};  // not baked
  const auto later = loadWalk(changed, &*first, runner);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->walk.captures[1], first->walk.captures[1]);
  EXPECT_EQ(later->walk.local[0], first->walk.local[0]);
  EXPECT_EQ(later->walk.surfaceLight, first->walk.surfaceLight);
  EXPECT_EQ(later->coarse + later->missing, 1) << "its preview, or nothing";
  changed.project.exposure *= 2;
  const auto brighter = loadWalk(changed, &*first, runner);
  ASSERT_TRUE(brighter);
  EXPECT_NE(brighter->walk.captures[1], first->walk.captures[1]);
}

}  // namespace
}  // namespace acentric
