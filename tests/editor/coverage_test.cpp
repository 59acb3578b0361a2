#include "editor/session/coverage.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

#include "editor/commands/layout_edits.h"
#include "engine/pipeline/coverage.h"

#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

/// With a screen that hides a corner of the room.
class CoverageTest : public OpenSessionTest {
 protected:
  void writeModel(const fs::path& file) override {
    writeRoom(file);
    std::ofstream(file, std::ios::app) << "v 1 0 1\nv 3 0 1\nv 3 2.4 1\nv 1 2.4 1\nf 9 10 11 12\n";
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
