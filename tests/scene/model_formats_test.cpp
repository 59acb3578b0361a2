/// Formats that go through assimp, from files written here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/effect_plan.h"
#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

class ModelFormats : public testing::Test {
 protected:
  Scene parsed(const std::string& name, const std::string& text, const ImportOptions& options = {}) {
    EXPECT_TRUE(writeTextAtomically(folder.path() / name, text));
    auto scene = parseScene(folder.path() / name, options);
    if (!scene) {
      ADD_FAILURE() << scene.error().describe();
      return {};
    }
    expectSound(*scene);
    return std::move(*scene);
  }

  TemporaryFolder folder{"model_formats"};
};

const char* const kTriangleObj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n";

TEST_F(ModelFormats, ObjMaterialsBecomeOurs) {
  ASSERT_TRUE(writeColourImage(ColourImage(2, 2, {255, 0, 0, 255}), folder.path() / "maps" / "Red.png"));
  ASSERT_TRUE(writeTextAtomically(folder.path() / "m.mtl",
                                  "newmtl paint\nKd 0.5 0.25 1\nKe 2 0 0\nd 0.4\nmap_Kd maps\\red.PNG\n"));
  const Scene scene = parsed("model.obj", kTriangleObj);
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "paint");
  EXPECT_LT(glm::distance(m.baseColour, glm::vec4(0.5f, 0.25f, 1, 0.4f)), 1e-6f);
  EXPECT_EQ(m.alphaMode, AlphaMode::blend);
  EXPECT_EQ(m.emissive, glm::vec3(2, 0, 0));
  EXPECT_EQ(m.metallic, 0);
  EXPECT_TRUE(m.baseColourTexture.used());
  // v runs down: OBJ's (0, 0), the lower left, is (0, 1).
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh.positions[i] == glm::vec3(0)) {
      EXPECT_EQ(mesh.uv[0][i], glm::vec2(0, 1));
    }
  EXPECT_EQ(scene.bounds.max, glm::vec3(1, 0, 1));
}

TEST_F(ModelFormats, AMissingTextureIsReportedAndTheColourStays) {
  ASSERT_TRUE(
      writeTextAtomically(folder.path() / "m.mtl", "newmtl paint\nKd 0.5 0.25 1\nmap_Kd nowhere.png\n"));
  const Scene scene = parsed("model.obj", kTriangleObj);
  EXPECT_FALSE(scene.materials[0].baseColourTexture.used());
  EXPECT_TRUE(mentions(scene.report.ignored, "nowhere.png: does not exist"));
  EXPECT_FALSE(planEffects(scene).on(Effect::textures));
}

TEST_F(ModelFormats, AbsurdSizesAreTakenAsCentimetresOrMillimetres) {
  const auto boxOf = [](int size) { return fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nf 1 2 3\n", size); };
  EXPECT_NEAR(parsed("metres.obj", boxOf(100)).bounds.size().x, 100, 1e-4);
  const Scene centimetres = parsed("centimetres.obj", boxOf(3000));
  EXPECT_NEAR(centimetres.bounds.size().x, 30, 1e-4);
  EXPECT_TRUE(mentions(centimetres.report.guessed, "unit: centimetres"));
  EXPECT_NEAR(parsed("millimetres.obj", boxOf(60000)).bounds.size().x, 60, 1e-4);
  EXPECT_NEAR(parsed("told.obj", boxOf(3000), {0.125, UpAxis::guess, true}).bounds.size().x, 375, 1e-3);
}

TEST_F(ModelFormats, AUnitThatTheCommentsOfAnObjFileStateIsTaken) {
  const std::string box = "v 0 0 0\nv 3000 0 0\nv 0 3000 0\nf 1 2 3\n";
  const Scene level = parsed("level.obj", "# obj file of Cube 2 level\n\n" + box);
  EXPECT_NEAR(level.bounds.size().x, 375, 1e-3);
  EXPECT_TRUE(mentions(level.report.guessed, "8 units to the metre"));
  const Scene inches = parsed("inches.obj", "# Exported from SketchUp\n# File units = inches\n" + box);
  EXPECT_NEAR(inches.bounds.size().x, 76.2, 1e-3);
  EXPECT_TRUE(mentions(inches.report.guessed, "unit: 0.0254 m (the file's comments)"));
  EXPECT_NEAR(parsed("told.obj", "# File units = inches\n" + box, {2, UpAxis::guess, true}).bounds.size().x,
              6000, 1e-2);
  EXPECT_NEAR(parsed("odd.obj", "# File units = parsecs\n" + box).bounds.size().x, 30, 1e-4);
}

/// A house of two storeys, 12 x 9 m and 6 m high, as a box with a floor between; `up` is 1 for Y, 2 for Z.
std::string houseObj(int up) {
  std::string text;
  for (const double height : {0.0, 3.0, 6.0})
    for (const auto& [along, across] : {std::pair{0, 0}, {12, 0}, {12, 9}, {0, 9}})
      text += up == 2 ? fmt::format("v {} {} {}\n", along, across, height)
                      : fmt::format("v {} {} {}\n", along, height, -across);
  for (const char* floor : {"f 1 2 3 4\n", "f 5 6 7 8\n", "f 9 10 11 12\n"}) text += floor;
  for (int side = 1; side <= 4; ++side)
    text += fmt::format("f {} {} {} {}\n", side, side % 4 + 1, side % 4 + 9, side + 8);
  return text;
}

TEST_F(ModelFormats, TheUpAxisIsTheOneThatLevelSurfacesFace) {
  const Scene zUp = parsed("z.obj", houseObj(2));
  EXPECT_TRUE(mentions(zUp.report.guessed, "up axis: Z (the file states none; 2.2 times as much"));
  EXPECT_LT(glm::distance(zUp.bounds.size(), glm::vec3(12, 9, 6)), 1e-4f);
  const Scene yUp = parsed("y.obj", houseObj(1));
  EXPECT_TRUE(mentions(yUp.report.guessed, "up axis: Y (the file states none)"));
  EXPECT_LT(glm::distance(yUp.bounds.size(), glm::vec3(12, 9, 6)), 1e-4f);
  EXPECT_LT(
      glm::distance(parsed("told.obj", houseObj(2), {0, UpAxis::y, true}).bounds.size(), glm::vec3(12, 6, 9)),
      1e-4f);
}

TEST_F(ModelFormats, StlAndPlyAndOffAreRead) {
  const Scene stl = parsed("a.stl",
                           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                           "0\nendloop\nendfacet\nendsolid a\n");
  EXPECT_EQ(stl.triangleCount(), 1u);
  const Scene ply =
      parsed("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
             "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 "
             "0\n0 1 0 255 0 128\n4 0 1 2 3\n");
  EXPECT_EQ(ply.triangleCount(), 2u);
  EXPECT_TRUE(planEffects(ply).on(Effect::vertexColours));
  EXPECT_TRUE(mentions(ply.report.guessed, "vertex colours: taken as sRGB"));
  const Scene off = parsed("a.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(off.triangleCount(), 1u);
}

std::string collada(const std::string& head) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         head +
         R"(</asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 0 100</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(ModelFormats, ColladaStatesItsUnitAndUpAxis) {
  const Scene zUp =
      parsed("z.dae", collada(R"(<unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis>)"));
  EXPECT_LT(glm::distance(zUp.bounds.max, glm::vec3(1, 0, 1)), 1e-5f);
  EXPECT_TRUE(mentions(zUp.report.guessed, "unit: 0.01 m (COLLADA)"));
  const Scene yUp = parsed("y.dae", collada("<up_axis>Y_UP</up_axis>"));
  EXPECT_LT(glm::distance(yUp.bounds.min, glm::vec3(0, -100, 0)), 1e-3f);
  const Scene told =
      parsed("told.dae", collada(R"(<unit meter="0.01"/><up_axis>Z_UP</up_axis>)"), {2, UpAxis::y, true});
  EXPECT_LT(glm::distance(told.bounds.min, glm::vec3(0, -200, 0)), 1e-3f);
}

TEST_F(ModelFormats, WhatIsNoModelIsRefusedWithAReason) {
  ASSERT_TRUE(writeTextAtomically(folder.path() / "notes.txt", "hello"));
  const auto refusalOf = [&](const char* name) {
    const auto scene = parseScene(folder.path() / name, {});
    EXPECT_FALSE(scene);
    return scene ? "" : scene.error().message;
  };
  EXPECT_THAT(refusalOf("notes.txt"), testing::HasSubstr("not a model format"));
  EXPECT_EQ(refusalOf("absent.obj"), "does not exist");
  EXPECT_THAT(refusalOf("."), testing::HasSubstr("is a folder"));
}

}  // namespace
}  // namespace acentric::test
