#include "editor/session/coverage.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "editor/commands/layout_edits.h"
#include "editor/session/session.h"
#include "engine/pipeline/coverage.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

/// A room 6 x 5 x 3 m, Y up, faces inwards, with a screen that hides a corner of it.
void writeRoom(const fs::path& file) {
  std::ofstream(file) << "v -3 0 -2.5\nv 3 0 -2.5\nv 3 0 2.5\nv -3 0 2.5\n"
                         "v -3 3 -2.5\nv 3 3 -2.5\nv 3 3 2.5\nv -3 3 2.5\n"
                         "v 1 0 1\nv 3 0 1\nv 3 2.4 1\nv 1 2.4 1\n"
                         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 9 10 11 12\n";
}

class CoverageTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_coverage_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    writeRoom(folder_ / "room.obj");
    SessionOptions options;
    options.importHost.importer = ACENTRIC_IMPORTER;
    options.importHost.cacheFolder = folder_ / "cache";
    options.preferencesFile = folder_ / "editor.json";
    options.processors = 2;
    session_.emplace(options);
    session_->open(folder_ / "room.obj");
    waitFor([&] { return session_->built() && !session_->working(); });
  }
  void TearDown() override {
    session_.reset();
    fs::remove_all(folder_);
  }
  void waitFor(const std::function<bool()>& done) {
    for (int i = 0; i < 12000 && !done(); ++i) {
      session_->poll(now_);
      now_ += 0.005;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(done());
  }
  const OpenProject& open() const { return *session_->built(); }
  std::vector<CoveragePicturePtr> measured(const CoverageRequest& request) {
    std::vector<CoveragePicturePtr> pictures;
    TaskRunner runner(0);
    const Status status = measureCoverage(
        open(), request, runner, [&](const CoveragePicturePtr& picture) { pictures.push_back(picture); });
    EXPECT_TRUE(status) << status.error().describe();
    return pictures;
  }

  fs::path folder_;
  std::optional<Session> session_;
  double now_ = 0;
};

TEST_F(CoverageTest, OfThePlanIsCoarseAtFirstAndEndsAsTheCountOfTheWholeLayout) {
  const auto pictures = measured({CoverageKind::layout, {}});
  ASSERT_GE(pictures.size(), 2U);
  EXPECT_LT(pictures.front()->plan.counts.size() * 10, pictures.back()->plan.counts.size());
  for (const auto& picture : pictures) EXPECT_EQ(picture->exact, picture == pictures.back());
  TaskRunner runner(0);
  const auto whole = coverageOfLayout(*open().layout, kAnyDistance,
                                      coverageGrid(*open().layout, {CoverageKind::layout, {}}), runner);
  ASSERT_TRUE(whole);
  EXPECT_EQ(pictures.back()->plan.counts, whole->counts);
  EXPECT_DOUBLE_EQ(pictures.back()->shares.mean, sharesOf(*whole).mean);
  // The coarse one was a fair sample already.
  EXPECT_NEAR(pictures.front()->shares.mean, sharesOf(*whole).mean, 0.05 * sharesOf(*whole).mean);
  int least = 1 << 20, most = 0;
  for (const std::uint16_t count : whole->counts)
    if (count > 0) least = std::min<int>(least, count), most = std::max<int>(most, count);
  EXPECT_EQ(pictures.back()->fewestCameras, least);
  EXPECT_EQ(pictures.back()->mostCameras, most);
}

TEST_F(CoverageTest, OfACellCountsTheCamerasAtItsCornersAndItsCoversHoldEachPointOnce) {
  const Region& region = open().layout->regions.front();
  const CoverageRequest request{CoverageKind::cell, region.id};
  const auto pictures = measured(request);
  ASSERT_FALSE(pictures.empty());
  TaskRunner runner(0);
  const auto whole = coverageOfCorners(*open().layout, region, coverageGrid(*open().layout, request), runner);
  ASSERT_TRUE(whole);
  EXPECT_EQ(pictures.back()->plan.counts, whole->counts);
  EXPECT_EQ(pictures.back()->covers, int(region.covers.size()));
  EXPECT_EQ(pictures.back()->coverHoldsOnce, 1);
  EXPECT_TRUE(measured({CoverageKind::cell, CellId{999, 999, 0}}).empty());
  EXPECT_TRUE(measured({CoverageKind::cell, {}}).empty());
}

TEST_F(CoverageTest, OfAFreePanoramaViewIsExactlyOneOutsideIt) {
  Edit edit{session_->project(), "free"};
  edit.project.layout().freeApvs[3] = Apv{{0, 0}, {0.7, 0}, 60, Hand::counterClockwise};
  ASSERT_TRUE(session_->apply(edit));
  waitFor([&] { return !session_->working() && open().project == session_->project(); });
  const auto pictures = measured({CoverageKind::cell, CellId{3, 0, kFreeSlot}});
  ASSERT_FALSE(pictures.empty());
  EXPECT_EQ(pictures.back()->shares.once, 1);
  EXPECT_EQ(pictures.back()->coverHoldsOnce, 1);
}

TEST_F(CoverageTest, OfSurfacesEndsAsTheWholeMeasurementAndTellsItsProgress) {
  const auto pictures = measured({CoverageKind::surfaces, {}});
  ASSERT_FALSE(pictures.empty());
  double before = 0;
  for (const auto& picture : pictures) {
    EXPECT_GT(picture->progress, before);
    before = picture->progress;
    EXPECT_EQ(picture->exact, picture == pictures.back());
  }
  TaskRunner runner(0);
  const ProjectReach reach(open());
  const auto whole = measureSurfaceCoverage(
      open().scene, *reach, surfaceCoverageOptionsFor(open().project, kJudgedDisplayWidth), runner);
  ASSERT_TRUE(whole);
  const SurfaceCoverage& last = *pictures.back()->surfaces;
  EXPECT_EQ(last.all.ofClass, (*whole)->all.ofClass);
  EXPECT_EQ(last.byRatio, (*whole)->byRatio);
  ASSERT_EQ(last.points.size(), (*whole)->points.size());
  std::size_t sampled = 0, below = 0;
  for (const PointCoverage& point : last.points)
    if (point.surfaceClass >= SurfaceClass::under) {
      ++sampled;
      below += point.samplesPerMetre / point.pixelsPerMetre < pictures.back()->medianRate ? 1 : 0;
    }
  EXPECT_EQ(below, sampled / 2);
}

TEST_F(CoverageTest, IsMeasuredInTheBackgroundOfTheNewestLayoutAlone) {
  const CoverageRequest surfaces{CoverageKind::surfaces, {}};
  EXPECT_EQ(session_->coverage(), nullptr);
  session_->askForCoverage(surfaces);
  EXPECT_EQ(session_->coverage(), nullptr);
  waitFor([&] { return session_->coverage() != nullptr; });
  EXPECT_EQ(session_->coverage()->layout, open().layout);

  // An edit while it is being refined: what belongs to the old layout is shown no longer.
  const auto before = open().layout;
  ASSERT_TRUE(session_->apply(removeCells(session_->project(), {before->regions.front().id})));
  waitFor([&] {
    session_->askForCoverage(surfaces);
    const auto picture = session_->coverage();
    EXPECT_TRUE(!picture || picture->layout == open().layout);
    return open().layout != before && picture && picture->exact;
  });
  waitFor([&] { return !session_->working(); });
  // At rest nothing begins anew.
  const auto rest = session_->coverage();
  session_->askForCoverage(surfaces);
  EXPECT_FALSE(session_->measuringCoverage().running());
  EXPECT_EQ(session_->coverage(), rest);

  session_->askForCoverage(CoverageRequest{CoverageKind::layout, {}});
  EXPECT_EQ(session_->coverage(), nullptr);
  waitFor([&] { return session_->coverage() && session_->coverage()->exact; });
  session_->askForCoverage(std::nullopt);
  EXPECT_EQ(session_->coverage(), nullptr);
}

TEST_F(CoverageTest, StopsWhenAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  TaskRunner runner(0);
  for (const CoverageKind kind : {CoverageKind::layout, CoverageKind::surfaces}) {
    const Status status = measureCoverage(
        open(), {kind, {}}, runner, [](const CoveragePicturePtr&) { FAIL(); }, stop.get_token());
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::cancelled);
  }
}

}  // namespace
}  // namespace acentric::editor
