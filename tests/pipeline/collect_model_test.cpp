/// Models that lie outside a project's folder, brought into it.

#include "engine/pipeline/collect_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "engine/base/file.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// A floor whose material library the model names as `library`.
std::string floorOf(const std::string& library) {
  return "mtllib " + library + "\nusemtl red\nv 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nf 4 3 2 1\n";
}
const char* const kRed = "newmtl red\nKd 1 0 0\n";

class CollectTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_collect_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    host_.importer = ACENTRIC_IMPORTER;
    host_.cacheFolder = folder_ / "cache";
    fs::create_directories(folder_ / "walk");
  }
  void TearDown() override { fs::remove_all(folder_); }

  Result<CollectedModel> collect(const fs::path& model, Collect how = Collect::files) {
    return collectModel(model, project_(), {}, how, host_);
  }
  fs::path project_() const { return folder_ / "walk" / "walk.acentric.json"; }
  ContentKey keyOfScene(const fs::path& model) {
    const auto scene = importScene(model, {}, host_);
    EXPECT_TRUE(scene) << scene.error().describe();
    return scene ? (*scene)->key : ContentKey{};
  }
  /// A project file that states `scene`, as older programs wrote them.
  void writeProject(const std::string& scene) {
    Project project;
    project.scene = "SCENE";
    project.exposure = 0.7F;
    std::string text = formatProject(project);
    text.replace(text.find("SCENE"), 5, scene);
    write(project_(), text);
  }

  fs::path folder_;
  ImportHost host_;
};

TEST_F(CollectTest, WhatLiesInTheFolderStaysWhereItIs) {
  write(folder_ / "walk" / "deep" / "floor.obj", floorOf("none.mtl"));
  const auto collected = collect(folder_ / "walk" / "deep" / "floor.obj");
  ASSERT_TRUE(collected) << collected.error().describe();
  EXPECT_EQ(collected->scene, "deep/floor.obj");
  EXPECT_TRUE(collected->folder.empty());
  EXPECT_FALSE(fs::exists(folder_ / "walk" / "models"));
}

TEST_F(CollectTest, AFolderReachedByALinkIsTheSameFolder) {
  write(folder_ / "walk" / "floor.obj", floorOf("none.mtl"));
  fs::create_directory_symlink(folder_ / "walk", folder_ / "other name");
  EXPECT_EQ(*scenePathFor(folder_ / "other name" / "floor.obj", project_()), "floor.obj");
  EXPECT_EQ(*scenePathFor(folder_ / "walk" / "floor.obj", folder_ / "other name" / "w.acentric.json"),
            "floor.obj");
}

TEST_F(CollectTest, AModelComesWithTheFilesItNames) {
  write(folder_ / "made" / "floor.obj", floorOf("parts/red.mtl"));
  write(folder_ / "made" / "parts" / "red.mtl", kRed);
  write(folder_ / "made" / "unrelated.txt", "no");
  const ContentKey key = keyOfScene(folder_ / "made" / "floor.obj");
  const auto collected = collect(folder_ / "made" / "floor.obj");
  ASSERT_TRUE(collected) << collected.error().describe();
  EXPECT_EQ(collected->scene, "models/floor/floor.obj");
  EXPECT_EQ(collected->files, 2U);
  EXPECT_TRUE(fs::exists(folder_ / "walk" / "models" / "floor" / "parts" / "red.mtl"));
  EXPECT_FALSE(fs::exists(folder_ / "walk" / "models" / "floor" / "unrelated.txt"));
  // The folder is whole without the originals.
  fs::remove_all(folder_ / "made");
  fs::remove_all(folder_ / "cache");
  fs::rename(folder_ / "walk", folder_ / "moved");
  EXPECT_EQ(keyOfScene(folder_ / "moved" / collected->scene), key);
}

TEST_F(CollectTest, FilesBesideTheModelsFolderKeepTheirPlaceToItWhereTheyMayBeRead) {
  host_.outsideFiles = true;
  write(folder_ / "made" / "obj" / "floor.obj", floorOf("../materials/red.mtl"));
  write(folder_ / "made" / "materials" / "red.mtl", kRed);
  const ContentKey key = keyOfScene(folder_ / "made" / "obj" / "floor.obj");
  const auto collected = collect(folder_ / "made" / "obj" / "floor.obj");
  ASSERT_TRUE(collected) << collected.error().describe();
  EXPECT_EQ(collected->scene, "models/floor/obj/floor.obj");
  fs::remove_all(folder_ / "made");
  fs::remove_all(folder_ / "cache");
  EXPECT_EQ(keyOfScene(folder_ / "walk" / collected->scene), key);
}

TEST_F(CollectTest, WhatWasBroughtOnceIsReadFromThereWithoutLeaveToReadOutside) {
  host_.outsideFiles = true;
  write(folder_ / "made" / "obj" / "floor.obj", floorOf("../materials/red.mtl"));
  write(folder_ / "made" / "materials" / "red.mtl", kRed);
  const ContentKey key = keyOfScene(folder_ / "made" / "obj" / "floor.obj");
  const auto collected = collect(folder_ / "made" / "obj" / "floor.obj");
  ASSERT_TRUE(collected) << collected.error().describe();
  const fs::path model = folder_ / "walk" / collected->scene;
  host_.outsideFiles = false;
  const ContentKey without = keyOfScene(model);
  EXPECT_NE(without, key) << "no project lies there yet";
  writeProject(collected->scene.generic_string());
  EXPECT_EQ(keyOfScene(model), key) << "also where it was imported with less before";

  // Out of models/NAME nothing leads: not a name, not a link.
  write(folder_ / "walk" / "models" / "red.mtl", "newmtl red\nKd 0 1 0\n");
  const fs::path library = folder_ / "walk" / "models" / "floor" / "materials" / "red.mtl";
  fs::remove(library);
  fs::create_symlink(folder_ / "walk" / "models" / "red.mtl", library);
  EXPECT_EQ(keyOfScene(model), without);
  write(model, floorOf("../../red.mtl"));
  EXPECT_EQ(keyOfScene(model), without);
}

TEST_F(CollectTest, TheSameModelComesOnceAndAnotherOfTheNameBesideIt) {
  write(folder_ / "a" / "floor.obj", floorOf("none.mtl"));
  write(folder_ / "b" / "floor.obj", floorOf("none.mtl") + "v 9 9 9\n");
  EXPECT_EQ(collect(folder_ / "a" / "floor.obj")->scene, "models/floor/floor.obj");
  const auto again = collect(folder_ / "a" / "floor.obj");
  EXPECT_EQ(again->scene, "models/floor/floor.obj");
  EXPECT_TRUE(again->folder.empty()) << "nothing was made";
  EXPECT_EQ(collect(folder_ / "b" / "floor.obj")->scene, "models/floor-2/floor.obj");
  EXPECT_EQ(collect(folder_ / "b" / "floor.obj")->scene, "models/floor-2/floor.obj");
}

TEST_F(CollectTest, ALinkLeadsToTheModelAndItsFilesTakeItsPlace) {
  write(folder_ / "made" / "floor.obj", floorOf("red.mtl"));
  write(folder_ / "made" / "red.mtl", kRed);
  const ContentKey key = keyOfScene(folder_ / "made" / "floor.obj");
  const auto linked = collect(folder_ / "made" / "floor.obj", Collect::link);
  ASSERT_TRUE(linked) << linked.error().describe();
  EXPECT_EQ(linked->scene, "models/floor/floor.obj");
  EXPECT_TRUE(fs::is_symlink(folder_ / "walk" / linked->scene));
  EXPECT_EQ(keyOfScene(folder_ / "walk" / linked->scene), key) << "its files are found where they lie";
  EXPECT_TRUE(collect(folder_ / "made" / "floor.obj", Collect::link)->folder.empty());
  writeProject("models/floor/floor.obj");
  const auto whole = collectProject(project_(), Collect::files, host_);
  ASSERT_TRUE(whole) << whole.error().describe();
  EXPECT_EQ(whole->scene, linked->scene);
  EXPECT_FALSE(fs::is_symlink(folder_ / "walk" / whole->scene));
  EXPECT_EQ(keyOfScene(folder_ / "walk" / whole->scene), key);
}

TEST_F(CollectTest, ALinkToAnotherModelIsNotReplaced) {
  write(folder_ / "a" / "floor.obj", floorOf("none.mtl"));
  write(folder_ / "b" / "floor.obj", floorOf("none.mtl") + "v 9 9 9\n");
  EXPECT_EQ(collect(folder_ / "a" / "floor.obj", Collect::link)->scene, "models/floor/floor.obj");
  EXPECT_EQ(collect(folder_ / "b" / "floor.obj", Collect::link)->scene, "models/floor-2/floor.obj");
  EXPECT_EQ(collect(folder_ / "b" / "floor.obj")->scene, "models/floor-2/floor.obj");
  EXPECT_TRUE(fs::is_symlink(folder_ / "walk" / "models" / "floor" / "floor.obj"));
}

/// Else a model could have any file of the disk put into a folder that is then given away.
TEST_F(CollectTest, FilesFarAwayAndHiddenOnesAreToldAndLeft) {
  write(folder_ / "private" / "deep" / "red.mtl", kRed);
  write(folder_ / "made" / ".keys" / "red.mtl", kRed);
  const fs::path model = folder_ / "made" / "here" / "floor.obj";
  write(model, floorOf("none.mtl"));
  const auto collected =
      collectModel(model, project_(),
                   {model, folder_ / "private" / "deep" / "red.mtl", folder_ / "made" / ".keys" / "red.mtl"},
                   Collect::files);
  ASSERT_TRUE(collected) << collected.error().describe();
  EXPECT_EQ(collected->files, 1U);
  EXPECT_EQ(collected->left.size(), 2U);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "walk"))
    EXPECT_NE(entry.path().filename(), "red.mtl");
}

TEST_F(CollectTest, WhatCannotBeBroughtLeavesNothing) {
  const auto gone = collect(folder_ / "made" / "gone.obj");
  ASSERT_FALSE(gone);
  EXPECT_THAT(gone.error().describe(), HasSubstr("gone.obj"));
  write(folder_ / "made" / "broken.glb", "no model");
  EXPECT_FALSE(collect(folder_ / "made" / "broken.glb"));
  EXPECT_TRUE(fs::is_empty(folder_ / "walk"));
  write(folder_ / "walk" / "models", "a file where the folder would be");
  write(folder_ / "made" / "floor.obj", floorOf("none.mtl"));
  const auto blocked = collect(folder_ / "made" / "floor.obj");
  ASSERT_FALSE(blocked);
  EXPECT_THAT(blocked.error().describe(), HasSubstr("models"));
  EXPECT_EQ(*readText(folder_ / "walk" / "models"), "a file where the folder would be");
}

TEST_F(CollectTest, AProjectOfAnOlderProgramIsRefusedAndCollected) {
  write(folder_ / "made" / "floor.obj", floorOf("red.mtl"));
  write(folder_ / "made" / "red.mtl", kRed);
  writeProject("../made/floor.obj");
  const auto refused = loadProject(project_());
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().describe(), HasSubstr("walk.acentric.json"));
  EXPECT_THAT(refused.error().describe(), HasSubstr("/scene: ../made/floor.obj leaves the project's folder"));
  EXPECT_THAT(refused.error().describe(), HasSubstr("acentric collect"));
  EXPECT_EQ(sceneOutside(project_()), fs::path("../made/floor.obj"));

  const auto collected = collectProject(project_(), Collect::files, host_);
  ASSERT_TRUE(collected) << collected.error().describe();
  EXPECT_EQ(collected->files, 2U);
  const auto project = loadProject(project_());
  ASSERT_TRUE(project) << project.error().describe();
  EXPECT_EQ(project->scene, "models/floor/floor.obj");
  EXPECT_EQ(project->exposure, 0.7F) << "all else is as it was";
  EXPECT_EQ(sceneOutside(project_()), std::nullopt);
  const auto again = collectProject(project_(), Collect::files, host_);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->folder.empty());
}

TEST_F(CollectTest, AWayOutAndBackInIsOnlyWrittenAnew) {
  write(folder_ / "walk" / "floor.obj", floorOf("none.mtl"));
  writeProject("../walk/floor.obj");
  EXPECT_FALSE(loadProject(project_()));
  ASSERT_TRUE(collectProject(project_(), Collect::files, host_));
  EXPECT_EQ(loadProject(project_())->scene, "floor.obj");
  EXPECT_FALSE(fs::exists(folder_ / "walk" / "models"));
}

TEST_F(CollectTest, WhatIsWrongElsewhereInAProjectIsToldAndNothingIsWritten) {
  write(folder_ / "made" / "floor.obj", floorOf("none.mtl"));
  writeProject("../made/floor.obj");
  std::string text = *readText(project_());
  text.replace(text.find("\"exposure\": "), 12, "\"exposure\": -");
  write(project_(), text);
  const auto refused = collectProject(project_(), Collect::files, host_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().describe(), HasSubstr("/view/exposure"));
  EXPECT_EQ(*readText(project_()), text);
  EXPECT_FALSE(fs::exists(folder_ / "walk" / "models"));
  write(project_(), "{ half a fi");
  EXPECT_FALSE(collectProject(project_(), Collect::files, host_));
  EXPECT_EQ(sceneOutside(project_()), std::nullopt);
}

}  // namespace
}  // namespace acentric
