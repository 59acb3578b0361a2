/// Instances: what is in a file many times is in memory once, and stands where it stood.

#include "engine/scene/instances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include "engine/scene/placed_mesh.h"
#include "engine/scene/triangle_normal.h"
#include "engine/scene/up_axis_guess.h"
#include "scene_fixtures.h"

namespace acentric {
namespace {

using test::GltfBuilder;
using test::TemporaryFolder;

ImportOptions allInstances() {
  ImportOptions options;
  options.flatTriangles = 0;
  return options;
}

/// A crooked pyramid with normals and tangents, in a frame of its own.
Mesh pyramid() {
  Mesh mesh;
  mesh.name = "pyramid";
  mesh.positions = {{0, 0, 0}, {1, 0, 0.1f}, {0.3f, 1.2f, 0}, {0.4f, 0.3f, 2}};
  for (const glm::vec3& p : mesh.positions) {
    mesh.normals.push_back(glm::normalize(p - glm::vec3(0.4f, 0.3f, 0.3f)));
    mesh.tangents.emplace_back(glm::normalize(glm::vec3(p.y, 1 - p.x, 0.2f)), -1);
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

Scene sceneOf(const std::vector<glm::mat4x3>& places) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.push_back(pyramid());
  scene.prototypes.push_back(pyramid());
  for (const glm::mat4x3& place : places) scene.instances.push_back({0, place});
  return scene;
}

std::vector<glm::mat4x3> crookedPlaces(std::size_t count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> random(-2, 2);
  std::vector<glm::mat4x3> places;
  while (places.size() < count) {
    glm::mat4x3 m;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) m[column][row] = random(engine) * (column == 3 ? 50.0f : 1.0f);
    if (isPlacement(m) && std::abs(glm::determinant(glm::mat3(m))) > 0.1f) places.push_back(m);
  }
  return places;
}

using Corner = std::tuple<double, double, double>;

/// All triangles where they stand, rounded, each from its least corner on: in any order of meshes.
std::vector<std::array<Corner, 3>> trianglesOf(const Scene& scene) {
  std::vector<std::array<Corner, 3>> all;
  for (std::uint32_t m = 0; m < scene.placedCount(); ++m) {
    const PlacedMesh placed(scene, m);
    for (std::uint32_t t = 0; t < placed.mesh().triangles.size(); ++t) {
      std::array<Corner, 3> triangle;
      const auto corners = placed.corners(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto rounded = [](float v) { return std::round(double(v) * 1e4) * 1e-4 + 0.0; };
        triangle[k] = {rounded(corners[k].x), rounded(corners[k].y), rounded(corners[k].z)};
      }
      if (placed.mirrored()) std::swap(triangle[1], triangle[2]);
      std::ranges::rotate(triangle, std::ranges::min_element(triangle));
      all.push_back(triangle);
    }
  }
  std::ranges::sort(all);
  return all;
}

/// Three nodes with one mesh of two triangles, one of them mirrored, and one with `count` instances of it.
GltfBuilder manyNodes() {
  GltfBuilder gltf;
  gltf.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", gltf.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f})}}},
          {"indices", gltf.indices({0, 1, 2, 1, 3, 2})}}}}}};
  gltf.json["nodes"] = {{{"mesh", 0}, {"name", "first"}},
                        {{"mesh", 0}, {"translation", {5, 0, 0}}},
                        {{"mesh", 0}, {"scale", {-2, 1, 1}}, {"translation", {0, 7, 0}}},
                        {{"mesh", 0}, {"translation", {0, 0, 20}}}};
  gltf.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf.vec3({0, 0, 0, 1, 2, 3, -4, 0, 0})},
      {"ROTATION", gltf.vec4({0, 0, 0, 1, 0, 0.6f, 0, 0.8f, 0, 0, 1, 0})},
      {"SCALE", gltf.vec3({1, 1, 1, 2, 2, 2, 1, -3, 0.5f})}};
  gltf.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  return gltf;
}

TEST(Instances, HaveTheCornersThatTheyWouldAsMeshesToTheLastBit) {
  const Scene scene = sceneOf(crookedPlaces(40)), flat = flattened(scene);
  ASSERT_EQ(flat.meshes.size(), 41u);
  ASSERT_TRUE(flat.instances.empty() && flat.prototypes.empty());
  int mirrored = 0;
  for (std::uint32_t m = 0; m < scene.placedCount(); ++m) {
    const PlacedMesh placed(scene, m);
    const Mesh& mesh = flat.meshes[m];
    mirrored += placed.mirrored() ? 1 : 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      EXPECT_EQ(placed.position(v), mesh.positions[v]);
      EXPECT_EQ(placed.normal(v), mesh.normals[v]);
      EXPECT_EQ(placed.tangent(v), mesh.tangents[v]);
      EXPECT_NEAR(glm::length(mesh.normals[v]), 1, 1e-6);
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      EXPECT_LT(glm::distance(triangleNormal(placed, t), triangleNormal(mesh, t)), 3e-5f);
      const glm::vec3 turned(glm::normalize(placed.turned(glm::dvec3(triangleNormal(placed.mesh(), t)))));
      EXPECT_LT(glm::distance(turned, triangleNormal(mesh, t)), 1e-4f);
    }
  }
  EXPECT_GT(mirrored, 5);
  EXPECT_LT(mirrored, 35);
}

TEST(Instances, AreWithinTheirBoxesAndTheScenesBoundsAreThoseOfItsTriangles) {
  const Scene scene = sceneOf(crookedPlaces(200)), flat = flattened(scene);
  const Bounds all = boundsOf(scene), expected = boundsOf(flat);
  EXPECT_EQ(all.min, expected.min);
  EXPECT_EQ(all.max, expected.max);
  const Bounds own = boundsOf(scene.prototypes)[0];
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Bounds box = boundsOf(scene.instances[i], own);
    for (const glm::vec3& p : flat.meshes[i + 1].positions)
      EXPECT_TRUE(glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max)));
  }
}

TEST(Instances, SomeCanBePlacedAsMeshesAndTheRestStays) {
  const Scene scene = sceneOf(crookedPlaces(10));
  const std::vector<std::uint32_t> some{1, 4, 9};
  const Scene placed = withPlaced(scene, some);
  EXPECT_EQ(placed.meshes.size(), 4u);
  EXPECT_EQ(placed.instances.size(), 7u);
  EXPECT_EQ(placed.shownTriangleCount(), scene.shownTriangleCount());
  EXPECT_EQ(trianglesOf(placed), trianglesOf(scene));
  EXPECT_TRUE(withPlaced(scene, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}).prototypes.empty());
}

TEST(Instances, OfGltfNodesAndOfItsExtensionAreOnePrototype) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  const auto shared = gltf.parse(folder, allInstances()), flat = gltf.parse(folder);
  ASSERT_TRUE(shared) << shared.error().describe();
  ASSERT_TRUE(flat) << flat.error().describe();
  EXPECT_TRUE(shared->meshes.empty());
  ASSERT_EQ(shared->prototypes.size(), 1u);
  EXPECT_EQ(shared->instances.size(), 6u);
  EXPECT_EQ(shared->shownTriangleCount(), 12u);
  EXPECT_EQ(shared->uniqueTriangleCount(), 2u);
  EXPECT_EQ(flat->meshes.size(), 6u);
  EXPECT_EQ(flat->triangleCount(), 12u);
  EXPECT_EQ(flat->meshes[0].name, "first");
  EXPECT_EQ(trianglesOf(*shared), trianglesOf(*flat));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(shared->bounds.min[axis], flat->bounds.min[axis], 1e-5);
    EXPECT_NEAR(shared->bounds.max[axis], flat->bounds.max[axis], 1e-5);
  }
  EXPECT_EQ(shared->report.found[0], "12 triangles (2 unique), in 0 meshes and 6 instances of 1 shared mesh");
}

TEST(Instances, AreKeptOnlyAboveTheNumberOfTrianglesThatMayBeFlatAndTheLargestFirst) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  gltf.json["meshes"].push_back(
      {{"primitives", {{{"attributes", {{"POSITION", gltf.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}}}});
  for (int n = 0; n < 3; ++n) {
    gltf.json["nodes"].push_back({{"mesh", 1}, {"translation", {0, n, -9}}});
    gltf.json["scenes"][0]["nodes"].push_back(4 + n);
  }
  ImportOptions options;
  options.flatTriangles = 15;
  EXPECT_EQ(gltf.parse(folder, options)->meshes.size(), 9u);
  options.flatTriangles = 14;
  const auto some = gltf.parse(folder, options);
  ASSERT_TRUE(some) << some.error().describe();
  EXPECT_EQ(some->meshes.size(), 3u);
  EXPECT_EQ(some->instances.size(), 6u);
  options.flatTriangles = 2;
  EXPECT_EQ(gltf.parse(folder, options)->instances.size(), 9u);
}

TEST(Instances, OfMirrorsAndLampsArePlacedWhereTheyAreNotFarTooMany) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  gltf.json["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
  gltf.primitive()["material"] = 0;
  ImportOptions options;
  options.flatTriangles = 3;
  const auto placed = gltf.parse(folder, options);
  ASSERT_TRUE(placed) << placed.error().describe();
  EXPECT_EQ(placed->meshes.size(), 6u);
  options.flatTriangles = 2;
  const auto kept = gltf.parse(folder, options);
  EXPECT_EQ(kept->instances.size(), 6u);
  ASSERT_EQ(kept->report.ignored.size(), 1u);
  EXPECT_NE(kept->report.ignored[0].find("lamps"), std::string::npos);
}

TEST(Instances, ThatAreFlatBecomeMeshesAndThoseThatAreNothingAreSaid) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  gltf.json["nodes"][1]["scale"] = {1, 1, 0};  // flat in the direction that it is nearly flat in
  gltf.json["nodes"][2]["scale"] = {0, 0, 0};
  const auto scene = gltf.parse(folder, allInstances()), flat = gltf.parse(folder);
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->meshes.size(), 1u);
  EXPECT_EQ(scene->instances.size(), 4u);
  EXPECT_EQ(trianglesOf(*scene), trianglesOf(*flat));
  ASSERT_FALSE(scene->report.ignored.empty());
  EXPECT_NE(scene->report.ignored[0].find("shrunk to nothing"), std::string::npos);
}

TEST(Instances, GiveTheSameSceneInAnyOrderAndAnotherKeyWhereOneMoved) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  const ContentKey key = gltf.parse(folder, allInstances())->key;
  gltf.json["scenes"][0]["nodes"] = {3, 1, 0, 2};
  EXPECT_EQ(gltf.parse(folder, allInstances())->key, key);
  gltf.json["nodes"][1]["translation"] = {5, 0, 0.01};
  const auto moved = gltf.parse(folder, allInstances());
  EXPECT_NE(moved->key, key);
  EXPECT_EQ(moved->parts.materials, gltf.parse(folder, allInstances())->parts.materials);
}

TEST(Instances, FarFromTheirOwnMiddlesKeepTheirDetail) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf;
  gltf.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", gltf.vec3({5e6f, 0, 0, 5e6f + 0.5f, 0, 0, 5e6f, 0.125f, 0})}}}}}}}};
  gltf.json["nodes"] = {{{"mesh", 0}, {"translation", {-5e6, 0, 0}}},
                        {{"mesh", 0}, {"translation", {-5e6, 0, 3}}}};
  gltf.json["scenes"][0]["nodes"] = {0, 1};
  const auto shared = gltf.parse(folder, allInstances()), flat = gltf.parse(folder);
  ASSERT_TRUE(shared) << shared.error().describe();
  ASSERT_EQ(shared->instances.size(), 2u);
  EXPECT_EQ(trianglesOf(*shared), trianglesOf(*flat));
}

TEST(Instances, SurviveTheSceneFileAndBrokenOnesAreRefused) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  const auto scene = gltf.parse(folder, allInstances());
  const auto file = folder.path() / "scene.acscene";
  ASSERT_TRUE(writeSceneFile(*scene, file));
  const auto read = readSceneFile(file);
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(trianglesOf(*read), trianglesOf(*scene));
  EXPECT_EQ(keyOf(*read), scene->key);
  const auto isRefused = [&](const std::function<void(Scene&)>& harm) {
    Scene broken = *scene;
    harm(broken);
    EXPECT_TRUE(writeSceneFile(broken, file));
    return !readSceneFile(file);
  };
  EXPECT_TRUE(isRefused([](Scene& s) { s.instances[2].prototype = 1; }));
  EXPECT_TRUE(isRefused([](Scene& s) { s.instances[2].worldFromPrototype[1] = glm::vec3(0); }));
  EXPECT_TRUE(isRefused([](Scene& s) { s.instances[2].worldFromPrototype[3].x = NAN; }));
  EXPECT_TRUE(isRefused([](Scene& s) { s.prototypes[0].triangles[1].y = 99; }));
  EXPECT_TRUE(isRefused([](Scene& s) { s.prototypes[0].material = 5; }));
}

TEST(Instances, MoreThanThereCanBeAreRefusedBeforeTheyAreRead) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  const auto accessor = gltf.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"]
                            .get<std::size_t>();
  gltf.json["accessors"][accessor].erase("bufferView");  // zeros, as many as it says
  gltf.json["accessors"][accessor]["count"] = 60'000'000;
  gltf.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"SCALE", accessor}};
  const auto scene = gltf.parse(folder, allInstances());
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::tooLarge);
  EXPECT_NE(scene.error().message.find("60000000 instances"), std::string::npos) << scene.error().message;
  gltf.json["accessors"][accessor]["count"] = 7;  // others have three
  gltf.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  EXPECT_FALSE(gltf.parse(folder, allInstances()));
}

TEST(Instances, OfABentMeshAreReadOneByOne) {
  const TemporaryFolder folder("instances");
  GltfBuilder gltf = manyNodes();
  gltf.primitive()["targets"] = {{{"POSITION", gltf.vec3({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2})}}};
  gltf.json["meshes"][0]["weights"] = {0};
  gltf.json["nodes"][1]["weights"] = {1};
  const auto scene = gltf.parse(folder, allInstances()), flat = gltf.parse(folder);
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->meshes.size(), 1u) << "it alone is bent otherwise";
  EXPECT_EQ(scene->instances.size(), 5u);
  EXPECT_EQ(trianglesOf(*scene), trianglesOf(*flat));
}

TEST(Instances, OfOtherFormatsAreOnePrototypeToo) {
  const TemporaryFolder folder("instances");
  const std::string head =
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 0 100</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)";
  std::string nodes;
  for (const char* matrix : {"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "1 0 0 300 0 1 0 0 0 0 2 0 0 0 0 1",
                             "-1 0 0 0 0 1 0 500 0 0 1 0 0 0 0 1"})
    nodes += "<node id=\"n" + std::to_string(nodes.size()) + "\"><matrix>" + matrix +
             "</matrix><instance_geometry url=\"#g\"/></node>";
  const auto file = folder.path() / "three.dae";
  ASSERT_TRUE(writeTextAtomically(
      file,
      head + nodes +
          R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
  const auto shared = parseScene(file, allInstances()), flat = parseScene(file, {});
  ASSERT_TRUE(shared) << shared.error().describe();
  ASSERT_TRUE(flat) << flat.error().describe();
  EXPECT_EQ(shared->prototypes.size(), 1u);
  EXPECT_EQ(shared->instances.size(), 3u);
  EXPECT_EQ(flat->meshes.size(), 3u);
  EXPECT_EQ(trianglesOf(*shared), trianglesOf(*flat));
  EXPECT_NEAR(shared->bounds.max.x, 4, 1e-4);
}

/// Which way is up is told by surfaces where they stand, instances too.
TEST(Instances, TellWhichWayIsUp) {
  SourceScene source;
  SourceMesh& floor = source.prototypes.emplace_back();
  floor.positions = {{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}, {4, 0.5, 4}};  // level along Y as modelled
  floor.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 2, 4}};
  const auto turned = [&](double x) {  // level along Z where it stands
    source.instances.push_back(
        {0, 0, "floor", glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {x, 0, 0, 1})});
  };
  turned(0), turned(4), turned(8);
  EXPECT_TRUE(levelAlongZ(source));
  for (SourceInstance& instance : source.instances) instance.worldFromMesh = glm::dmat4(1);
  EXPECT_FALSE(levelAlongZ(source));
}

TEST(Instances, AreSampledEvenlyWhereAllAreTooMany) {
  const Scene scene = sceneOf(crookedPlaces(100));
  std::size_t all = 0, some = 0;
  double stands = 0;
  eachTriangle(scene, 1'000'000, [&](std::uint32_t, const PlacedMesh&, std::uint32_t, double weight) {
    ++all;
    EXPECT_EQ(weight, 1);
  });
  EXPECT_EQ(all, 404u);
  std::vector<int> seen(4, 0);
  eachTriangle(scene, 60, [&](std::uint32_t, const PlacedMesh& placed, std::uint32_t t, double weight) {
    if (!placed.isInstance()) return;
    ++some, ++seen[t];
    stands += weight;
  });
  EXPECT_LE(some, 60u);
  EXPECT_GE(some, 50u);
  EXPECT_NEAR(stands, 400, 7);
  for (const int count : seen) EXPECT_GT(count, 5);
}

}  // namespace
}  // namespace acentric
