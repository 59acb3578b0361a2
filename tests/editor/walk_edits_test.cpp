#include "editor/commands/walk_edits.h"

#include <gtest/gtest.h>

#include "editor/session/history.h"
#include "editor/tools/walk_selection.h"

namespace acentric::editor {
namespace {

const PathPose kHere{{1, 2, 1.6}, 0.5, -0.1};

Project project() {
  Project project;
  project.scene = "room.obj";
  project.fovDegrees = 75;
  return project;
}

CameraPath threePoses() { return {{{{0, 0, 1.6}, 0, 0, 0}, {{4, 0, 1.6}, 0, 0, 2}, {{4, 3, 1.6}, 0, 0, 5}}}; }

TEST(WalkEdits, ABookmarkHoldsTheViewAndAFreeName) {
  Project edited = addBookmark(project(), kHere).project;
  edited = addBookmark(edited, kHere).project;
  edited = removeBookmark(edited, 0).project;
  edited = addBookmark(edited, kHere).project;
  ASSERT_EQ(edited.bookmarks.size(), 2u);
  EXPECT_EQ(edited.bookmarks[0].name, "place 2");
  EXPECT_EQ(edited.bookmarks[1].name, "place 1");
  EXPECT_EQ(edited.bookmarks[1].eye, kHere.eye);
  EXPECT_EQ(edited.bookmarks[1].fovDegrees, 75);
  EXPECT_TRUE(edited.check());
}

TEST(WalkEdits, UpdatingKeepsTheNameAndTakesTheView) {
  Project edited = renameBookmark(addBookmark(project(), kHere).project, 0, "door").project;
  edited.fovDegrees = 50;
  edited = updateBookmark(edited, 0, {{-1, 0, 1.5}, radians(115), radians(-5)}).project;
  EXPECT_EQ(edited.bookmarks[0], (Bookmark{"door", 0, {-1, 0, 1.5}, radians(115), radians(-5), 50}));
}

TEST(WalkEdits, AnUnsoundNameIsLeftToTheCheck) {
  Project edited = addBookmark(addBookmark(project(), kHere).project, kHere).project;
  EXPECT_FALSE(renameBookmark(edited, 0, "place 2").project.check());
  EXPECT_FALSE(renameBookmark(edited, 0, "").project.check());
  edited = addPath(addPath(project(), threePoses(), 0).project, threePoses(), 0).project;
  EXPECT_FALSE(renamePath(edited, 1, "walk 1").project.check());
}

TEST(WalkEdits, ListsAreReorderedAndEndAtTheirEnds) {
  Project edited = project();
  for (int i = 0; i < 3; ++i) edited = addPath(edited, threePoses(), 0).project;
  EXPECT_EQ(movePath(edited, 0, -1).project, edited);
  EXPECT_EQ(movePath(edited, 2, 1).project, edited);
  const Project moved = movePath(edited, 2, -1).project;
  EXPECT_EQ(moved.paths[1].name, "walk 3");
  EXPECT_EQ(movePath(moved, 1, 1).project, edited);
}

TEST(WalkEdits, GoingToABookmarkChangesStoreyAndFieldOfViewAlone) {
  Project edited = addBookmark(project(), kHere).project;
  edited.storeys.push_back({"attic", {}, {}, {}});
  edited.storey = 1;
  edited.fovDegrees = 40;
  Project gone = goToBookmark(edited, 0).project;
  EXPECT_EQ(gone.storey, 0);
  EXPECT_EQ(gone.fovDegrees, 75);
  gone.storey = 1;
  gone.fovDegrees = 40;
  EXPECT_EQ(gone, edited);
}

TEST(WalkEdits, AllOfThemAreUndone) {
  const Project before = addBookmark(addPath(project(), threePoses(), 0).project, kHere).project;
  for (const Edit& edit :
       {addBookmark(before, kHere), renameBookmark(before, 0, "door"), updateBookmark(before, 0, {}),
        removeBookmark(before, 0), addPath(before, threePoses(), 0), renamePath(before, 0, "round"),
        removePath(before, 0), setPath(before, 0, withoutPose(threePoses(), 1))}) {
    History history(before, true);
    history.push(edit.project, edit.label);
    EXPECT_TRUE(history.canUndo()) << edit.label;
    history.undo();
    EXPECT_EQ(history.current(), before) << edit.label;
    history.redo();
    EXPECT_EQ(history.current(), edit.project) << edit.label;
  }
}

TEST(PathPoses, ATimeStaysBetweenThoseOfItsNeighbours) {
  const CameraPath path = threePoses();
  PathPose pose = path.poses[1];
  pose.seconds = 60;
  EXPECT_NEAR(withPose(path, 1, pose).poses[1].seconds, 5 - kLeastKeySeconds, 1e-12);
  pose.seconds = -3;
  EXPECT_NEAR(withPose(path, 1, pose).poses[1].seconds, kLeastKeySeconds, 1e-12);
  EXPECT_EQ(withPose(path, 0, pose).poses[0].seconds, 0);
  pose.seconds = 9;
  EXPECT_EQ(withPose(path, 2, pose).poses[2].seconds, 9);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(withPose(path, i, pose).check());
}

TEST(PathPoses, ANewOneChangesNothingOfTheWalk) {
  const auto [path, number] = withPoseAt(threePoses(), 1);
  EXPECT_EQ(number, 1u);
  ASSERT_EQ(path.poses.size(), 4u);
  for (double t = 0; t <= 5; t += 0.25)
    EXPECT_LT(glm::distance(poseAt(path, t).eye, poseAt(threePoses(), t).eye), 1e-9);
}

TEST(PathPoses, NoNewOneWhereOneIs) {
  for (const double seconds : {-1.0, 0.0, 0.001, 2.0, 4.9995, 5.0, 99.0})
    EXPECT_EQ(withPoseAt(threePoses(), seconds).first, threePoses()) << seconds;
  EXPECT_EQ(withPoseAt(threePoses(), 2).second, 1u);
}

TEST(PathPoses, WithoutTheFirstThePathBeginsWithTheSecondAndOneIsLeft) {
  CameraPath path = withoutPose(threePoses(), 0);
  EXPECT_EQ(path.poses[0].eye, glm::dvec3(4, 0, 1.6));
  EXPECT_EQ(path.poses[0].seconds, 0);
  EXPECT_EQ(path.poses[1].seconds, 3);
  path = withoutPose(withoutPose(path, 0), 0);
  EXPECT_EQ(path.poses.size(), 1u);
  EXPECT_TRUE(path.check());
}

TEST(WalkSelection, KnowsWhatIsThere) {
  Project some = addPath(project(), threePoses(), 0).project;
  WalkSelection selection{WalkSelection::Kind::path, 0, 2};
  EXPECT_EQ(selection.path(some), &some.paths[0]);
  EXPECT_EQ(selection.bookmark(some), nullptr);
  EXPECT_EQ(selection.poseIn(some), 2u);
  some.paths[0].path = withoutPose(threePoses(), 0);
  EXPECT_EQ(selection.poseIn(some), std::nullopt);
  EXPECT_EQ(selection.path(project()), nullptr);
}

}  // namespace
}  // namespace acentric::editor
