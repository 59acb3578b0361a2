#include "editor/commands/layout_edits.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

Project squareRoom() {
  Project project;
  project.scene = "room.obj";
  project.layout().cellSize = 1;
  project.layout().outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  return project;
}

std::set<CellId> placedCells(const LayoutSpec& spec) {
  const auto layout = buildLayout(spec);
  std::set<CellId> cells;
  if (layout)
    for (const Region& region : layout->regions) cells.insert(region.id);
  return cells;
}

TEST(LayoutEdits, IsPlacedAgreesWithTheLayoutThatIsBuilt) {
  Project project = squareRoom();
  project.layout().removed.insert(cellAt(project.layout(), {0, 0}).id);
  project.layout().added.insert(cellAt(project.layout(), {8, 8}).id);
  const std::set<CellId> built = placedCells(project.layout());
  for (const LatticeCell& cell : cellsIn(project.layout(), {-10, -10}, {10, 10}, 1000))
    EXPECT_EQ(isPlaced(project.layout(), cell.id), built.contains(cell.id));
}

TEST(LayoutEdits, RemovingThenAddingACellOfTheOutlineRestoresTheSpec) {
  const Project project = squareRoom();
  const CellId cell = cellAt(project.layout(), {0.2, 0.1}).id;
  const Edit removed = removeCells(project, {cell});
  EXPECT_FALSE(isPlaced(removed.project.layout(), cell));
  EXPECT_TRUE(removed.project.layout().removed.contains(cell));
  const Edit added = addCell(removed.project, cell);
  EXPECT_EQ(added.project, project);
}

TEST(LayoutEdits, AddingThenRemovingACellOutsideTheOutlineRestoresTheSpec) {
  const Project project = squareRoom();
  const CellId cell = cellAt(project.layout(), {12, 0}).id;
  ASSERT_FALSE(isPlaced(project.layout(), cell));
  const Edit added = addCell(project, cell);
  EXPECT_TRUE(isPlaced(added.project.layout(), cell));
  EXPECT_EQ(removeCells(added.project, {cell}).project, project);
}

TEST(LayoutEdits, NearestSlotIsTheCellItselfAtItsOwnCentre) {
  const LayoutSpec spec = squareRoom().layout();
  for (const LatticeCell& cell : cellsIn(spec, {-4, -4}, {4, 4}, 200))
    EXPECT_EQ(nearestSlot(spec, cell.id, cell.polygon.centroid()), cell.id);
}

TEST(LayoutEdits, AnotherConfigurationDropsCellsThatWereAddressedInTheOldLattice) {
  Project project = squareRoom();
  project.layout().added.insert(cellAt(project.layout(), {12, 0}).id);
  const Edit edit = setConfiguration(project, Configuration::e);
  EXPECT_TRUE(edit.project.layout().added.empty());
  EXPECT_EQ(setConfiguration(project, project.layout().configuration).project, project);
}

TEST(LayoutEdits, NameWhatTheyDo) {
  const Project project = squareRoom();
  EXPECT_EQ(setCellSize(project, 2.5).label, "Cell size 2.50 m");
  EXPECT_EQ(removeCells(project, {CellId{0, 0, 0}, CellId{1, 0, 0}}).label, "Remove 2 cells");
  EXPECT_EQ(addCell(project, CellId{3, -1, 2}).label, "Add cell (3, -1, 2)");
  EXPECT_EQ(setOutline(project, {}).label, "Clear outline");
}

TEST(LayoutEdits, JoiningUndoesASplitAndWhatWasChosenWithin) {
  Project project = squareRoom();
  project.layout().configuration = Configuration::e;
  project.layout().removed.clear(), project.layout().added.clear();
  const Project before = project;
  const CellId whole = cellAt(project.layout(), {0.3, 0.2}).id;
  ASSERT_TRUE(canSplitCell(project.layout(), whole));
  project = splitCells(project, {whole}).project;
  EXPECT_FALSE(isPlaced(project.layout(), whole));
  EXPECT_FALSE(canSplitCell(project.layout(), whole)) << "it is not there any more";
  const auto parts = partsOf(project.layout(), whole);
  for (const CellId& part : parts) EXPECT_TRUE(isPlaced(project.layout(), part));
  project = splitCells(project, {parts[1]}).project;
  project = removeCells(project, {parts[0], partsOf(project.layout(), parts[1])[3]}).project;
  ASSERT_TRUE(project.check());
  EXPECT_EQ(joinCells(project, {parts[2]}).project, before);
  EXPECT_EQ(joinCells(before, {whole}).project, before) << "a whole has nothing to join";
}

TEST(LayoutEdits, OnlySquaresAndTrianglesAreSplit) {
  Project project = squareRoom();
  project.layout().configuration = Configuration::b;
  const CellId cell = cellAt(project.layout(), {2.5, 2.5}).id;
  EXPECT_EQ(splitCells(project, {cell}).project, project);
}

TEST(LayoutEdits, PanoramasBesideTheLatticeGetNumbersOfTheirOwn) {
  Project project = squareRoom();
  const Apv apv{{1, 2}, {0.5, 0}, 90, Hand::clockwise};
  project = addFreeApv(addFreeApv(project, apv).project, apv).project;
  ASSERT_EQ(project.layout().freeApvs.size(), 2U);
  EXPECT_TRUE(isPlaced(project.layout(), {1, 0, kFreeSlot}));
  project = removeCells(project, {{0, 0, kFreeSlot}}).project;
  EXPECT_EQ(project.layout().freeApvs.begin()->first, 1);
  EXPECT_EQ(nextFreeNumber(project.layout()), 2) << "a number is not used again while a higher one is there";
}

TEST(LayoutEdits, CellsThatStayedSelectedFromAnotherConfigurationChangeNothing) {
  Project project;
  project.layout().outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  const std::set<CellId> stale{{0, 0, 2, 0}, {1, 0, 7, 0}, {1, 1, 0, 2}};
  for (int i = 0; i <= int(Configuration::g); ++i) {
    project.layout().configuration = Configuration(i);
    project.layout().removed.clear();
    EXPECT_FALSE(isPlaced(project.layout(), {1, 0, 7, 0}));
    for (const Edit& edit : {removeCells(project, {{1, 0, 7, 0}, {1, 1, 0, 2}}), joinCells(project, stale),
                             splitCells(project, {{1, 0, 7, 0}})})
      EXPECT_EQ(edit.project, project) << nameOf(Configuration(i)) << ": " << edit.label;
  }
}

}  // namespace
}  // namespace acentric::editor
