/// Instances where people walk become meshes when a project is opened; a walk amid instances is baked, drawn
/// and kept as the walk amid the same meshes.

#include "engine/pipeline/near_instances.h"

#include <gtest/gtest.h>

#include "engine/measure/compare.h"
#include "engine/pipeline/pipeline.h"
#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"
#include "tests/pipeline/small_project.h"
#include "tests/scene/scene_fixtures.h"
#include "tests/support/project_folder.h"

namespace acentric {
namespace {

/// A plane and wedges on it, 7 x 7 of them 1.5 m apart, in one mesh of a glTF file with instances.
std::filesystem::path wedges(const std::filesystem::path& file, double glow = 0) {
  constexpr double apart = 1.5;
  test::GltfBuilder gltf;
  std::vector<float> places, turns;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y) {
      for (const double v : {x * apart + 0.6, 0.0, y * apart + 0.6}) places.push_back(float(v));
      const float turn = 0.3f * float(x + 2 * y);
      for (const float v : {0.0f, std::sin(turn), 0.0f, std::cos(turn)}) turns.push_back(v);
    }
  gltf.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.5, 0.3, 1}}, {"metallicFactor", 0}}}},
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.4, 0.5, 0.6, 1}}, {"metallicFactor", 0}}}}};
  gltf.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", gltf.vec3({-8, 0, 8, 8, 0, 8, 8, 0, -8, -8, 0, -8})}}},
          {"indices", gltf.indices({0, 1, 2, 0, 2, 3})},
          {"material", 0}}}}},
      {{"primitives",
        {{{"attributes",
           {{"POSITION",
             gltf.vec3({-0.2f, 0, 0.2f, 0.2f, 0, 0.2f, 0.2f, 0, -0.2f, -0.2f, 0, -0.2f, 0, 2.2f, 0})}}},
          {"indices", gltf.indices({0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4})},
          {"material", 1}}}}}};
  gltf.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 1}}};
  gltf.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf.vec3(places)}, {"ROTATION", gltf.vec4(turns)}};
  gltf.json["scenes"][0]["nodes"] = {0, 1};
  if (glow > 0) gltf.json["materials"][1]["emissiveFactor"] = {glow, glow, glow};
  return gltf.write(file);
}

class NearInstancesTest : public test::ProjectFolder {
 protected:
  void SetUp() override {
    test::ProjectFolder::SetUp();
    host_.importer = ACENTRIC_IMPORTER;
    host_.cacheFolder = folder_ / "cache";
    wedges(folder_ / "wedges.gltf");
  }
  Project project(bool instances) const {
    Project project = test::smallProject(0.5, 6);
    project.scene = "wedges.gltf";
    project.import.flatTriangles = instances ? 0 : 1000;
    project.bake.ambientRays = 8;
    project.exposure = 0.5F;
    return project;
  }
  OpenProject open(const std::string& name, const Project& project) const {
    auto open = openUnsaved(folder_ / (name + ".acentric.json"), project, host_);
    EXPECT_TRUE(open) << open.error().describe();
    return std::move(*open);
  }

  ImportHost host_;
};

TEST_F(NearInstancesTest, AreThoseThatReachIntoARegion) {
  const OpenProject open = this->open("a", project(true));
  ASSERT_EQ(open.imported->instances.size(), 49u);
  std::vector<std::uint32_t> expected;
  const Scene flat = flattened(*open.imported);
  const Bounds own = boundsOf(open.imported->prototypes)[0];
  for (std::uint32_t i = 0; i < 49; ++i) {
    const Bounds box = boundsOf(open.imported->instances[i], own);
    const glm::dvec2 low(box.min), high(box.max);
    bool near = false;
    for (const Region& region : open.layout->regions)
      near = near || overlap(region.grown, {{low, {high.x, low.y}, high, {low.x, high.y}}});
    if (near) expected.push_back(i);
  }
  EXPECT_EQ(open.near.instances, expected);
  EXPECT_GT(expected.size(), 0u);
  EXPECT_LT(expected.size(), 25u);
  EXPECT_EQ(open.near.triangles, 4 * expected.size());
  EXPECT_EQ(open.scene->meshes.size(), 1 + expected.size());
  EXPECT_EQ(open.scene->instances.size(), 49 - expected.size());
  EXPECT_EQ(open.scene->key, open.imported->key);
  // Nothing that a region draws is left among the instances.
  for (const Region& region : open.layout->regions)
    EXPECT_EQ(clipToPolygon(*open.scene, region.grown).triangles.size(),
              clipToPolygon(flat, region.grown).triangles.size());
}

TEST_F(NearInstancesTest, KeepSceneAndRaysUntilOthersAreNear) {
  const OpenProject first = open("a", project(true));
  Project edited = first.project;
  edited.bake.samplesPerDegree = 4;
  const auto same = reopenProject(first, edited, host_);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->scene, first.scene);
  EXPECT_EQ(same->rays, first.rays);
  edited.layout().latticeOrigin += glm::dvec2(0.01, 0);
  const auto nudged = reopenProject(first, edited, host_);
  ASSERT_TRUE(nudged);
  EXPECT_EQ(nudged->near == first.near, nudged->rays == first.rays);
  edited.layout().outline.loops = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  const auto wider = reopenProject(first, edited, host_);
  ASSERT_TRUE(wider);
  EXPECT_GT(wider->near.instances.size(), first.near.instances.size());
  EXPECT_NE(wider->scene, first.scene);
  EXPECT_NE(wider->surfaceLightKey, first.surfaceLightKey);
  EXPECT_EQ(wider->scene->shownTriangleCount(), first.scene->shownTriangleCount());
  const OpenProject fresh = open("b", edited);
  EXPECT_EQ(fresh.surfaceLightKey, wider->surfaceLightKey);
  EXPECT_EQ(fresh.keys, wider->keys);
}

TEST_F(NearInstancesTest, LookInAWalkAsTheSameMeshesDo) {
  TaskRunner runner(1);
  const OpenProject instances = open("a", project(true)), meshes = open("b", project(false));
  ASSERT_TRUE(meshes.imported->instances.empty());
  ASSERT_FALSE(instances.scene->instances.empty());
  const auto a = bakeProject(instances, {}, runner), b = bakeProject(meshes, {}, runner);
  ASSERT_TRUE(a) << a.error().describe();
  ASSERT_TRUE(b) << b.error().describe();
  const auto walk = loadWalk(instances, nullptr, runner), same = loadWalk(meshes, nullptr, runner);
  ASSERT_TRUE(walk) << walk.error().describe();
  ASSERT_TRUE(same) << same.error().describe();
  EXPECT_EQ(walk->missing, 0u);
  for (std::size_t r = 0; r < instances.layout->regions.size(); ++r)
    EXPECT_EQ(walk->walk.local[r]->triangles.size(), same->walk.local[r]->triangles.size());
  for (const double yaw : {0.2, 1.8, 3.3, 5.0}) {
    PerspectiveView view;
    view.eye = {instances.layout->regions[0].polygon.centroid(), instances.layout->eyeZ()};
    view.yawRadians = yaw, view.pitchRadians = -0.2;
    view.width = 200, view.height = 150;
    const auto one = renderFrame(walk->walk, view, {}, runner),
               two = renderFrame(same->walk, view, {}, runner);
    ASSERT_TRUE(one && two);
    EXPECT_GT(psnrOf(one->colour, two->colour), 45) << "yaw " << yaw;
  }
}

/// A lamp that is placed because someone walks near it lights what other cameras see.
TEST_F(NearInstancesTest, GiveTheSceneAKeyOfItsOwnWhereTheyAreLamps) {
  const OpenProject plain = open("a", project(true));
  EXPECT_EQ(plain.scene->key, plain.imported->key);
  wedges(folder_ / "wedges.gltf", 1);
  const OpenProject lamps = open("b", project(true));
  ASSERT_EQ(lamps.near, plain.near);
  EXPECT_NE(lamps.scene->key, lamps.imported->key);
  EXPECT_EQ(lamps.scene->key, keyOf(lamps.scene->parts));
  Project wider = lamps.project;
  wider.layout().outline.loops = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  const auto other = reopenProject(lamps, wider, host_);
  ASSERT_TRUE(other);
  EXPECT_NE(other->scene->key, lamps.scene->key);
}

TEST_F(NearInstancesTest, OfWhichThereAreTooManyAreSaidAndNotBakedNorDrawn) {
  OpenProject open = this->open("a", project(true));
  EXPECT_TRUE(checkNear(open.near));
  open.near.triangles = kMostNearTriangles + 1;
  const Status refused = checkNear(open.near);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::tooLarge);
  EXPECT_NE(refused.error().message.find("smaller outline"), std::string::npos);
  TaskRunner runner(0);
  const auto baked = bakeProject(open, {}, runner);
  ASSERT_FALSE(baked);
  EXPECT_EQ(baked.error().message, refused.error().message);
  EXPECT_FALSE(loadWalk(open, nullptr, runner));
}

}  // namespace
}  // namespace acentric
