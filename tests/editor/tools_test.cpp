#include <gtest/gtest.h>

#include <cmath>

#include "editor/commands/layout_edits.h"
#include "editor/tools/plan_tool.h"
#include "editor/tools/walker.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

class PlanToolTest : public testing::Test {
 protected:
  static constexpr double kScale = 50;  // pixels per metre

  PlanToolTest() {
    spec_.cellSize = 1;
    spec_.added = {cellAt(spec_, {0, 0}).id};
  }
  PlanIntent send(PointerEvent::Kind kind, const glm::dvec2& world, int button = ui::mouse::left,
                  int modifiers = 0) {
    const PlanSituation situation{&spec_, &selection_, eye_, kScale, {-1e3, -1e3}, {1e3, 1e3}, {}};
    return tool_.handle({kind, button, modifiers, {world.x * kScale, -world.y * kScale}, world}, situation);
  }
  PlanIntent click(const glm::dvec2& world, int modifiers = 0) {
    send(PointerEvent::Kind::press, world, ui::mouse::left, modifiers);
    return send(PointerEvent::Kind::release, world, ui::mouse::left, modifiers);
  }

  LayoutSpec spec_;
  std::set<CellId> selection_;
  glm::dvec2 eye_{100, 100};
  PlanTool tool_;
};

TEST_F(PlanToolTest, AClickOnAFreePlaceAddsThatCell) {
  const PlanIntent intent = click({6, 2});
  ASSERT_TRUE(std::holds_alternative<AddCellIntent>(intent));
  EXPECT_EQ(std::get<AddCellIntent>(intent).cell, cellAt(spec_, {6, 2}).id);
}

TEST_F(PlanToolTest, AClickOnAPlacedCellSelectsItShiftAddsControlToggles) {
  const CellId cell = cellAt(spec_, {0, 0}).id, other{7, 7, 0};
  EXPECT_EQ(std::get<SelectIntent>(click({0.1, 0})).cells, std::set<CellId>{cell});
  selection_ = {other};
  EXPECT_EQ(std::get<SelectIntent>(click({0.1, 0}, ui::modifier::shift)).cells,
            (std::set<CellId>{cell, other}));
  selection_ = {cell, other};
  EXPECT_EQ(std::get<SelectIntent>(click({0.1, 0}, ui::modifier::shift)).cells,
            (std::set<CellId>{cell, other}));
  EXPECT_EQ(std::get<SelectIntent>(click({0.1, 0}, ui::modifier::control)).cells, std::set<CellId>{other});
}

TEST_F(PlanToolTest, ADragWithShiftOrControlDrawsABoxFromWhereverItBegins) {
  for (const glm::dvec2 from : {glm::dvec2(6, 2), glm::dvec2(0.1, 0)}) {
    send(PointerEvent::Kind::press, from, ui::mouse::left, ui::modifier::shift);
    EXPECT_FALSE(tool_.marquee()) << "not dragged yet";
    send(PointerEvent::Kind::move, {3, -1});
    ASSERT_TRUE(tool_.marquee());
    const auto box = std::get<MarqueeIntent>(send(PointerEvent::Kind::release, {2, -2}));
    EXPECT_EQ(box.low, glm::min(from, glm::dvec2(2, -2)));
    EXPECT_EQ(box.high, glm::max(from, glm::dvec2(2, -2)));
    EXPECT_EQ(box.how, Combine::add);
  }
  send(PointerEvent::Kind::press, {6, 2}, ui::mouse::left, ui::modifier::control);
  send(PointerEvent::Kind::move, {3, -1});
  EXPECT_EQ(std::get<MarqueeIntent>(send(PointerEvent::Kind::release, {3, -1})).how, Combine::toggle);
  send(PointerEvent::Kind::press, {6, 2}, ui::mouse::left, ui::modifier::shift);
  send(PointerEvent::Kind::move, {3, -1});
  EXPECT_TRUE(tool_.cancel());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {3, -1})));
}

TEST_F(PlanToolTest, ClicksWithModifiersOnFreeGroundAddNothing) {
  EXPECT_TRUE(std::holds_alternative<std::monostate>(click({6, 2}, ui::modifier::shift)));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(click({6, 2}, ui::modifier::control)));
}

TEST_F(PlanToolTest, DraggingACellMovesItByTheNearestStepOnce) {
  const CellId from = cellAt(spec_, {0, 0}).id;
  send(PointerEvent::Kind::press, {0.1, 0.1});
  for (int i = 1; i <= 20; ++i) {
    EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::move, {0.1 + 0.2 * i, 0.1})));
  }
  ASSERT_NE(tool_.cellDrag(), nullptr);
  const auto intent = std::get<MoveCellsIntent>(send(PointerEvent::Kind::release, {4.1, 0.1}));
  EXPECT_EQ(intent.cells, std::set<CellId>{from});
  EXPECT_NE(intent.step, LatticeStep{});
  const CellId to{from.i + intent.step.i, from.j + intent.step.j, from.slot};
  EXPECT_EQ(to, nearestSlot(spec_, from, cellPolygon(spec_, from).centroid() + glm::dvec2(4, 0)));
  EXPECT_FALSE(tool_.capturing());
}

TEST_F(PlanToolTest, DraggingASelectedCellTakesTheOthersAlongAnotherOneGoesAlone) {
  const CellId near = cellAt(spec_, {0, 0}).id, far = cellAt(spec_, {6, 2}).id;
  spec_.added.insert(far);
  selection_ = {near, far};
  const auto drag = [&] {
    send(PointerEvent::Kind::press, {0.1, 0.1});
    send(PointerEvent::Kind::move, {4, 0});
    return std::get<MoveCellsIntent>(send(PointerEvent::Kind::release, {4, 0})).cells;
  };
  EXPECT_EQ(drag(), selection_);
  selection_ = {far};
  EXPECT_EQ(drag(), std::set<CellId>{near});
}

TEST_F(PlanToolTest, EscapeTakesTheRulerAway) {
  tool_.setMode(PlanMode::measure);
  send(PointerEvent::Kind::press, {20, 20});
  send(PointerEvent::Kind::move, {23, 24});
  send(PointerEvent::Kind::release, {23, 24});
  ASSERT_TRUE(tool_.measureTool().ruler());
  EXPECT_TRUE(tool_.cancel());
  EXPECT_FALSE(tool_.measureTool().ruler());
  EXPECT_FALSE(tool_.cancel());
}

TEST_F(PlanToolTest, ADragOfFreeGroundDrawsARectangleOfTheOutline) {
  tool_.setMode(PlanMode::outline);
  send(PointerEvent::Kind::press, {4, 3});
  send(PointerEvent::Kind::move, {1, 2});
  EXPECT_EQ(tool_.outlineTool().rectangle().size(), 4U);
  const auto intent = std::get<OutlineIntent>(send(PointerEvent::Kind::release, {0, 1}));
  ASSERT_EQ(intent.outline.loops.size(), 1U);
  EXPECT_NEAR(intent.outline.area(), 8, 1e-12);
  EXPECT_TRUE(tool_.outlineTool().rectangle().empty());
}

TEST_F(PlanToolTest, ACellThatIsDraggedBackOrCancelledStays) {
  send(PointerEvent::Kind::press, {0, 0});
  send(PointerEvent::Kind::move, {3, 0});
  send(PointerEvent::Kind::move, {0, 0});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {0, 0})));
  send(PointerEvent::Kind::press, {0, 0});
  send(PointerEvent::Kind::move, {3, 0});
  EXPECT_TRUE(tool_.cancel());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {3, 0})));
}

TEST_F(PlanToolTest, OtherButtonsAndDragsOfFreeGroundPan) {
  send(PointerEvent::Kind::press, {6, 2}, ui::mouse::right);
  const PlanIntent pan = send(PointerEvent::Kind::move, {7, 2}, ui::mouse::right);
  EXPECT_EQ(std::get<PanIntent>(pan).pixels, glm::dvec2(kScale, 0));
  send(PointerEvent::Kind::release, {7, 2}, ui::mouse::right);
  send(PointerEvent::Kind::press, {6, 2});
  EXPECT_TRUE(std::holds_alternative<PanIntent>(send(PointerEvent::Kind::move, {7, 2})));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {7, 2})));
}

TEST_F(PlanToolTest, TheEyeIsGrabbedBeforeTheCellUnderIt) {
  eye_ = {0.1, 0};
  send(PointerEvent::Kind::press, {0, 0});
  EXPECT_TRUE(std::holds_alternative<PlaceEyeIntent>(send(PointerEvent::Kind::move, {0.5, 0.5})));
}

TEST_F(PlanToolTest, EyeModePlacesAndThenTurns) {
  tool_.setMode(PlanMode::eye);
  EXPECT_EQ(std::get<PlaceEyeIntent>(send(PointerEvent::Kind::press, {1, 1})).position, glm::dvec2(1, 1));
  EXPECT_NEAR(std::get<TurnEyeIntent>(send(PointerEvent::Kind::move, {1, 3})).yawRadians, kPi / 2, 1e-12);
}

TEST_F(PlanToolTest, AnOutlineIsClosedAtItsFirstCornerAndNeedsThree) {
  tool_.setMode(PlanMode::outline);
  click({0, 0});
  click({4, 0});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(tool_.closeOutline()));
  click({4, 3});
  const PlanIntent intent = click({0.05, 0.05});
  ASSERT_TRUE(std::holds_alternative<OutlineIntent>(intent));
  ASSERT_EQ(std::get<OutlineIntent>(intent).outline.loops.size(), 1U);
  EXPECT_EQ(std::get<OutlineIntent>(intent).outline.loops[0].size(), 3U);
  EXPECT_TRUE(tool_.outlineTool().corners().empty());
}

Walker::Ground anywhere() {
  return [](const glm::dvec2&, const glm::dvec2& to) { return to; };
}

constexpr EyeHeights kHeights{1.4, 1.8};

TEST(Walker, WalksAtTheStatedSpeedWhereItLooks) {
  Walker walker;
  walker.setPose({{0, 0, 1.6}, kPi / 2, 0});
  WalkKeys keys;
  keys.forward = true;
  for (int i = 0; i < 120; ++i) walker.step(1.0 / 60, keys, kHeights, anywhere());
  // Two seconds less the time it takes to get going.
  EXPECT_NEAR(walker.pose().eye.y, Walker::kMetresPerSecond * (2 - Walker::kSettleSeconds), 0.03);
  EXPECT_NEAR(walker.pose().eye.x, 0, 1e-9);
  EXPECT_EQ(walker.pose().eye.z, 1.6);
}

TEST(Walker, DiagonalsAreNoFasterAndLetsGoComesToRest) {
  Walker walker;
  WalkKeys keys;
  keys.forward = keys.left = true;
  glm::dvec2 before(0);
  for (int i = 0; i < 120; ++i) {
    before = glm::dvec2(walker.pose().eye);
    walker.step(1.0 / 60, keys, kHeights, anywhere());
  }
  EXPECT_NEAR(glm::distance(before, glm::dvec2(walker.pose().eye)) * 60, Walker::kMetresPerSecond, 0.01);
  for (int i = 0; i < 60; ++i) walker.step(1.0 / 60, {}, kHeights, anywhere());
  EXPECT_FALSE(walker.moving());
}

TEST(Walker, SlidesAlongTheWallThatTheClampMakes) {
  Walker walker;
  walker.setPose({{0, 0, 1.6}, kPi / 4, 0});
  WalkKeys keys;
  keys.forward = true;
  const Walker::Ground wall = [](const glm::dvec2&, const glm::dvec2& to) {
    return glm::dvec2(std::min(to.x, 0.5), to.y);
  };
  for (int i = 0; i < 120; ++i) walker.step(1.0 / 60, keys, kHeights, wall);
  EXPECT_DOUBLE_EQ(walker.pose().eye.x, 0.5);
  EXPECT_GT(walker.pose().eye.y, 1.5);
}

TEST(Walker, LookingToTheRightTurnsClockwiseAndPitchHasAnEnd) {
  Walker walker;
  walker.setPose({{0, 0, 0}, 1, 0});
  walker.look({100, 0}, 0.001);
  EXPECT_NEAR(walker.pose().yawRadians, 0.9, 1e-12);
  walker.look({0, -1e6}, 0.001);
  EXPECT_DOUBLE_EQ(walker.pose().pitchRadians, Walker::kMaxPitchRadians);
}

TEST(Walker, TheEyeRisesAndFallsWithinItsRange) {
  Walker walker;
  walker.setPose({{0, 0, 1.6}, 0, 0});
  WalkKeys keys;
  keys.up = true;
  EXPECT_TRUE(walker.step(0.1, keys, kHeights, anywhere()));
  EXPECT_NEAR(walker.pose().eye.z, 1.6 + 0.1 * Walker::kRiseMetresPerSecond, 1e-12);
  for (int i = 0; i < 60; ++i) walker.step(0.1, keys, kHeights, anywhere());
  EXPECT_DOUBLE_EQ(walker.pose().eye.z, kHeights.high);
  keys = {};
  keys.down = true;
  for (int i = 0; i < 60; ++i) walker.step(0.1, keys, kHeights, anywhere());
  EXPECT_DOUBLE_EQ(walker.pose().eye.z, kHeights.low);
  EXPECT_FALSE(walker.step(0.1, {}, kHeights, anywhere()));
}

TEST(Walker, ItsSpeedIsASettingWithLimits) {
  Walker walker;
  walker.setSpeed(4);
  WalkKeys keys;
  keys.forward = true;
  for (int i = 0; i < 120; ++i) walker.step(1.0 / 60, keys, kHeights, anywhere());
  EXPECT_NEAR(walker.velocity().x, 4, 1e-6);
  walker.setSpeed(1e9);
  EXPECT_EQ(walker.speed(), Walker::kMostMetresPerSecond);
}

TEST(Walker, WhoeverTurnsAwayFromAWallIsNotHeldByIt) {
  Walker walker;
  WalkKeys keys;
  keys.forward = true;
  const Walker::Ground stuck = [](const glm::dvec2& from, const glm::dvec2&) { return from; };
  for (int i = 0; i < 60; ++i) walker.step(1.0 / 60, keys, kHeights, stuck);
  EXPECT_EQ(walker.velocity(), glm::dvec2(0)) << "nothing has built up";
  keys = {};
  keys.back = true;
  walker.step(1.0 / 60, keys, kHeights, anywhere());
  EXPECT_LT(walker.pose().eye.x, 0);
}

TEST(Walker, AStalledWindowDoesNotThrowTheEye) {
  Walker walker;
  WalkKeys keys;
  keys.forward = true;
  walker.step(30, keys, kHeights, anywhere());
  EXPECT_LE(walker.pose().eye.x, Walker::kMetresPerSecond * 0.1 + 1e-9);
}

const Outline kSquare{{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}}};

TEST(OutlineEdits, ALoopWithinIsAHoleApartAnotherAreaAcrossAReplacement) {
  const Outline holed = withLoop(kSquare, {{2, 2}, {3, 2}, {3, 3}, {2, 3}});
  EXPECT_DOUBLE_EQ(holed.area(), 63);
  EXPECT_FALSE(holed.contains({2.5, 2.5}));
  const Outline two = withLoop(holed, {{20, 0}, {22, 0}, {22, 2}, {20, 2}});
  EXPECT_DOUBLE_EQ(two.area(), 67);
  EXPECT_DOUBLE_EQ(withLoop(two, {{4, 4}, {12, 4}, {12, 12}}).area(), 4 + 32)
      << "the hole goes with what it was in; the other area stays";
  EXPECT_DOUBLE_EQ(withLoop(two, {{-1, -1}, {30, -1}, {30, 9}, {-1, 9}}).area(), 310) << "encloses all";
  EXPECT_EQ(withLoop(kSquare, {{1, 1}, {2, 2}}), kSquare) << "two corners are no loop";
}

class OutlineToolTest : public PlanToolTest {
 protected:
  OutlineToolTest() {
    spec_.outline = kSquare;
    tool_.setMode(PlanMode::outline);
  }
  static const OutlineIntent& outlineOf(const PlanIntent& intent) { return std::get<OutlineIntent>(intent); }
};

TEST_F(OutlineToolTest, ACornerIsDraggedAndOnlyItsReleaseIsFinal) {
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::press, {8.1, 7.9})));
  const PlanIntent under = send(PointerEvent::Kind::move, {9.1, 8.9});
  EXPECT_FALSE(outlineOf(under).finished);
  EXPECT_NEAR(glm::distance(outlineOf(under).outline.loops[0][2], {9, 9}), 0, 1e-12);
  const PlanIntent done = send(PointerEvent::Kind::release, {9.1, 8.9});
  EXPECT_TRUE(outlineOf(done).finished);
  EXPECT_EQ(outlineOf(done).outline, outlineOf(under).outline);
  EXPECT_FALSE(tool_.capturing());
}

TEST_F(OutlineToolTest, APressOnASidePutsACornerThere) {
  const PlanIntent pressed = send(PointerEvent::Kind::press, {4, -0.1});
  ASSERT_EQ(outlineOf(pressed).outline.loops[0].size(), 5U);
  EXPECT_NEAR(glm::distance(outlineOf(pressed).outline.loops[0][1], {4, 0}), 0, 1e-12);
  send(PointerEvent::Kind::move, {4, -2.1});
  const PlanIntent done = send(PointerEvent::Kind::release, {4, -2.1});
  EXPECT_DOUBLE_EQ(outlineOf(done).outline.area(), 64 + 8);
}

TEST_F(OutlineToolTest, ControlClickTakesACornerAwayAndWithTheThirdTheLoop) {
  const PlanIntent once = send(PointerEvent::Kind::press, {0, 0}, ui::mouse::left, ui::modifier::control);
  EXPECT_TRUE(outlineOf(once).finished);
  EXPECT_DOUBLE_EQ(outlineOf(once).outline.area(), 32);
  send(PointerEvent::Kind::release, {0, 0}, ui::mouse::left, ui::modifier::control);
  EXPECT_TRUE(tool_.outlineTool().corners().empty()) << "and begins no loop";
  spec_.outline = outlineOf(once).outline;
  const PlanIntent twice = send(PointerEvent::Kind::press, {8, 0}, ui::mouse::left, ui::modifier::control);
  EXPECT_TRUE(outlineOf(twice).outline.empty());
}

TEST_F(OutlineToolTest, AClickOnACornerAloneChangesNothing) {
  send(PointerEvent::Kind::press, {0, 0});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {0, 0})));
  EXPECT_TRUE(tool_.outlineTool().corners().empty()) << "nor does it begin a loop";
}

class PanoramaToolTest : public PlanToolTest {
 protected:
  PanoramaToolTest() {
    spec_.freeApvs[4] = {{3, 3}, {1, 0}, 60, Hand::counterClockwise};
    tool_.setMode(PlanMode::panorama);
  }
};

TEST_F(PanoramaToolTest, AClickPlacesOneWithCamerasACellsEdgeOut) {
  const auto intent = std::get<FreeApvIntent>(click({-5, 2}));
  EXPECT_FALSE(intent.number);
  EXPECT_EQ(intent.apv.centre, glm::dvec2(-5, 2));
  EXPECT_DOUBLE_EQ(glm::length(intent.apv.offset), spec_.cellSize);
}

TEST_F(PanoramaToolTest, ADragFromFreeGroundSaysHowFarItsCamerasStandOut) {
  send(PointerEvent::Kind::press, {-5, 2});
  send(PointerEvent::Kind::move, {-5, 4});
  ASSERT_TRUE(tool_.panoramaTool().inHand());
  const auto intent = std::get<FreeApvIntent>(send(PointerEvent::Kind::release, {-5, 4}));
  EXPECT_EQ(intent.apv.offset, glm::dvec2(0, 2));
  EXPECT_FALSE(tool_.panoramaTool().inHand());
}

TEST_F(PanoramaToolTest, OneIsSelectedMovedAndTakenAwayByItsCentreOrItsPolygon) {
  const CellId cell{4, 0, kFreeSlot};
  EXPECT_EQ(std::get<SelectIntent>(click({3.1, 3})).cells, std::set<CellId>{cell});
  EXPECT_EQ(std::get<SelectIntent>(click({3.6, 3.2})).cells, std::set<CellId>{cell});
  const PlanIntent taken = send(PointerEvent::Kind::press, {3, 3}, ui::mouse::left, ui::modifier::control);
  EXPECT_EQ(std::get<RemoveCellIntent>(taken).cell, cell);
  send(PointerEvent::Kind::release, {3, 3}, ui::mouse::left, ui::modifier::control);
  send(PointerEvent::Kind::press, {3.5, 3});
  EXPECT_FALSE(std::get<FreeApvIntent>(send(PointerEvent::Kind::move, {5.5, 2})).finished);
  const auto moved = std::get<FreeApvIntent>(send(PointerEvent::Kind::release, {5.5, 2}));
  EXPECT_EQ(moved.number, 4);
  EXPECT_EQ(moved.apv.centre, glm::dvec2(5, 2));
  EXPECT_EQ(moved.apv.offset, spec_.freeApvs[4].offset);
}

}  // namespace
}  // namespace acentric::editor
