#include "editor/commands/storey_edits.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

Project house() {
  Project project;
  project.scene = "house.glb";
  project.storeys = {{"hall", {}, {}, {}}, {"cellar", {}, {}, {}}, {"attic", {}, {}, {}}};
  project.storeys[1].layout.floorHeight = -2.5;
  project.storeys[2].layout.floorHeight = 2.8;
  return project;
}

TEST(StoreyEdits, StepsGoByHeightAndEndAtTheEnds) {
  Project project = house();
  EXPECT_EQ(storeyBeside(project, 1), 2);
  EXPECT_EQ(storeyBeside(project, -1), 1);
  project.storey = 2;
  EXPECT_EQ(storeyBeside(project, 1), std::nullopt);
  project.storey = 1;
  EXPECT_EQ(storeyBeside(project, -1), std::nullopt);
}

TEST(StoreyEdits, StepsGoPastPiecesOfStairs) {
  Project project = house();
  project.storeys.push_back({"stairs 1.1", {}, {}, {}});
  project.storeys[3].layout.floorHeight = 0.3;
  project.storeys[3].layout.slope = GroundSlope{};
  EXPECT_EQ(storeyBeside(project, 1), 2);
  project.storey = 3;
  EXPECT_EQ(storeyBeside(project, 1), 2);
  EXPECT_EQ(storeyBeside(project, -1), 0);
}

TEST(StoreyEdits, ShowingOneChangesNothingElse) {
  const Edit edit = showStorey(house(), 2);
  EXPECT_EQ(edit.project.layout().floorHeight, 2.8);
  Project back = edit.project;
  back.storey = 0;
  EXPECT_EQ(back, house());
}

TEST(StoreyEdits, RemovingKeepsAProjectSound) {
  Project project = house();
  project.storey = 2;
  for (std::size_t left = project.storeys.size(); left > 1; --left) {
    project = removeStorey(project).project;
    EXPECT_EQ(project.storeys.size(), left - 1);
    EXPECT_TRUE(project.check());
  }
  EXPECT_EQ(project.current().name, "hall");
  EXPECT_EQ(removeStorey(project).project, project) << "the last one stays";
}

TEST(StoreyEdits, AnUnsoundNameIsLeftToTheCheck) {
  EXPECT_TRUE(renameStorey(house(), "lobby").project.check());
  EXPECT_FALSE(renameStorey(house(), "attic").project.check()) << "two of one name";
  EXPECT_FALSE(renameStorey(house(), "").project.check());
}

}  // namespace
}  // namespace acentric::editor
