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
    const PlanSituation situation{&spec_, &selection_, eye_, kScale};
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

TEST_F(PlanToolTest, AClickOnAPlacedCellSelectsItShiftTogglesControlRemoves) {
  const CellId cell = cellAt(spec_, {0, 0}).id;
  EXPECT_EQ(std::get<SelectIntent>(click({0.1, 0})).cells, std::set<CellId>{cell});
  selection_ = {cell};
  EXPECT_TRUE(std::get<SelectIntent>(click({0.1, 0}, ui::modifier::shift)).cells.empty());
  EXPECT_EQ(std::get<RemoveCellIntent>(click({0.1, 0}, ui::modifier::control)).cell, cell);
}

TEST_F(PlanToolTest, DraggingACellMovesItToTheNearestFreeSlotOnce) {
  const CellId from = cellAt(spec_, {0, 0}).id;
  send(PointerEvent::Kind::press, {0.1, 0.1});
  for (int i = 1; i <= 20; ++i) {
    EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::move, {0.1 + 0.2 * i, 0.1})));
  }
  ASSERT_TRUE(tool_.cellDrag().has_value());
  const CellId landing = tool_.cellDrag()->to;
  const PlanIntent intent = send(PointerEvent::Kind::release, {4.1, 0.1});
  ASSERT_TRUE(std::holds_alternative<MoveCellIntent>(intent));
  EXPECT_EQ(std::get<MoveCellIntent>(intent).from, from);
  EXPECT_EQ(std::get<MoveCellIntent>(intent).to, landing);
  EXPECT_NE(landing, from);
  EXPECT_FALSE(tool_.capturing());
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
  EXPECT_EQ(std::get<OutlineIntent>(intent).loop.size(), 3U);
  EXPECT_TRUE(tool_.outlineCorners().empty());
}

Walker::Clamp anywhere() {
  return [](const glm::dvec2& place) { return place; };
}

TEST(Walker, WalksAtTheStatedSpeedWhereItLooks) {
  Walker walker;
  walker.setPose({{0, 0, 1.6}, kPi / 2, 0});
  WalkKeys keys;
  keys.forward = true;
  for (int i = 0; i < 120; ++i) walker.step(1.0 / 60, keys, anywhere());
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
    walker.step(1.0 / 60, keys, anywhere());
  }
  EXPECT_NEAR(glm::distance(before, glm::dvec2(walker.pose().eye)) * 60, Walker::kMetresPerSecond, 0.01);
  for (int i = 0; i < 60; ++i) walker.step(1.0 / 60, {}, anywhere());
  EXPECT_FALSE(walker.moving());
}

TEST(Walker, SlidesAlongTheWallThatTheClampMakes) {
  Walker walker;
  walker.setPose({{0, 0, 1.6}, kPi / 4, 0});
  WalkKeys keys;
  keys.forward = true;
  const Walker::Clamp wall = [](const glm::dvec2& place) {
    return glm::dvec2(std::min(place.x, 0.5), place.y);
  };
  for (int i = 0; i < 120; ++i) walker.step(1.0 / 60, keys, wall);
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

TEST(Walker, AStalledWindowDoesNotThrowTheEye) {
  Walker walker;
  WalkKeys keys;
  keys.forward = true;
  walker.step(30, keys, anywhere());
  EXPECT_LE(walker.pose().eye.x, Walker::kMetresPerSecond * 0.1 + 1e-9);
}

}  // namespace
}  // namespace acentric::editor
