#include "editor/session/history.h"

#include <gtest/gtest.h>

#include <random>

namespace acentric::editor {
namespace {

Project projectWithCell(double metres) {
  Project project;
  project.scene = "room.obj";
  project.layout().cellSize = metres;
  return project;
}

TEST(History, UndoAndRedoStepThroughEdits) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(2), "Two");
  history.push(projectWithCell(3), "Three");
  EXPECT_EQ(history.undoLabel(), "Three");
  history.undo();
  EXPECT_EQ(history.current().layout().cellSize, 2);
  EXPECT_EQ(history.redoLabel(), "Three");
  history.undo();
  EXPECT_FALSE(history.canUndo());
  EXPECT_EQ(history.undoLabel(), "");
  history.redo();
  history.redo();
  EXPECT_EQ(history.current().layout().cellSize, 3);
  EXPECT_FALSE(history.canRedo());
}

TEST(History, WalkingIntoAnotherStoreyIsNoEdit) {
  Project project = projectWithCell(1);
  project.storeys.push_back({"above", {}, {}, {}});
  History history(project, true);
  history.walkInto(1);
  EXPECT_EQ(history.current().storey, 1);
  EXPECT_FALSE(history.dirty());
  EXPECT_FALSE(history.canUndo());
  Project edited = history.current();
  edited.layout().cellSize = 3;
  history.push(edited, "Two");
  history.walkInto(0);
  EXPECT_EQ(history.current().storey, 0);
  EXPECT_TRUE(history.dirty());
  history.undo();
  EXPECT_EQ(history.current().storey, 1) << "where the edit was made";
  EXPECT_FALSE(history.dirty());
}

TEST(History, AnEditThatChangesNothingIsNoEntry) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(1), "Nothing");
  EXPECT_FALSE(history.canUndo());
}

TEST(History, ANewEditForgetsWhatCouldBeRedone) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(2), "Two");
  history.undo();
  history.push(projectWithCell(3), "Three");
  EXPECT_FALSE(history.canRedo());
  history.undo();
  EXPECT_EQ(history.current().layout().cellSize, 1);
}

TEST(History, ADragIsOneEntry) {
  History history(projectWithCell(1), true);
  for (int i = 0; i < 50; ++i) history.preview(projectWithCell(1 + 0.1 * i), "Drag");
  history.commitPreview();
  EXPECT_EQ(history.size(), 2U);
  history.undo();
  EXPECT_EQ(history.current().layout().cellSize, 1);
}

TEST(History, ADragBackToWhereItBeganIsNoEntryAndKeepsRedo) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(2), "Two");
  history.undo();
  history.preview(projectWithCell(5), "Drag");
  history.preview(projectWithCell(1), "Drag");
  history.commitPreview();
  EXPECT_FALSE(history.canUndo());
  ASSERT_TRUE(history.canRedo());
  history.redo();
  EXPECT_EQ(history.current().layout().cellSize, 2);
}

TEST(History, ARolledBackDragLeavesNoTrace) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(2), "Two");
  history.undo();
  history.preview(projectWithCell(7), "Drag");
  history.rollbackPreview();
  EXPECT_EQ(history.current().layout().cellSize, 1);
  EXPECT_EQ(history.redoLabel(), "Two");
}

TEST(History, IsDirtyExactlyWhenItDiffersFromWhatWasSaved) {
  History history(projectWithCell(1), true);
  EXPECT_FALSE(history.dirty());
  history.push(projectWithCell(2), "Two");
  EXPECT_TRUE(history.dirty());
  history.markSaved();
  EXPECT_FALSE(history.dirty());
  history.undo();
  EXPECT_TRUE(history.dirty());
  history.redo();
  EXPECT_FALSE(history.dirty());
  EXPECT_TRUE(History(projectWithCell(1), false).dirty());
}

TEST(History, AnImpossibleEditIsForgotten) {
  History history(projectWithCell(1), true);
  history.push(projectWithCell(2), "Two");
  history.discardCurrent();
  EXPECT_EQ(history.current().layout().cellSize, 1);
  EXPECT_FALSE(history.canRedo());
}

TEST(History, UndoThenRedoIsTheIdentityAfterAnySequence) {
  std::mt19937 random(11);
  History history(projectWithCell(1), true);
  for (int step = 0; step < 2000; ++step) {
    switch (random() % 5) {
      case 0:
        history.push(projectWithCell(1 + double(random() % 40)), "Edit");
        break;
      case 1:
        history.undo();
        break;
      case 2:
        history.redo();
        break;
      case 3:
        history.preview(projectWithCell(1 + double(random() % 40)), "Drag");
        break;
      case 4:
        random() % 2 ? history.commitPreview() : history.rollbackPreview();
        break;
    }
    if (history.previewing() || !history.canUndo()) continue;
    const Project now = history.current();
    history.undo();
    history.redo();
    ASSERT_EQ(history.current(), now) << "after step " << step;
    ASSERT_LE(history.size(), History::kMostEntries);
  }
}

}  // namespace
}  // namespace acentric::editor
