#include "editor/commands/selection.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

Layout hexagonLayout() {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  return *buildLayout(spec);
}

TEST(Selection, CombinesAsAskedFor) {
  const CellId a{0, 0, 0}, b{1, 0, 0}, c{2, 0, 0};
  EXPECT_EQ(combined({a, b}, {c}, Combine::replace), (std::set<CellId>{c}));
  EXPECT_EQ(combined({a, b}, {b, c}, Combine::add), (std::set<CellId>{a, b, c}));
  EXPECT_EQ(combined({a, b}, {b, c}, Combine::toggle), (std::set<CellId>{a, c}));
}

TEST(Selection, ABoxTouchesWhatItHoldsCrossesOrLiesIn) {
  const Layout layout = hexagonLayout();
  const Region& region = layout.regions[layout.regions.size() / 2];
  const glm::dvec2 middle = region.polygon.centroid();
  EXPECT_EQ(cellsTouching(layout, middle - 0.01, middle + 0.01), std::vector<CellId>{region.id});
  EXPECT_EQ(cellsTouching(layout, glm::dvec2(-100), glm::dvec2(100)).size(), layout.regions.size());
  EXPECT_TRUE(cellsTouching(layout, {50, 50}, {60, 60}).empty());
  // The box of a triangle's bounds is more than the triangle.
  const ConvexPolygon triangle{{{0, 0}, {2, 0}, {0, 2}}};
  EXPECT_FALSE(touches(triangle, {1.6, 1.6}, {1.9, 1.9}));
  EXPECT_TRUE(touches(triangle, {0.9, 0.9}, {1.9, 1.9}));
  EXPECT_TRUE(touches(triangle, {-5, 0.5}, {5, 0.6})) << "it goes through, with no corner inside";
}

TEST(Selection, InvertingTwiceIsNothing) {
  const Layout layout = hexagonLayout();
  const std::set<CellId> some = cellsWhere(layout, [](std::size_t r) { return r % 3 == 0; });
  const std::set<CellId> others = inverted(layout, some);
  EXPECT_EQ(some.size() + others.size(), layout.regions.size());
  EXPECT_EQ(inverted(layout, others), some);
}

TEST(Selection, OverBudgetIsAboveItNotAtIt) {
  const Layout layout = hexagonLayout();
  RegionBudgets budgets;
  budgets.triangles.assign(layout.regions.size(), 10);
  budgets.triangles[2] = 11;
  EXPECT_EQ(overBudget(layout, budgets, 10), std::set<CellId>{layout.regions[2].id});
  EXPECT_EQ(overBudget(layout, budgets, 9).size(), layout.regions.size());
}

TEST(Selection, WarningsAreOfRegionsAndOfTheCamerasThatTheyShow) {
  const Layout layout = hexagonLayout();
  PlacementReport report;
  PlacementFinding note, region, camera;
  note.severity = Severity::note;
  note.region = 0;
  region.severity = Severity::warning;
  region.region = 3;
  report.findings = {note, region};
  EXPECT_EQ(withWarnings(layout, report), std::set<CellId>{layout.regions[3].id});
  camera.severity = Severity::error;
  camera.cameras = {layout.regions[5].covers.front().pieces.front().camera};
  report.findings = {camera};
  const std::set<CellId> found = withWarnings(layout, report);
  EXPECT_TRUE(found.contains(layout.regions[5].id));
  EXPECT_LT(found.size(), layout.regions.size() / 2);
}

}  // namespace
}  // namespace acentric::editor
