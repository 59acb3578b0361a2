#include "editor/tools/lattice_tool.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "editor/tools/measure_tool.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

class LatticeToolTest : public testing::Test {
 protected:
  static constexpr double kScale = 50;  // pixels per metre

  LatticeToolTest() {
    spec_.cellSize = 2;
    spec_.latticeOrigin = {0.5, -0.25};
  }
  LatticeHandles handles() const { return latticeHandles(spec_, {-8, -6}, {8, 6}, kScale); }
  static PointerEvent at(const glm::dvec2& world, int modifiers = 0) {
    return {PointerEvent::Kind::move, ui::mouse::left, modifiers, world * kScale, world};
  }
  std::optional<LatticeIntent> drag(const glm::dvec2& from, const glm::dvec2& to, int modifiers = 0) {
    EXPECT_TRUE(tool_.press(at(from), spec_, handles(), kScale));
    tool_.move(at(0.5 * (from + to), modifiers), targets_, kScale);
    EXPECT_FALSE(tool_.text().empty());
    return tool_.release(at(to, modifiers), targets_, kScale);
  }

  LayoutSpec spec_;
  SnapTargets targets_;
  LatticeTool tool_;
};

TEST_F(LatticeToolTest, HandlesAreApartAndAtARingInView) {
  const LatticeHandles near = handles();
  EXPECT_EQ(near.centre, spec_.latticeOrigin);
  EXPECT_GT(glm::distance(near.turn, near.centre) * kScale, 3 * kGrabPixels);
  EXPECT_GT(glm::distance(near.size, near.turn) * kScale, 3 * kGrabPixels);
  const LatticeHandles far = latticeHandles(spec_, {100, 100}, {116, 112}, kScale);
  EXPECT_LT(glm::distance(far.centre, glm::dvec2(108, 106)), 2 * spec_.cellSize);
  EXPECT_NEAR(glm::distance(cellAt(spec_, far.centre).polygon.centroid(), far.centre), 0, 1e-9);
}

TEST_F(LatticeToolTest, FreeGroundIsNotTheTools) {
  EXPECT_FALSE(tool_.press(at({7, 5}), spec_, handles(), kScale));
  EXPECT_FALSE(tool_.release(at({7, 5}), targets_, kScale));
}

TEST_F(LatticeToolTest, TheMiddleMovesTheLattice) {
  const auto intent = drag(handles().centre, handles().centre + glm::dvec2(1, 0.5));
  ASSERT_TRUE(intent);
  EXPECT_NEAR(glm::distance(intent->place.origin, glm::dvec2(1.5, 0.25)), 0, 1e-9);
  EXPECT_EQ(intent->place.cellSize, 2);
  EXPECT_EQ(intent->place.rotationRadians, 0);
}

TEST_F(LatticeToolTest, WithShiftTheMiddleLandsOnCornersElseOnTheGrid) {
  const std::array<glm::dvec2, 1> corners{{{2.03, 1.04}}};
  targets_.corners = corners;
  targets_.gridMetres = 0.5;
  EXPECT_EQ(drag(handles().centre, {2.1, 1.1}, ui::modifier::shift)->place.origin, corners[0]);
  EXPECT_EQ(drag(handles().centre, {3.1, 1.3}, ui::modifier::shift)->place.origin, glm::dvec2(3, 1.5));
}

TEST_F(LatticeToolTest, TheCircleTurnsItAndShiftSnapsToStepsAndWalls) {
  const LatticeHandles h = handles();
  const auto turnedBy = [&](double degreesBy) {
    return h.centre + glm::distance(h.turn, h.centre) * directionOf(kPi / 2 + radians(degreesBy));
  };
  EXPECT_NEAR(degrees(drag(h.turn, turnedBy(21.04))->place.rotationRadians), 21.0, 1e-9);
  EXPECT_NEAR(degrees(drag(h.turn, turnedBy(21), ui::modifier::shift)->place.rotationRadians), 15, 1e-9);
  targets_.wallRadians = radians(19.3);
  EXPECT_NEAR(degrees(drag(h.turn, turnedBy(21), ui::modifier::shift)->place.rotationRadians), 19.3, 1e-9);
  EXPECT_NEAR(degrees(drag(h.turn, turnedBy(-69), ui::modifier::shift)->place.rotationRadians), -70.7, 1e-9);
  EXPECT_NEAR(degrees(drag(h.turn, turnedBy(44), ui::modifier::shift)->place.rotationRadians), 45, 1e-9);
}

TEST_F(LatticeToolTest, TheCornerMakesCellsLargerAboutTheHandles) {
  const LatticeHandles h = handles();
  const auto intent = drag(h.size, h.centre + 1.5 * (h.size - h.centre));
  ASSERT_TRUE(intent);
  EXPECT_NEAR(intent->place.cellSize, 3, 1e-9);
  EXPECT_EQ(intent->place.origin, spec_.latticeOrigin);
  const auto snappedTo = drag(h.size, h.centre + 1.52 * (h.size - h.centre), ui::modifier::shift);
  EXPECT_NEAR(snappedTo->place.cellSize, 3, 1e-9);
}

TEST_F(LatticeToolTest, TurningAboutAnotherRingKeepsThatRingInPlace) {
  const LatticeHandles h = latticeHandles(spec_, {20, 20}, {30, 30}, kScale);
  tool_.press(at(h.turn), spec_, h, kScale);
  const auto intent = tool_.release(
      at(h.centre + glm::distance(h.turn, h.centre) * directionOf(kPi / 2 + 0.3)), targets_, kScale);
  ASSERT_TRUE(intent);
  LayoutSpec after = spec_;
  placeLattice(after, intent->place);
  EXPECT_NEAR(glm::distance(cellAt(after, h.centre).polygon.centroid(), h.centre), 0, 1e-9);
}

TEST_F(LatticeToolTest, BackWhereItWasOrCancelledChangesNothing) {
  EXPECT_FALSE(drag(handles().centre, handles().centre));
  tool_.press(at(handles().centre), spec_, handles(), kScale);
  EXPECT_TRUE(tool_.cancel());
  EXPECT_FALSE(tool_.release(at({3, 3}), targets_, kScale));
}

TEST(MeasureTool, LandsOnCornersAndSaysHowFarAndWhichWay) {
  LayoutSpec spec;
  spec.cellSize = 1;
  constexpr double kScale = 50;
  const std::array<glm::dvec2, 2> corners{{{20, 20}, {23, 24}}};
  const SnapTargets targets{corners, 0.1, {}};
  const auto at = [&](const glm::dvec2& world, int modifiers = 0) {
    return PointerEvent{PointerEvent::Kind::move, ui::mouse::left, modifiers, world * kScale, world};
  };
  MeasureTool tool;
  tool.press(at({20.1, 19.95}), spec, targets, kScale);
  tool.move(at({23.05, 24.1}), spec, targets, kScale);
  tool.release();
  tool.move(at({90, 90}), spec, targets, kScale);
  ASSERT_TRUE(tool.ruler());
  EXPECT_EQ(tool.ruler()->from, corners[0]);
  EXPECT_EQ(tool.ruler()->to, corners[1]);
  EXPECT_EQ(describe(*tool.ruler()), "5.000 m at 53.1°\nx 3.000 m, y 4.000 m");
  const glm::dvec2 cellCorner = cellAt(spec, {0, 0}).polygon.corners.front();
  tool.press(at(cellCorner + 0.05), spec, {}, kScale);
  EXPECT_EQ(tool.ruler()->from, cellCorner);
  tool.press(at({20.1, 19.95}, ui::modifier::alt), spec, targets, kScale);
  EXPECT_EQ(tool.ruler()->from, glm::dvec2(20.1, 19.95));
}

}  // namespace
}  // namespace acentric::editor
