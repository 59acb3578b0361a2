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

/// Nothing but a mesh.
SourceScene emptySource(double metresPerUnit) {
  SourceScene source;
  source.metresPerUnit = metresPerUnit;
  source.unitSource = source.upSource = "test";
  source.up = UpAxis::z;
  source.materials.emplace_back();
  source.meshes.emplace_back();
  return source;
}

/// Ground and `flights` straight stairs of ten steps on it, in the open; metres.
SourceScene stairs(int flights, double riser, double going, double metresPerUnit) {
  SourceScene source = emptySource(metresPerUnit);
  SourceMesh& mesh = source.meshes.front();
  addBox(mesh, {-20, -20, -0.5}, {60, 60, 0});
  for (int flight = 0; flight < flights; ++flight)
    for (int step = 0; step < 10; ++step)
      addBox(mesh, {going * step, 4.0 * flight, riser * step},
             {going * 10, 4.0 * flight + 1.4, riser * (step + 1)});
  return source;
}

/// Two rooms of 14 m height side by side, the wall between them with three doorways of 0.9 x 2.1 m.
SourceScene halls(double metresPerUnit) {
  SourceScene source = emptySource(metresPerUnit);
  SourceMesh& mesh = source.meshes.front();
  addBox(mesh, {-0.3, -0.3, -0.3}, {30.3, 24.3, 0});
  addBox(mesh, {-0.3, -0.3, 14}, {30.3, 24.3, 14.3});
  addBox(mesh, {-0.3, -0.3, 0}, {0, 24.3, 14});
  addBox(mesh, {30, -0.3, 0}, {30.3, 24.3, 14});
  addBox(mesh, {0, -0.3, 0}, {30, 0, 14});
  addBox(mesh, {0, 24, 0}, {30, 24.3, 14});
  addBox(mesh, {15, 0, 2.1}, {15.3, 24, 14});
  double from = 0;
  for (const double door : {5.0, 12.0, 19.0}) {
    addBox(mesh, {15, from, 0}, {15.3, door, 2.1});
    from = door + 0.9;
  }
  addBox(mesh, {15, from, 0}, {15.3, 24, 2.1});
  return source;
}

TEST(SceneScale, IsToldByStepsWhateverItIs) {
  for (const double unit : {1.0, 0.01, 7.0, 39.37, 1000.0}) {
    const auto built = measureScale(*traceable(stairs(2, 0.17, 0.29, unit))).built;
    EXPECT_NEAR(built.riser.metres, 0.17 * unit, 0.01 * unit) << unit;
    EXPECT_GE(built.riser.count, 12) << unit;
    EXPECT_EQ(built.riser.count, built.riser.of) << unit;
  }
}

TEST(SceneScale, OfStairsInTheOpenIsInDoubtWhereNobodyCouldClimbThem) {
  const auto doubt = doubtScale(*traceable(stairs(2, 0.17, 0.29, 7)), {});
  ASSERT_TRUE(doubt.has_value());
  EXPECT_NEAR(doubt->factor, 1 / 7.0, 0.01);
  EXPECT_NE(doubt->text.find("its steps are 1.2 m high"), std::string::npos) << doubt->text;
  EXPECT_TRUE(doubtScale(*traceable(stairs(2, 0.17, 0.29, 0.1)), {}).has_value()) << "a staircase for mice";
  EXPECT_FALSE(doubtScale(*traceable(stairs(2, 0.17, 0.29, 1)), {}).has_value());
  EXPECT_FALSE(doubtScale(*traceable(stairs(2, 0.45, 0.8, 1)), {}).has_value()) << "a stand's rows";
  EXPECT_FALSE(doubtScale(*traceable(stairs(2, 1, 1, 1)), {}).has_value()) << "terraces of blocks";
}

TEST(SceneScale, OfHallsIsToldByTheirDoorways) {
  const auto built = measureScale(*traceable(halls(1))).built;
  EXPECT_EQ(built.doorHeight.count, 3);
  EXPECT_NEAR(built.doorHeight.metres, 2.1, 1e-3);
  EXPECT_NEAR(built.doorWidth, 0.9, 1e-3);
  EXPECT_FALSE(doubtScale(*traceable(halls(1)), {}).has_value());
  EXPECT_FALSE(doubtScale(*traceable(halls(1.5)), {}).has_value());
  const auto doubt = doubtScale(*traceable(halls(39.37)), {});
  ASSERT_TRUE(doubt.has_value());
  EXPECT_EQ(doubt->metresPerUnit, 1) << doubt->text;
  EXPECT_NE(doubt->text.find("its doorways are 83 m high"), std::string::npos) << doubt->text;
}

TEST(SceneScale, OfHallsIsNotQuestionedWhereItsStepsSuitPeople) {
  // Storeys of 20 m, with stairs of 0.17 m risers on the ground: built so large on purpose.
  SourceScene source = city();
  for (int step = 0; step < 20; ++step)
    addBox(source.meshes.front(), {20 + 0.29 * step, 20, 0.17 * step}, {40, 40, 0.17 * (step + 1)});
  EXPECT_FALSE(doubtScale(*traceable(std::move(source)), {}).has_value());
}

TEST(SceneScale, OfACityNamesItsStepsAndItsStoreysWhereBothAreTooHigh) {
  SourceScene source = city();
  for (int step = 0; step < 20; ++step)
    addBox(source.meshes.front(), {20 + 2 * step, 20, 1.2 * step}, {90, 60, 1.2 * (step + 1)});
  const auto doubt = doubtScale(*traceable(std::move(source)), {});
  ASSERT_TRUE(doubt.has_value());
  EXPECT_EQ(doubt->text,
            "As the model is scaled now, its steps are 1.2 m high and its storeys are 20 m high; at 0.15 "
            "metres per unit these would be 0.18 m and 3 m");
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
  storey.walkable = storey.layout.outline;
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
  expectAt(scaled.current().walkable.loops[0][1], {600, 100, 0});
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
