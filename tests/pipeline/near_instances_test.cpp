/// What regions draw of instances becomes meshes when a project is opened; a walk amid instances is baked,
/// drawn and kept as the walk amid the same meshes.

#include "engine/pipeline/near_instances.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "engine/measure/compare.h"
#include "engine/pipeline/pipeline.h"
#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"
#include "tests/pipeline/small_project.h"
#include "tests/scene/scene_fixtures.h"
#include "tests/support/project_folder.h"

namespace acentric {
namespace {

constexpr int kWedges = 49, kRails = 2, kRailPieces = 70, kRailRows = 2;

/// A plane and wedges on it, 7 x 7 of them 1.5 m apart, every third one mirrored, in one mesh of a glTF file
/// with instances; and two long rails, which reach from far away into the walk.
std::filesystem::path wedges(const std::filesystem::path& file, double glow = 0) {
  constexpr double apart = 1.5;
  test::GltfBuilder gltf;
  std::vector<float> places, turns, scales, rail;
  std::vector<std::uint16_t> railCorners;
  for (int k = 0; k <= kRailPieces; ++k)
    for (int row = 0; row <= kRailRows; ++row) {
      const float wave = 0.02f * float((k + row) % 4);
      for (const float v : {-7 + 14 * float(k) / kRailPieces, 0.3f + 0.1f * float(row), wave})
        rail.push_back(v);
    }
  for (int k = 0; k < kRailPieces; ++k)
    for (int row = 0; row < kRailRows; ++row)
      for (const int v : {0, kRailRows + 1, 1, 1, kRailRows + 1, kRailRows + 2})
        railCorners.push_back(std::uint16_t((kRailRows + 1) * k + row + v));
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y) {
      for (const double v : {x * apart + 0.6, 0.0, y * apart + 0.6}) places.push_back(float(v));
      const float turn = 0.3f * float(x + 2 * y);
      for (const float v : {0.0f, std::sin(turn), 0.0f, std::cos(turn)}) turns.push_back(v);
      for (const float v : {(x + y) % 3 == 0 ? -1.0f : 1.0f, 1.0f, 1.0f}) scales.push_back(v);
    }
  gltf.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.5, 0.3, 1}}, {"metallicFactor", 0}}}},
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.4, 0.5, 0.6, 1}}, {"metallicFactor", 0}}}},
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.3, 0.6, 0.3, 1}}, {"metallicFactor", 0}}},
       {"doubleSided", true}}};
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
          {"material", 1}}}}},
      {{"primitives",
        {{{"attributes", {{"POSITION", gltf.vec3(rail)}}},
          {"indices", gltf.indices(railCorners)},
          {"material", 2}}}}}};
  gltf.json["nodes"] = {{{"mesh", 0}},
                        {{"mesh", 1}},
                        {{"mesh", 2}, {"translation", {0, 0, 0.35}}, {"rotation", {0, 0.05, 0, 0.99875}}},
                        {{"mesh", 2}, {"translation", {0, 0, -0.5}}, {"scale", {1, 1.2, -1}}}};
  gltf.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf.vec3(places)}, {"ROTATION", gltf.vec4(turns)}, {"SCALE", gltf.vec3(scales)}};
  gltf.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
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

/// Triangles by instance that regions draw of the same scene without instances.
std::map<std::uint32_t, std::set<std::uint32_t>> drawnOfFlattened(const OpenProject& open) {
  std::map<std::uint32_t, std::set<std::uint32_t>> drawn;
  const auto own = std::uint32_t(open.imported->meshes.size());
  const Scene flat = flattened(*open.imported);
  for (const Region& region : open.layout->regions)
    for (const LocalTriangle& t : clipToPolygon(flat, region.grown).triangles)
      if (t.mesh >= own) drawn[t.mesh - own].insert(t.triangle);
  return drawn;
}

/// Each region draws the same triangles as of the flattened scene, and of the same places.
void expectDrawnAsFlattened(const OpenProject& open) {
  const Scene flat = flattened(*open.imported);
  const auto cornersOf = [](const LocalGeometry& local) {
    std::multiset<std::array<float, 9>> corners;
    for (const LocalTriangle& t : local.triangles) {
      std::array<float, 9> all{};
      for (int k = 0; k < 9; ++k) all[std::size_t(k)] = local.vertices[t.vertices[k / 3]].position[k % 3];
      corners.insert(all);
    }
    return corners;
  };
  for (const Region& region : open.layout->regions)
    EXPECT_EQ(cornersOf(clipToPolygon(*open.drawn, region.grown)),
              cornersOf(clipToPolygon(flat, region.grown)));
}

TEST_F(NearInstancesTest, AreDrawnAsFarAsTheyReachIntoARegion) {
  const OpenProject open = this->open("a", project(true));
  ASSERT_EQ(open.imported->instances.size(), std::size_t(kWedges + kRails));
  const auto expected = drawnOfFlattened(open);
  ASSERT_TRUE(open.near.excerpts);
  std::map<std::uint32_t, std::set<std::uint32_t>> found;
  std::uint64_t triangles = 0;
  bool partly = false;
  for (const InstanceExcerpt& excerpt : *open.near.excerpts) {
    EXPECT_TRUE(std::ranges::is_sorted(excerpt.triangles));
    found[excerpt.instance] = {excerpt.triangles.begin(), excerpt.triangles.end()};
    triangles += excerpt.triangles.size();
    const std::uint32_t prototype = open.imported->instances[excerpt.instance].prototype;
    const std::size_t all = open.imported->prototypes[prototype].triangles.size();
    partly = partly || (all == 2 * kRailRows * kRailPieces && excerpt.triangles.size() < all / 2);
  }
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(partly) << "of a long thing only what is near";
  EXPECT_GT(expected.size(), std::size_t(kRails));
  EXPECT_LT(expected.size(), 25u);
  EXPECT_EQ(open.near.triangles, triangles);
  EXPECT_EQ(open.near.instances, expected.size());
  EXPECT_TRUE(open.near.whole.empty());
  EXPECT_EQ(open.scene, open.imported) << "for rays instances stay";
  EXPECT_EQ(open.drawn->scene().meshes.size(), 1 + expected.size());
  EXPECT_EQ(open.drawn->scene().key, open.imported->key);
  expectDrawnAsFlattened(open);
}

TEST_F(NearInstancesTest, AreCountedBeyondTheLimitButNotKept) {
  const OpenProject open = this->open("a", project(true));
  const std::vector<Layout> layouts{*open.layout};
  const NearInstances all = findNearInstances(*open.imported, layouts),
                      many = findNearInstances(*open.imported, layouts, all.triangles - 1);
  EXPECT_EQ(all, open.near);
  EXPECT_TRUE(all.excerpts);
  EXPECT_FALSE(many.excerpts);
  EXPECT_EQ(many.triangles, all.triangles);
  EXPECT_EQ(many.instances, all.instances);
  EXPECT_TRUE(many.tooMany(all.triangles - 1));
}

TEST_F(NearInstancesTest, KeepSceneAndRaysUntilOthersAreNear) {
  const OpenProject first = open("a", project(true));
  Project edited = first.project;
  edited.bake.samplesPerDegree = 4;
  const auto same = reopenProject(first, edited, host_);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->scene, first.scene);
  EXPECT_EQ(same->rays, first.rays);
  EXPECT_EQ(same->drawn, first.drawn);
  edited.layout().latticeOrigin += glm::dvec2(0.01, 0);
  const auto nudged = reopenProject(first, edited, host_);
  ASSERT_TRUE(nudged);
  EXPECT_EQ(nudged->near == first.near, nudged->drawn == first.drawn);
  EXPECT_EQ(nudged->rays, first.rays);
  edited.layout().outline.loops = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  const auto wider = reopenProject(first, edited, host_);
  ASSERT_TRUE(wider);
  EXPECT_GT(wider->near.instances, first.near.instances);
  EXPECT_EQ(wider->scene, first.scene);
  EXPECT_EQ(wider->rays, first.rays);
  EXPECT_NE(wider->drawn, first.drawn);
  expectDrawnAsFlattened(*wider);
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
  ASSERT_TRUE(walk->walk.surfaceLight && same->walk.surfaceLight);
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
  ASSERT_GT(lamps.near.whole.size(), 0u);
  EXPECT_EQ(lamps.near.instances, plain.near.instances);
  EXPECT_EQ(lamps.near.excerpts->size(), std::size_t(kRails)) << "which are no lamps";
  EXPECT_EQ(lamps.scene->meshes.size(), 1 + lamps.near.whole.size());
  EXPECT_EQ(lamps.scene->instances.size() + lamps.near.whole.size(), lamps.imported->instances.size());
  expectDrawnAsFlattened(lamps);
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

TEST_F(NearInstancesTest, AreSimplifiedAsTheSameMeshesAreWhereRegionsAreAboveTheirBudget) {
  TaskRunner runner(1);
  Project some = project(true), none = project(false);
  for (Project* project : {&some, &none}) project->budget = {40, 0.5, true};
  const OpenProject instances = open("a", some), meshes = open("b", none);
  ASSERT_TRUE(bakeProject(instances, {}, runner));
  ASSERT_TRUE(bakeProject(meshes, {}, runner));
  const auto walk = loadWalk(instances, nullptr, runner), same = loadWalk(meshes, nullptr, runner);
  ASSERT_TRUE(walk && same);
  ASSERT_GT(walk->simplified.size(), 0u);
  ASSERT_EQ(walk->simplified.size(), same->simplified.size());
  for (std::size_t n = 0; n < walk->simplified.size(); ++n) {
    EXPECT_EQ(walk->simplified[n].report.before, same->simplified[n].report.before);
    EXPECT_LE(walk->simplified[n].report.after, walk->simplified[n].report.before);
  }
  EXPECT_TRUE(std::ranges::any_of(
      walk->simplified, [](const auto& region) { return region.report.after < region.report.before; }));
  const auto again = loadWalk(instances, nullptr, runner);
  ASSERT_TRUE(again);
  for (const auto& region : again->simplified) EXPECT_TRUE(region.fromStore);
}

}  // namespace
}  // namespace acentric
