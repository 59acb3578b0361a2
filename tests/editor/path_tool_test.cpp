#include <gtest/gtest.h>

#include "editor/commands/walk_edits.h"
#include "editor/tools/plan_tool.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

class PathToolTest : public testing::Test {
 protected:
  static constexpr double kScale = 50;  // pixels per metre

  PathToolTest() {
    paths_ = {{"walk 1", 0, {{{{0, 0, 1.6}, 0, 0, 0}, {{4, 0, 1.6}, 0, 0, 2}, {{4, 3, 1.6}, 0, 0, 5}}}},
              {"walk 2", 0, {{{{0, -3, 1.6}, 0, 0, 0}, {{4, -3, 1.6}, 0, 0, 2}}}},
              {"upstairs", 1, {{{{2, 2, 4.6}, 0, 0, 0}, {{2, 3, 4.6}, 0, 0, 2}}}}};
    selection_ = {WalkSelection::Kind::path, 0, {}};
    tool_.setMode(PlanMode::path);
  }
  PlanIntent send(PointerEvent::Kind kind, const glm::dvec2& world, int modifiers = 0) {
    const PlanSituation situation{&spec_, &cells_, {9, 9}, kScale, {}, {}, {}, {paths_, 0, selection_}};
    return tool_.handle({kind, ui::mouse::left, modifiers, {world.x * kScale, -world.y * kScale}, world},
                        situation);
  }
  PathIntent press(const glm::dvec2& world, int modifiers = 0) {
    return std::get<PathIntent>(send(PointerEvent::Kind::press, world, modifiers));
  }
  PathIntent drag(const glm::dvec2& from, const glm::dvec2& to) {
    send(PointerEvent::Kind::press, from);
    EXPECT_FALSE(std::get<PathIntent>(send(PointerEvent::Kind::move, to)).finished);
    return std::get<PathIntent>(send(PointerEvent::Kind::release, to));
  }

  LayoutSpec spec_;
  std::set<CellId> cells_;
  std::vector<WalkPath> paths_;
  WalkSelection selection_;
  PlanTool tool_;
};

TEST_F(PathToolTest, APressSelectsAKeyPoseAndChangesNothing) {
  const PathIntent intent = press({4.05, 0.05});
  EXPECT_EQ(intent.path, 0u);
  EXPECT_EQ(intent.pose, 1u);
  EXPECT_FALSE(intent.changed);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {4.05, 0.05})));
}

TEST_F(PathToolTest, APressOnFreeGroundWithShiftAppendsAKeyPose) {
  const PathIntent intent = press({1, 3}, ui::modifier::shift);
  ASSERT_TRUE(intent.changed);
  EXPECT_FALSE(intent.finished);
  const PathIntent last = std::get<PathIntent>(send(PointerEvent::Kind::release, {1, 3}));
  ASSERT_TRUE(last.changed && last.finished);
  ASSERT_EQ(last.changed->poses.size(), 4U);
  const PathPose& pose = last.changed->poses.back();
  EXPECT_EQ(pose.eye, glm::dvec3(1, 3, 1.6));
  EXPECT_NEAR(pose.yawRadians, kPi, 1e-12) << "looks the way it went";
  EXPECT_NEAR(pose.seconds, 5 + 3 / 1.4, 1e-12) << "at walking speed";
  EXPECT_EQ(last.pose, 3U);
  CameraPath untimed = paths_[0].path;
  for (PathPose& each : untimed.poses) each.seconds = 0;
  const Status sound = withPoseAfter(untimed, {1, 3}, 1).check();
  EXPECT_TRUE(sound.has_value()) << "a path without times stays one";
  selection_.kind = WalkSelection::Kind::none;
  EXPECT_FALSE(std::get<PathIntent>(send(PointerEvent::Kind::press, {1, 3}, ui::modifier::shift)).changed);
}

TEST_F(PathToolTest, DraggingAKeyPoseMovesItAloneAndKeepsHeightAndTime) {
  const PathIntent intent = drag({4.05, 0}, {5.05, 1});
  ASSERT_TRUE(intent.changed && intent.finished);
  CameraPath expected = paths_[0].path;
  expected.poses[1].eye = {5, 1, 1.6};
  EXPECT_LT(glm::distance(intent.changed->poses[1].eye, expected.poses[1].eye), 1e-12);
  EXPECT_EQ(intent.changed->poses[1].seconds, 2);
  EXPECT_EQ(intent.changed->poses[0], expected.poses[0]);
  EXPECT_EQ(intent.changed->poses[2], expected.poses[2]);
}

TEST_F(PathToolTest, TheTickOfTheSelectedKeyPoseTurnsItsView) {
  selection_.pose = 1;
  const PathIntent intent = drag({4 + kTickPixels / kScale, 0}, {4, 1});
  ASSERT_TRUE(intent.changed);
  EXPECT_NEAR(intent.changed->poses[1].yawRadians, kPi / 2, 1e-12);
  EXPECT_EQ(intent.changed->poses[1].eye, paths_[0].path.poses[1].eye);
}

TEST_F(PathToolTest, APressOnTheLineOfTheSelectedPathPutsAKeyPoseThere) {
  const PathIntent pressed = press({1, 0.05});
  ASSERT_TRUE(pressed.changed);
  EXPECT_FALSE(pressed.finished);
  const PathIntent intent = std::get<PathIntent>(send(PointerEvent::Kind::release, {1, 0.05}));
  ASSERT_TRUE(intent.changed && intent.finished);
  ASSERT_EQ(intent.changed->poses.size(), 4u);
  EXPECT_EQ(intent.pose, 1u);
  EXPECT_NEAR(intent.changed->poses[1].seconds, 0.5, 1e-9);
  EXPECT_NEAR(intent.changed->poses[1].eye.y, 0, 1e-9) << "on the line, not at the pointer";
}

TEST_F(PathToolTest, APressOnAnotherPathSelectsThatAlone) {
  const PathIntent intent = press({1, -3});
  EXPECT_EQ(intent.path, 1u);
  EXPECT_FALSE(intent.pose);
  EXPECT_FALSE(intent.changed);
}

TEST_F(PathToolTest, ControlTakesAKeyPoseAwayButNotTheLast) {
  EXPECT_EQ(press({4, 3}, ui::modifier::control).changed, withoutPose(paths_[0].path, 2));
  paths_[0].path.poses.resize(1);
  tool_.cancel();
  EXPECT_EQ(press({0, 0}, ui::modifier::control).changed, paths_[0].path);
}

TEST_F(PathToolTest, APressOnFreeGroundSelectsNothingAndADragPans) {
  EXPECT_FALSE(press({-2, -2}).path);
  EXPECT_TRUE(std::holds_alternative<PanIntent>(send(PointerEvent::Kind::move, {-3, -2})));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {-3, -2})));
}

TEST_F(PathToolTest, PathsOfOtherStoreysAreNotThere) {
  EXPECT_EQ(hitPaths({paths_, 0, selection_}, {2, 2.5}, kScale).kind, PathHit::Kind::nothing);
  EXPECT_EQ(hitPaths({paths_, 1, selection_}, {2, 2.5}, kScale).kind, PathHit::Kind::line);
  EXPECT_EQ(hitPaths({paths_, 1, selection_}, {4, 0}, kScale).kind, PathHit::Kind::nothing);
}

TEST_F(PathToolTest, ACancelledDragEndsWithoutAChange) {
  send(PointerEvent::Kind::press, {4, 0});
  send(PointerEvent::Kind::move, {6, 0});
  EXPECT_TRUE(tool_.cancel());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {6, 0})));
}

}  // namespace
}  // namespace acentric::editor
