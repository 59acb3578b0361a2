#include "editor/session/backdrop.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

Outline rectangle(const glm::dvec2& low, const glm::dvec2& high) {
  return {{{low, {high.x, low.y}, high, {low.x, high.y}}}};
}

TEST(Backdrop, ShowsGroundThatCanStillBeLaidOutButNotFarAway) {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline = rectangle({0, 0}, {10, 8});
  const auto layout = buildLayout(spec);
  ASSERT_TRUE(layout) << layout.error().describe();
  const Bounds scene{{-500, -500, 0}, {500, 500, 3}};
  const PlanBox laid = planBoxOf(scene, *layout, {});
  EXPECT_LT(laid.min.y, 0);
  EXPECT_GT(laid.min.y, -8);
  const PlanBox near = planBoxOf(scene, *layout, rectangle({0, -12}, {10, 8}));
  EXPECT_LT(near.min.y, -12);
  EXPECT_NEAR(near.min.x, laid.min.x, 0.1);
  const PlanBox far = planBoxOf(scene, *layout, rectangle({0, -400}, {10, 8}));
  EXPECT_LT(far.min.y, -12);
  EXPECT_GT(far.min.y, -60);
}

}  // namespace
}  // namespace acentric::editor
