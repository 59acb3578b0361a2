/// Rays against the floor and lines, lines that pass the eye, and the gizmo: cameras, pointer rays and moves
/// that are known by hand.

#include "editor/tools/gizmo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "editor/tools/orbit_camera.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

/// From the south-west, obliquely down.
PerspectiveView obliqueView() {
  PerspectiveView view;
  view.eye = {-4, -6, 5};
  view.yawRadians = 0.9;
  view.pitchRadians = -0.55;
  view.width = 900;
  view.height = 700;
  return view;
}

/// Straight down, +y up in the picture.
PerspectiveView viewFromAbove(double height) {
  PerspectiveView view = obliqueView();
  view.eye = {0, 0, height};
  view.yawRadians = kPi / 2;
  view.pitchRadians = -kPi / 2;
  return view;
}

glm::dvec2 pixelOf(const PerspectiveView& view, const glm::dvec3& place) {
  return project(view, place).pixel;
}

TEST(RayMath, ARayThroughTheImageOfAFloorPointMeetsItThere) {
  const PerspectiveView view = obliqueView();
  for (const glm::dvec2& place : {glm::dvec2(0, 0), glm::dvec2(3.25, -1.5), glm::dvec2(-2, 7)}) {
    const auto met = onLevel(rayThrough(view, pixelOf(view, {place, 0.3})), 0.3);
    ASSERT_TRUE(met.has_value());
    EXPECT_LT(glm::distance(*met, place), 1e-9);
  }
}

TEST(RayMath, GrazingRaysAndPlanesBehindTheEyeAreRefused) {
  const glm::dvec3 eye(0, 0, 1.6);
  EXPECT_FALSE(onLevel({eye, glm::normalize(glm::dvec3(1, 0, -0.001))}, 0));
  EXPECT_FALSE(onLevel({eye, {1, 0, 0}}, 0));
  EXPECT_FALSE(onLevel({eye, glm::normalize(glm::dvec3(1, 0, 0.5))}, 0)) << "upwards, away from the floor";
  EXPECT_FALSE(onLevel({eye, {0, 0, -1}}, 1.6)) << "the eye is on it";
  EXPECT_FALSE(onLevel({{0, 0, std::nan("")}, {0, 0, -1}}, 0));
  EXPECT_TRUE(onLevel({eye, glm::normalize(glm::dvec3(1, 0, -0.01))}, 0));
}

TEST(RayMath, TheNearestPlaceOfALineIsFoundOrRefused) {
  const glm::dvec3 origin(1, 2, 0), axis(directionOf(0.4), 0), eye(-3, -1, 4);
  const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.2, 0.1, 1)));
  for (const double along : {-2.0, 0.0, 5.5}) {
    // Past the line at a distance, along their common perpendicular.
    const glm::dvec3 on = origin + along * axis;
    const glm::dvec3 way = glm::normalize(on - eye);
    const auto met = alongLine({eye, way}, origin, axis);
    ASSERT_TRUE(met.has_value());
    EXPECT_NEAR(*met, along, 1e-9);
    const glm::dvec3 common = glm::normalize(glm::cross(way, axis));
    const auto beside = alongLine({eye + 0.7 * common, way}, origin, axis);
    ASSERT_TRUE(beside.has_value());
    EXPECT_NEAR(*beside, along, 1e-9);
  }
  EXPECT_NEAR(glm::length(across), 1, 1e-12);
  EXPECT_FALSE(alongLine({eye, axis}, origin, axis)) << "parallel";
  EXPECT_FALSE(alongLine({eye, glm::normalize(axis + 0.01 * across)}, origin, axis)) << "nearly";
  EXPECT_FALSE(alongLine({eye, -glm::normalize(origin - eye)}, origin, axis)) << "behind the eye";
}

TEST(RayMath, LinesAreCutOffBeforeTheEye) {
  const PerspectiveView view = obliqueView();
  const glm::dvec3 forward = glm::transpose(view.viewFromWorld()) * glm::dvec3(0, 0, 1);
  const glm::dvec3 before(0, 0, 0), behind = view.eye - 5.0 * forward;
  const auto stroke = strokeOf(view, before, behind);
  ASSERT_TRUE(stroke.has_value());
  EXPECT_LT(glm::distance(stroke->from, pixelOf(view, before)), 1e-9);
  EXPECT_TRUE(std::isfinite(stroke->to.x) && std::isfinite(stroke->to.y));
  // The other end lies on the line's image: where a place of the line just before the eye is seen.
  const glm::dvec2 near = pixelOf(view, glm::mix(before, behind, 0.3));
  const glm::dvec2 way = near - stroke->from, whole = stroke->to - stroke->from;
  EXPECT_NEAR((way.x * whole.y - way.y * whole.x) / (glm::length(way) * glm::length(whole)), 0, 1e-9);
  EXPECT_GT(glm::dot(way, whole), 0);
  const auto turned = strokeOf(view, behind, before);
  ASSERT_TRUE(turned.has_value());
  EXPECT_LT(glm::distance(turned->to, stroke->from), 1e-9);
  EXPECT_FALSE(strokeOf(view, behind, view.eye - 2.0 * forward));
  const glm::dvec3 corners[] = {before, {2, 0, 0}, behind};
  EXPECT_EQ(cornersBeforeEye(view, corners).size(), 4U) << "a triangle with one corner cut off";
  EXPECT_EQ(pixelsPerMetre(view, behind), 0);
}

class GizmoTest : public testing::Test {
 protected:
  /// Takes hold of what is drawn at `from`, drags to what is drawn at `to`.
  std::optional<GizmoMove> drag(const glm::dvec3& from, const glm::dvec3& to, int modifiers = 0) {
    EXPECT_TRUE(tool_.press(pixelOf(view_, from), view_, gizmo_, 1));
    grip_ = tool_.grip();
    tool_.move(pixelOf(view_, to), view_, modifiers, targets_, 1);
    text_ = tool_.text();
    return tool_.release();
  }
  double arrow() const { return 50 / pixelsPerMetre(view_, gizmo_.at); }  // a place on an arrow, metres
  glm::dvec3 along(double azimuth) const { return {directionOf(gizmo_.axesRadians + azimuth), 0}; }

  PerspectiveView view_ = obliqueView();
  Gizmo gizmo_{{1, 2, 0.02}, 0, true, true, 0.5};
  SnapTargets targets_{{}, 0.5, {}};
  GizmoTool tool_;
  GizmoGrip grip_ = GizmoGrip::none;
  std::string text_;
};

TEST_F(GizmoTest, ArrowsMoveAlongTheirAxisAlone) {
  for (const double axes : {0.0, 0.3}) {
    gizmo_.axesRadians = axes;
    const glm::dvec3 axis = along(0);
    auto move = drag(gizmo_.at + arrow() * axis, gizmo_.at + (arrow() + 1.25) * axis);
    ASSERT_TRUE(move.has_value());
    EXPECT_EQ(grip_, GizmoGrip::x);
    EXPECT_LT(glm::length(move->by - 1.25 * axis), 1e-9);
    const glm::dvec3 other = along(kPi / 2);
    move = drag(gizmo_.at + arrow() * other, gizmo_.at + (arrow() - 0.75) * other);
    ASSERT_TRUE(move.has_value());
    EXPECT_EQ(grip_, GizmoGrip::y);
    EXPECT_LT(glm::length(move->by + 0.75 * other), 1e-9);
  }
}

TEST_F(GizmoTest, TheUprightArrowLiftsAndTheSquareSlides) {
  const glm::dvec3 up(0, 0, 1);
  auto move = drag(gizmo_.at + arrow() * up, gizmo_.at + (arrow() + 0.4) * up);
  ASSERT_TRUE(move.has_value());
  EXPECT_EQ(grip_, GizmoGrip::up);
  EXPECT_LT(glm::length(move->by - 0.4 * up), 1e-9);
  EXPECT_EQ(text_, "z +0.400 m");
  const glm::dvec3 square = gizmo_.at + 28 / pixelsPerMetre(view_, gizmo_.at) * (along(0) + along(kPi / 2));
  move = drag(square, square + glm::dvec3(0.7, -1.4, 0));
  ASSERT_TRUE(move.has_value());
  EXPECT_EQ(grip_, GizmoGrip::plane);
  EXPECT_LT(glm::length(move->by - glm::dvec3(0.7, -1.4, 0)), 1e-9);
  move = drag(gizmo_.at, gizmo_.at + glm::dvec3(-0.3, 0.2, 0));
  ASSERT_TRUE(move.has_value());
  EXPECT_EQ(grip_, GizmoGrip::plane) << "the middle too";
  EXPECT_LT(glm::length(move->by - glm::dvec3(-0.3, 0.2, 0)), 1e-9);
  gizmo_.rises = false;
  EXPECT_FALSE(tool_.press(pixelOf(view_, gizmo_.at + arrow() * up), view_, gizmo_, 1));
}

TEST_F(GizmoTest, TheRingTurnsByTheAngleThatThePointerGoesRound) {
  const double radius = 58 / pixelsPerMetre(view_, gizmo_.at);
  const auto on = [&](double azimuth) { return gizmo_.at + radius * glm::dvec3(directionOf(azimuth), 0); };
  auto move = drag(on(2.3), on(2.9));
  ASSERT_TRUE(move.has_value());
  EXPECT_EQ(grip_, GizmoGrip::turn);
  EXPECT_NEAR(move->turnRadians, 0.6, 1e-9);
  EXPECT_EQ(move->by, glm::dvec3(0));
  move = drag(on(3.0), on(3.6));  // over the seam
  ASSERT_TRUE(move.has_value());
  EXPECT_NEAR(move->turnRadians, 0.6, 1e-9);
  move = drag(on(2.9), on(2.4));
  ASSERT_TRUE(move.has_value());
  EXPECT_NEAR(move->turnRadians, -0.5, 1e-9);
  EXPECT_EQ(text_, "-28.6°");
  move = drag(on(2.3), on(2.9), ui::modifier::shift);  // from 0.5 rad to 60 degrees, by steps of 15
  ASSERT_TRUE(move.has_value());
  EXPECT_NEAR(moved(gizmo_, *move).yawRadians, radians(60), 1e-9);
}

TEST_F(GizmoTest, ShiftSnapsToTheGridAndToCorners) {
  gizmo_.at = {1.1, 2.2, 0.02};
  const glm::dvec3 axis = along(0);
  auto move = drag(gizmo_.at + arrow() * axis, gizmo_.at + (arrow() + 1.3) * axis, ui::modifier::shift);
  ASSERT_TRUE(move.has_value());
  EXPECT_NEAR(gizmo_.at.x + move->by.x, 2.5, 1e-9);
  EXPECT_EQ(move->by.y, 0) << "an arrow leaves the other coordinate alone";
  const std::vector<glm::dvec2> corners{{2.43, 1.87}};
  targets_.corners = corners;
  const glm::dvec3 square = gizmo_.at + 28 / pixelsPerMetre(view_, gizmo_.at) * (along(0) + along(kPi / 2));
  move = drag(square, square + glm::dvec3(1.35, -0.35, 0), ui::modifier::shift);
  ASSERT_TRUE(move.has_value());
  EXPECT_LT(glm::distance(glm::dvec2(gizmo_.at + move->by), corners[0]), 1e-9);
}

TEST_F(GizmoTest, IsOfOneSizeAtAnyDistance) {
  gizmo_.at = {0, 0, 0};
  for (const double height : {2.0, 20.0, 400.0}) {
    view_ = viewFromAbove(height);
    double length = 0;
    for (const GizmoPart& part : partsOf(gizmo_, view_, 1))
      if (part.grip == GizmoGrip::x) length = glm::distance(part.pixels.front(), part.pixels.back());
    EXPECT_NEAR(length, 72, 1e-6);
    for (const GizmoPart& part : partsOf(gizmo_, view_, 1))
      EXPECT_NE(part.grip, GizmoGrip::up) << "seen end on";
  }
}

TEST_F(GizmoTest, WhatCannotBeToldLeavesTheMoveAsItWas) {
  const glm::dvec3 square = gizmo_.at + 28 / pixelsPerMetre(view_, gizmo_.at) * (along(0) + along(kPi / 2));
  ASSERT_TRUE(tool_.press(pixelOf(view_, square), view_, gizmo_, 1));
  EXPECT_TRUE(tool_.move(pixelOf(view_, square + glm::dvec3(1, 0, 0)), view_, 0, targets_, 1));
  const GizmoMove before = tool_.now();
  EXPECT_FALSE(tool_.move({450, -20000}, view_, 0, targets_, 1)) << "above the horizon";
  EXPECT_EQ(tool_.now(), before);
  EXPECT_TRUE(tool_.cancel());
  EXPECT_FALSE(tool_.release().has_value());
  // Behind the eye there is nothing to take hold of, whatever the pixel.
  gizmo_.at = view_.eye - 3.0 * (glm::transpose(view_.viewFromWorld()) * glm::dvec3(0, 0, 1));
  EXPECT_TRUE(partsOf(gizmo_, view_, 1).empty());
  EXPECT_EQ(gripAt(gizmo_, view_, {450, 350}, 1), GizmoGrip::none);
}

TEST_F(GizmoTest, AClickOnAHandleMovesNothing) {
  const glm::dvec3 axis = along(0);
  EXPECT_FALSE(drag(gizmo_.at + arrow() * axis, gizmo_.at + (arrow() + 0.001) * axis).has_value());
  EXPECT_FALSE(tool_.capturing());
}

}  // namespace
}  // namespace acentric::editor
