/// Pictures for other programs, and their cameras read back.

#include "engine/pipeline/export_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/pipeline/camera_path.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class ExportImages : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::SceneBuilder builder;
    builder.box(builder.material(test::matte({0.8F, 0.3F, 0.2F})), {-4, -3, 0}, {4, 3, 2.5F}, true)
        .point({0, 0, 2.2F}, 50);
    open_ = test::openWith(builder.rays(), test::smallProject(0.5, 2), folder_ / "room.acentric.json");
  }
  ExportImagesReport write(ImageSetFormat format) {
    TaskRunner runner(1);
    ExportImagesOptions options;
    options.format = format;
    options.facePixels = 32;
    options.onlyRegion = 0;
    options.mostPoints = 600;
    const auto done = exportImages(open_, folder_ / "set", options, runner);
    EXPECT_TRUE(done) << (done ? "" : done.error().describe());
    return done ? *done : ExportImagesReport{};
  }
  glm::dvec3 eye() const { return {open_.layout->regions[0].polygon.centroid(), open_.layout->eyeZ()}; }
  void expectFaces(const CameraPath& path) const {
    ASSERT_EQ(path.poses.size(), 6U);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(glm::distance(path.poses[k].eye, eye()), 1e-6);
      EXPECT_NEAR(path.poses[k].pitchRadians, k < 4 ? 0 : k == 4 ? kPi / 2 : -kPi / 2, 1e-6);
      if (k >= 4) continue;
      EXPECT_NEAR(std::remainder(path.poses[k].yawRadians - double(k) * kPi / 2, kTwoPi), 0, 1e-6);
    }
  }

  OpenProject open_;
};

TEST_F(ExportImages, NerfstudioHasPosesPicturesDistancesAndPoints) {
  const ExportImagesReport report = write(ImageSetFormat::nerfstudio);
  EXPECT_EQ(report.images, 6U);
  EXPECT_GT(report.points, 400U);
  const auto json = nlohmann::json::parse(readText(folder_ / "set" / "transforms.json").value());
  EXPECT_NEAR(json.at("fl_x").get<double>(), 16, 1e-9) << "90 degrees over 32 pixels";
  for (const auto& frame : json.at("frames"))
    for (const char* file : {"file_path", "depth_file_path"})
      EXPECT_TRUE(std::filesystem::exists(folder_ / "set" / frame.at(file).get<std::string>()));
  const auto path = loadPath(folder_ / "set" / "transforms.json");
  ASSERT_TRUE(path) << path.error().describe();
  expectFaces(*path);
  // The first face looks along +x at a wall: all of it lies at one distance along the axis.
  const auto depth = readColourImage(folder_ / "set" / "depth" / "00000.png");
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->width, 32);
}

TEST_F(ExportImages, ColmapsFilesAreReadBack) {
  write(ImageSetFormat::colmap);
  const auto path = loadPath(folder_ / "set" / "sparse" / "0" / "images.txt");
  ASSERT_TRUE(path) << path.error().describe();
  expectFaces(*path);
  EXPECT_THAT(readText(folder_ / "set" / "sparse" / "0" / "cameras.txt").value(),
              testing::HasSubstr("1 PINHOLE 32 32 16"));
  // Points lie on the room's surfaces.
  std::istringstream lines(readText(folder_ / "set" / "sparse" / "0" / "points3D.txt").value());
  int points = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    int id = 0;
    glm::dvec3 p(0);
    words >> id >> p.x >> p.y >> p.z;
    const double off = std::min(
        {std::abs(std::abs(p.x) - 4), std::abs(std::abs(p.y) - 3), std::abs(p.z), std::abs(p.z - 2.5)});
    EXPECT_LT(off, 1e-4) << line;
    ++points;
  }
  EXPECT_GT(points, 400);
}

TEST_F(ExportImages, SeuratsManifestHasAGroupOfSixFaces) {
  write(ImageSetFormat::seurat);
  const auto json = nlohmann::json::parse(readText(folder_ / "set" / "manifest.json").value());
  ASSERT_EQ(json.at("view_groups").size(), 1U);
  const auto& views = json.at("view_groups")[0].at("views");
  ASSERT_EQ(views.size(), 6U);
  for (const auto& view : views) {
    EXPECT_EQ(view.at("projective_camera").at("depth_type"), "EYE_Z");
    EXPECT_EQ(view.at("projective_camera").at("world_from_eye_matrix").size(), 16U);
    EXPECT_NEAR(view.at("projective_camera").at("clip_from_eye_matrix")[0].get<double>(), 1, 1e-9);
    EXPECT_TRUE(std::filesystem::exists(
        folder_ / "set" / view.at("depth_image_file").at("depth").at("path").get<std::string>()));
  }
}

TEST_F(ExportImages, PanoramasAreListedWithTheirPlaces) {
  EXPECT_EQ(write(ImageSetFormat::panoramas).images, 1U);
  const auto json = nlohmann::json::parse(readText(folder_ / "set" / "panoramas.json").value());
  ASSERT_EQ(json.at("panoramas").size(), 1U);
  const auto& only = json.at("panoramas")[0];
  EXPECT_EQ(only.at("region"), 0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(only.at("position")[std::size_t(axis)].get<double>(), eye()[axis], 1e-9);
  const auto picture = readColourImage(folder_ / "set" / only.at("file").get<std::string>());
  ASSERT_TRUE(picture) << picture.error().describe();
  EXPECT_EQ(picture->width, 4 * 32);
  EXPECT_EQ(picture->height, 2 * 32);
}

TEST_F(ExportImages, RefusesFoldersInUseAndPosesThatAreNone) {
  write(ImageSetFormat::seurat);
  TaskRunner runner(1);
  EXPECT_FALSE(exportImages(open_, folder_ / "set", {}, runner));
  for (const char* text :
       {R"({"frames": [{"transform_matrix": [[1, 2], 3]}]})",
        R"({"frames": [{"transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,0,"a"],[0,0,0,1]]}]})"}) {
    ASSERT_TRUE(writeTextAtomically(folder_ / "poses.json", text));
    const auto refused = loadPath(folder_ / "poses.json");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("/frames/0/transform_matrix"));
  }
  ASSERT_TRUE(writeTextAtomically(folder_ / "images.txt", "1 1 0 0\n"));
  EXPECT_THAT(loadPath(folder_ / "images.txt").error().message, testing::HasSubstr("line 1"));
}

}  // namespace
}  // namespace acentric
