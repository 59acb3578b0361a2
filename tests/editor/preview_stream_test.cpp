#include "editor/session/preview_stream.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "editor/session/scene_view.h"
#include "tests/bake/scene_builder.h"

namespace acentric::editor {
namespace {

PreviewTracerPtr roomTracer() {
  test::SceneBuilder builder;
  builder.box(builder.material(test::matte()), {0, 0, 0}, {6, 5, 3}, true);
  return std::make_shared<const PreviewTracer>(builder.rays());
}

PreviewWanted viewOf(const PreviewTracerPtr& tracer, double yaw) {
  PerspectiveView view;
  view.eye = {3, 2, 1.6};
  view.yawRadians = yaw;
  view.width = 200, view.height = 120;
  return {tracer, view, kNoCut};
}

/// Asks until there is a new picture; a minute at most.
bool waitForPicture(PreviewStream& stream, const PreviewWanted& wanted) {
  for (int i = 0; i < 30000; ++i) {
    stream.want(wanted);
    if (stream.take()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

TEST(PreviewStream, ShowsASmallPictureFirstThenTheWholeThenRests) {
  const PreviewTracerPtr tracer = roomTracer();
  std::atomic<int> woken = 0;
  PreviewStream stream(1, [&] { ++woken; });
  const PreviewWanted wanted = viewOf(tracer, 0.4);
  ASSERT_TRUE(waitForPicture(stream, wanted));
  EXPECT_EQ(stream.shown()->scale, PreviewStream::kFirstScale);
  EXPECT_EQ(stream.shown()->picture.colour.width, 50);
  EXPECT_EQ(stream.shown()->picture.rayDistance.height, 30);
  ASSERT_TRUE(waitForPicture(stream, wanted));
  EXPECT_EQ(stream.shown()->scale, 1);
  EXPECT_EQ(stream.shown()->picture.colour.width, 200);
  EXPECT_TRUE(same(stream.shown()->whole, wanted));
  stream.want(wanted);
  EXPECT_FALSE(stream.busy());
  EXPECT_EQ(woken, 2);
}

TEST(PreviewStream, ShowsWhatIsWantedNowWhateverWasAskedBefore) {
  const PreviewTracerPtr tracer = roomTracer();
  PreviewStream stream(2, {});
  ASSERT_TRUE(waitForPicture(stream, viewOf(tracer, 0)));
  PreviewWanted wanted = viewOf(tracer, 0);
  for (int step = 1; step <= 20; ++step) {
    wanted = viewOf(tracer, 0.1 * step);
    stream.want(wanted);
    stream.take();
  }
  while (!same(stream.shown()->whole, wanted) || stream.shown()->scale < 1)
    ASSERT_TRUE(waitForPicture(stream, wanted));
  const PerspectiveView& view = std::get<PerspectiveView>(wanted.camera);
  TaskRunner runner;
  const PreviewPicture expected = previewView(*tracer, view, kNoCut, runner);
  EXPECT_EQ(stream.shown()->picture.rayDistance.pixels, expected.rayDistance.pixels);
  EXPECT_EQ(stream.shown()->picture.colour.pixels, expected.colour.pixels);
}

TEST(PreviewStream, ScalesViewsAndCaptureCameras) {
  const PreviewTracerPtr tracer = roomTracer();
  const PreviewWanted view = scaled(viewOf(tracer, 0), 0.1);
  EXPECT_EQ(std::get<PerspectiveView>(view.camera).width, 20);
  EXPECT_EQ(std::get<PerspectiveView>(view.camera).height, 12);
  PreviewCapture capture;
  capture.columns.columns = 480, capture.columns.rows = 3;
  const PreviewWanted small = scaled({tracer, capture, kNoCut}, 0.1);
  EXPECT_EQ(std::get<PreviewCapture>(small.camera).columns.columns, 48);
  EXPECT_EQ(std::get<PreviewCapture>(small.camera).columns.rows, 1);
  EXPECT_FALSE(same(small, view));
}

Layout layoutIn(double x) {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.floorHeight = 0.5;
  spec.outline.loops = {{{x + 1, 1}, {x + 4, 1}, {x + 4, 4}, {x + 1, 4}}};
  return *buildLayout(spec);
}

TEST(SceneView, CutsTheCeilingAboveTheEyesWhereThereIsOne) {
  const PreviewTracerPtr tracer = roomTracer();
  EXPECT_TRUE(underCeiling(tracer->rays(), layoutIn(0)));
  EXPECT_FALSE(underCeiling(tracer->rays(), layoutIn(50)));
  const Layout layout = layoutIn(0);
  EXPECT_GT(ceilingCut(layout, 0.15), layout.eyeZ() + 0.15);
  EXPECT_LT(ceilingCut(layout, 0.15), layout.eyeZ() + 0.5);
}

TEST(SceneView, FramesTheSelectionOrAllThatIsLaidOutOrTheScene) {
  const Layout layout = layoutIn(0);
  const Bounds bounds{{-1, -2, -3}, {4, 5, 6}};
  const SceneBox all = boxToFrame(bounds, layout, {});
  const Region& region = layout.regions.front();
  const SceneBox one = boxToFrame(bounds, layout, {region.id});
  EXPECT_EQ(all.low.z, 0.5);
  EXPECT_EQ(all.high.z, layout.eyeZ());
  for (const glm::dvec2& corner : region.polygon.corners) {
    EXPECT_GE(corner.x, one.low.x);
    EXPECT_LE(corner.x, one.high.x);
  }
  EXPECT_LT(one.high.x - one.low.x, all.high.x - all.low.x);
  EXPECT_EQ(boxToFrame(bounds, layout, {{999, 0, 0}}).low, all.low);  // a cell that is gone
  EXPECT_EQ(boxToFrame(bounds, Layout{}, {}).high, glm::dvec3(4, 5, 6));
}

TEST(SceneView, FramesWhatCanBeWalkedNotHowFarCellsReachBeyondIt) {
  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = 10;
  spec.outline.loops = {{{-2, -2}, {31, -2}, {31, 2}, {-2, 2}}};
  const WalkableBox hall = *walkableBox(*buildLayout(spec));
  EXPECT_EQ(hall.low, glm::dvec2(-5, -5)) << "all of the cells, which end within an edge of it";
  EXPECT_EQ(hall.high, glm::dvec2(35, 5));
  spec.outline.loops.push_back({{2000, 0}, {2000.5, 0}, {2000.5, 0.5}, {2000, 0.5}});
  EXPECT_EQ(*walkableBox(*buildLayout(spec)), hall) << "a speck, 2 km away";
  EXPECT_LT(boxToFrame({}, *buildLayout(spec), {}).high.x, 40);
  spec.outline.loops.back() = {{2000, 0}, {2006, 0}, {2006, 6}, {2000, 6}};
  EXPECT_GT(walkableBox(*buildLayout(spec))->high.x, 2005) << "a second place to walk";
  spec.outline.loops.pop_back();
  spec.cellSize = 4;
  spec.latticeOrigin = {0, 2};
  spec.added = {{0, 20, 0}};
  const WalkableBox more = *walkableBox(*buildLayout(spec));
  EXPECT_EQ(more.low.y, -4) << "of the cells from -4 to 0 and to 4";
  EXPECT_EQ(more.high.y, 84) << "the one that was added";
  spec.outline.loops.clear();
  EXPECT_EQ(walkableBox(*buildLayout(spec))->low, glm::dvec2(-2, 80)) << "it alone";
  EXPECT_EQ(walkableBox(Layout{}), std::nullopt);
}

}  // namespace
}  // namespace acentric::editor
