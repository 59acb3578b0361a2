#include "editor/commands/group_edits.h"

#include <gtest/gtest.h>

#include <random>

#include "editor/commands/layout_edits.h"
#include "editor/commands/selection.h"

namespace acentric::editor {
namespace {

Project roomOf(Configuration configuration) {
  Project project;
  project.scene = "room.obj";
  project.layout().configuration = configuration;
  project.layout().cellSize = 1;
  project.layout().outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  return project;
}

std::set<CellId> placedIn(const Project& project) {
  const auto layout = buildLayout(project.layout());
  return layout ? inverted(*layout, {}) : std::set<CellId>{};
}

std::set<CellId> cellsAround(const Project& project, const glm::dvec2& low, const glm::dvec2& high) {
  const auto layout = buildLayout(project.layout());
  const auto cells = cellsTouching(*layout, low, high);
  return {cells.begin(), cells.end()};
}

class GroupEdits : public testing::TestWithParam<Configuration> {};

TEST_P(GroupEdits, AShiftMovesEveryCellByTheSameWay) {
  Project project = roomOf(GetParam());
  if (canSplit(GetParam())) {
    const CellId whole = cellAt(project.layout(), {0.4, 0.3}).id;
    project = splitCells(project, {whole}).project;
    project = splitCells(project, {partsOf(project.layout(), whole)[2]}).project;
  }
  const std::set<CellId> cells = cellsAround(project, {-1, -1}, {1, 1});
  ASSERT_GT(cells.size(), 3U);
  const CellGroup group(project.layout(), cells);
  for (const LatticeStep step : {LatticeStep{1, 0}, {0, 1}, {-3, 2}})
    for (const CellGroup::Landing& landing : group.landings(step, true)) {
      const glm::dvec2 way = cellPolygon(project.layout(), landing.to).centroid() -
                             cellPolygon(project.layout(), landing.from).centroid();
      EXPECT_NEAR(glm::distance(way, group.metresOf(step)), 0, 1e-9);
      EXPECT_EQ(group.nearestStep(group.metresOf(step) + glm::dvec2(0.1, -0.1)), step);
    }
}

TEST_P(GroupEdits, MovesKeepTheNumberOfCellsAndBackIsAsBefore) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> steps(-4, 4);
  Project project = roomOf(GetParam());
  const std::size_t count = placedIn(project).size();
  std::set<CellId> cells = cellsAround(project, {1.5, 1.5}, {2.5, 2.5});
  int moved = 0;
  for (int i = 0; i < 40; ++i) {
    const LatticeStep step{steps(random), steps(random)};
    const GroupEdit edit = moveCells(project, cells, step);
    EXPECT_TRUE(edit.edit.project.check());
    if (edit.skipped > 0 || step == LatticeStep{}) {
      EXPECT_EQ(edit.edit.project, project);
      continue;
    }
    ++moved;
    EXPECT_EQ(placedIn(edit.edit.project).size(), count);
    EXPECT_EQ(moveCells(edit.edit.project, edit.cells, {-step.i, -step.j}).edit.project, project);
    project = edit.edit.project;
    cells = edit.cells;
  }
  EXPECT_GT(moved, 1);
}

TEST_P(GroupEdits, ACopyLandsOnTheNearestFreePlaces) {
  const Project project = roomOf(GetParam());
  const std::set<CellId> before = placedIn(project);
  const std::set<CellId> cells = cellsAround(project, {-1, -1}, {1, 1});
  const CellGroup group(project.layout(), cells);
  const auto step = group.nearestFreeStep();
  ASSERT_TRUE(step);
  EXPECT_TRUE(group.fits(*step, false));
  for (int i = -15; i <= 15; ++i)
    for (int j = -15; j <= 15; ++j)
      if (glm::length(group.metresOf({i, j})) < glm::length(group.metresOf(*step)) - 1e-9) {
        EXPECT_FALSE(group.fits({i, j}, false)) << i << ", " << j;
      }
  const GroupEdit copy = copyCells(project, cells, {*step});
  EXPECT_EQ(copy.skipped, 0);
  EXPECT_EQ(copy.cells.size(), cells.size());
  const std::set<CellId> after = placedIn(copy.edit.project);
  EXPECT_EQ(after.size(), before.size() + cells.size());
  for (const CellId& cell : copy.cells) EXPECT_TRUE(after.contains(cell) && !before.contains(cell));
}

TEST_P(GroupEdits, OppositeNudgesUndoEachOther) {
  const Project project = roomOf(GetParam());
  const CellGroup group(project.layout(), {cellAt(project.layout(), {0, 0}).id});
  for (const glm::dvec2 direction : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
    const LatticeStep there = group.stepTowards(direction), back = group.stepTowards(-direction);
    EXPECT_EQ(back, (LatticeStep{-there.i, -there.j}));
    EXPECT_GT(glm::dot(group.metresOf(there), direction), 0.4 * glm::length(group.metresOf(there)));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryConfiguration, GroupEdits,
                         testing::Values(Configuration::a, Configuration::b, Configuration::c,
                                         Configuration::d, Configuration::e, Configuration::f,
                                         Configuration::g));

TEST(GroupEdit, ATakenPlaceLeavesAllAsItIs) {
  const Project project = roomOf(Configuration::e);
  const CellId inside = cellAt(project.layout(), {0.1, 0.1}).id;
  const GroupEdit edit = moveCells(project, {inside}, {1, 0});
  EXPECT_EQ(edit.skipped, 1);
  EXPECT_EQ(edit.edit.project, project);
}

TEST(GroupEdit, CellsMayTakeOneAnothersPlaces) {
  Project project = roomOf(Configuration::e);
  project.layout().outline = {};
  project.layout().added = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const GroupEdit edit = moveCells(project, project.layout().added, {1, 0});
  EXPECT_EQ(edit.skipped, 0);
  EXPECT_EQ(edit.edit.project.layout().added, (std::set<CellId>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(edit.edit.label, "Move 3 cells");
}

TEST(GroupEdit, PartsOfASplitCellOnlyGoWhereOneIsSplit) {
  Project project = roomOf(Configuration::e);
  project.layout().outline = {};
  project.layout().added = {{0, 0, 0}};
  project = splitCells(project, {{0, 0, 0}}).project;
  const auto parts = partsOf(project.layout(), {0, 0, 0});
  EXPECT_EQ(moveCells(project, {parts[0]}, {40, 0}).skipped, 1) << "no place of this size there";
  project = removeCells(project, {parts[1]}).project;
  const LatticeStep step{parts[1].i - parts[0].i, parts[1].j - parts[0].j};
  const GroupEdit edit = moveCells(project, {parts[0]}, step);
  EXPECT_EQ(edit.skipped, 0);
  EXPECT_TRUE(isPlaced(edit.edit.project.layout(), parts[1]));
  EXPECT_FALSE(isPlaced(edit.edit.project.layout(), parts[0]));
}

TEST(GroupEdit, SinglePanoramasGoAlong) {
  Project project = roomOf(Configuration::e);
  project.layout().freeApvs[3] = {{1, 1}, {0.4, 0}, 90, Hand::clockwise};
  const CellId edge = cellAt(project.layout(), {2.9, 0}).id;
  const CellGroup group(project.layout(), {edge, {3, 0, kFreeSlot}});
  const LatticeStep far{5, 0};
  const GroupEdit copy = copyCells(project, {edge, {3, 0, kFreeSlot}}, {far});
  ASSERT_TRUE(copy.edit.project.layout().freeApvs.contains(4));
  EXPECT_EQ(copy.edit.project.layout().freeApvs.at(4).centre, glm::dvec2(1, 1) + group.metresOf(far));
  EXPECT_TRUE(copy.cells.contains({4, 0, kFreeSlot}));
  const GroupEdit move = moveCells(project, {{3, 0, kFreeSlot}}, {1, 0});
  EXPECT_EQ(move.edit.project.layout().freeApvs.at(3).centre, glm::dvec2(2, 1));
}

TEST(CellArray, LaysCopiesAlongBothDirectionsAndSkipsWhatIsTaken) {
  Project project = roomOf(Configuration::e);
  project.layout().outline = {};
  project.layout().added = {{0, 0, 0}, {1, 0, 0}, {4, 1, 0}};
  CellArray array = roomyArray(project.layout(), {{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(array.everyI, 2);
  EXPECT_EQ(array.everyJ, 1);
  array.countI = 3, array.countJ = 2;
  EXPECT_EQ(array.steps().size(), 5U);
  const GroupEdit edit = copyCells(project, {{0, 0, 0}, {1, 0, 0}}, array.steps());
  EXPECT_EQ(edit.skipped, 1);
  EXPECT_EQ(edit.cells.size(), 9U);
  EXPECT_EQ(edit.edit.project.layout().added.size(), 12U);
}

}  // namespace
}  // namespace acentric::editor
