#include "engine/pipeline/scene_scale.h"

#include <gtest/gtest.h>

#include "engine/scene/finish_scene.h"

namespace acentric {
namespace {

void addBox(SourceMesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
  constexpr std::uint32_t kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {3, 2, 6, 7}, {2, 0, 4, 6}, {1, 3, 7, 5}};
  for (const auto& s : kSides) {
    mesh.triangles.emplace_back(first + s[0], first + s[1], first + s[2]);
    mesh.triangles.emplace_back(first + s[0], first + s[2], first + s[3]);
  }
}

/// 2,192 x 2,192 x 744 m by what the file declares; its storeys are 20 m high.
SourceScene city(const glm::dvec3& at = glm::dvec3(0)) {
  SourceScene source;
  source.metresPerUnit = 1;
  source.unitSource = source.upSource = "test";
  source.up = UpAxis::z;
  source.materials.emplace_back();
  SourceMesh& mesh = source.meshes.emplace_back();
  addBox(mesh, at + glm::dvec3(0, 0, -4), at + glm::dvec3(2192, 2192, 0));
  for (int tower = 0; tower < 9; ++tower)
    for (int storey = 1; storey <= 37; ++storey) {
      const glm::dvec3 corner(100 + 700 * (tower % 3), 100 + 700 * (tower / 3), 20 * storey);
      addBox(mesh, at + corner - glm::dvec3(0, 0, 1), at + corner + glm::dvec3(560, 560, 0));
    }
  return source;
}

RayScenePtr traceable(SourceScene source, const ImportOptions& options = {}) {
  auto scene = finishScene(std::move(source), "city", options, {});
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().describe());
  auto shared = std::make_shared<const Scene>(std::move(*scene));
  return *RayScene::build(shared, planEffects(*shared));
}

TEST(SceneScale, OfACityWithStoreysOfTwentyMetresIsInDoubt) {
  const RayScenePtr rays = traceable(city());
  const auto doubt = doubtScale(*rays, {});
  ASSERT_TRUE(doubt.has_value());
  EXPECT_EQ(doubt->metresPerUnit, 0.15);
  EXPECT_EQ(
      doubt->text,
      "As the model is scaled now, its storeys are 20 m high; at 0.15 metres per unit that would be 3 m");
  EXPECT_FALSE(doubtScale(*rays, {.metresPerUnit = 1}).has_value()) << "a person said so";
  EXPECT_FALSE(doubtScale(*traceable(city(), {.metresPerUnit = 0.15}), {}).has_value());
}

TEST(SceneScale, IsChangedWithAllThatStandsOnTheModel) {
  // So far away that positions are counted from near the city; at the other scale from elsewhere.
  const glm::dvec3 at(300000, -70000, 0);
  const RayScenePtr before = traceable(city(at)), after = traceable(city(at), {.metresPerUnit = 0.15});
  ASSERT_NE(before->scene().origin, glm::dvec3(0));
  ASSERT_NE(before->scene().origin, after->scene().origin);
  const auto onModel = [&](const glm::dvec3& model, const RayScenePtr& rays) {
    return rays->scene().report.metresPerUnit * (at + model) - rays->scene().origin;
  };
  Project project;
  Storey& storey = project.current();
  storey.layout.cellSize = 6;
  storey.layout.floorHeight = onModel({0, 0, 40}, before).z;
  for (const glm::dvec3& corner :
       {glm::dvec3(100, 100, 0), glm::dvec3(600, 100, 0), glm::dvec3(600, 600, 0)}) {
    if (storey.layout.outline.loops.empty()) storey.layout.outline.loops.emplace_back();
    storey.layout.outline.loops[0].push_back(glm::dvec2(onModel(corner, before)));
  }
  storey.layout.latticeOrigin = storey.spawn.position = glm::dvec2(onModel({300, 200, 0}, before));
  storey.layout.freeApvs[2] = Apv{glm::dvec2(onModel({400, 300, 0}, before)), {2, 0}};
  storey.layout.removed = {{1, 2, 0}};
  const glm::dvec3 eye = onModel({300, 200, 40}, before) + glm::dvec3(0, 0, 1.6);
  project.bookmarks = {{"door", 0, eye, 1, 0, 60}};
  project.paths = {{"way", 0, {{{eye, 0, 0, 0}}}}};

  Project whole = project;
  whole.layout().removed.clear();
  EXPECT_EQ(atScale(whole, before->scene(), 0.15).layout().cellSize, 6) << "no cell was chosen singly";

  const Project scaled = atScale(project, before->scene(), 0.15);
  const LayoutSpec& spec = scaled.layout();
  EXPECT_EQ(scaled.import.metresPerUnit, 0.15);
  EXPECT_NEAR(spec.cellSize, 0.9, 1e-9);
  EXPECT_EQ(spec.eyeHeight, storey.layout.eyeHeight) << "people keep their size";
  EXPECT_EQ(spec.removed, storey.layout.removed);
  const auto expectAt = [&](const glm::dvec2& place, const glm::dvec3& model) {
    EXPECT_LT(glm::distance(place, glm::dvec2(onModel(model, after))), 1e-6);
  };
  EXPECT_NEAR(spec.floorHeight, onModel({0, 0, 40}, after).z, 1e-6);
  expectAt(spec.outline.loops[0][1], {600, 100, 0});
  expectAt(spec.latticeOrigin, {300, 200, 0});
  expectAt(scaled.spawn().position, {300, 200, 0});
  expectAt(spec.freeApvs.at(2).centre, {400, 300, 0});
  EXPECT_NEAR(spec.freeApvs.at(2).offset.x, 0.3, 1e-9);
  const glm::dvec3 eyeAfter = onModel({300, 200, 40}, after) + glm::dvec3(0, 0, 1.6);
  EXPECT_LT(glm::distance(scaled.bookmarks[0].eye, eyeAfter), 1e-6);
  EXPECT_LT(glm::distance(scaled.paths[0].path.poses[0].eye, eyeAfter), 1e-6);
}

}  // namespace
}  // namespace acentric
