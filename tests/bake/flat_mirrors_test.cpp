#include "engine/scene/flat_mirrors.h"

#include <gtest/gtest.h>

#include <set>

#include "layout_builder.h"
#include "mirror_materials.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::glowing;
using test::SceneBuilder;
using test::silver;
using test::square;

/// Number of the mirror that a ray meets.
std::uint8_t seenBy(const RayScene& scene, const FlatMirrors& mirrors, glm::vec3 from, glm::vec3 to) {
  const Ray ray{from, glm::normalize(to - from)};
  const Hit hit = scene.trace(ray);
  EXPECT_TRUE(hit.found());
  return hit.found() ? mirrors.at(hit.mesh, hit.triangle, -ray.direction) : std::uint8_t(0);
}

TEST(FlatMirrors, AreOnePerPlaneAndSide) {
  SceneBuilder builder;
  const int m = builder.material(silver()), other = builder.material(silver({0.5f, 0.5f, 0.5f}));
  const int wall = builder.material(glowing(glm::vec3(1)));
  builder.floor(m, 1).floor(other, 1, 0, {5, 0});  // coplanar
  builder.quad(m, {0, 5, 0}, {0, 5, 2}, {2, 5, 2}, {2, 5, 0}).floor(wall, 1, 0, {-5, 0});
  const auto scene = builder.rays();
  const FlatMirrors mirrors(scene->scene(), scene->plan());
  ASSERT_TRUE(mirrors.any());
  const auto at = [&](glm::vec3 from, glm::vec3 to) { return seenBy(*scene, mirrors, from, to); };
  const std::uint8_t above = at({0, 0, 3}, {0.3f, 0.2f, 0});
  EXPECT_NE(above, 0);
  EXPECT_EQ(at({0, 0, 3}, {-0.3f, -0.6f, 0}), above) << "the other triangle";
  EXPECT_EQ(at({5, 0, 3}, {5.3f, 0, 0}), above) << "another mesh and material in the same plane";
  const std::uint8_t below = at({0, 0, -3}, {0.3f, 0.2f, 0});
  EXPECT_NE(below, 0);
  EXPECT_NE(below, above);
  const std::uint8_t upright = at({1, 3, 1}, {1, 5, 0.9f});
  EXPECT_EQ((std::set<int>{0, above, below, upright}.size()), 4u);
  EXPECT_EQ(at({-5, 0, 3}, {-5, 0.1f, 0}), 0) << "no mirror at all";
}

TEST(FlatMirrors, AreFoundAgainAmongSimplifiedSurfaces) {
  SceneBuilder builder;
  const int m = builder.material(silver()), wall = builder.material(glowing(glm::vec3(1)));
  builder.floor(m, 1).floor(m, 1, 2, {5, 0}).floor(wall, 1, 0, {-5, 0});
  const auto scene = builder.rays();
  const FlatMirrors mirrors(scene->scene(), scene->plan());
  LocalGeometry local = clipToPolygon(scene->scene(), square(20));
  auto surfaces = std::make_shared<LocalSurfaces>();  // the same surfaces in another order
  surfaces->meshes.assign(scene->scene().meshes.rbegin(), scene->scene().meshes.rend());
  LocalGeometry simplified = local;
  simplified.surfaces = surfaces;
  const glm::dvec3 eye(0, 0, 1.6);
  std::set<int> numbers;
  for (std::size_t t = 0; t < local.triangles.size(); ++t) {
    LocalTriangle& moved = simplified.triangles[t];
    moved.mesh = std::uint32_t(surfaces->meshes.size()) - 1 - moved.mesh;
    const std::uint8_t plane = mirrors.planeOf(local, local.triangles[t]);
    EXPECT_EQ(mirrors.planeOf(simplified, moved), plane);
    if (plane == FlatMirrors::kNoPlane) continue;
    const std::uint8_t number = mirrors.seenFrom(plane, eye);
    const glm::vec3 corner = local.vertices[local.triangles[t].vertices.x].position;
    EXPECT_EQ(number,
              mirrors.at(local.triangles[t].mesh, local.triangles[t].triangle, glm::vec3(eye) - corner));
    numbers.insert(number);
  }
  EXPECT_EQ(numbers.size(), 2u) << "one from above, one from below";
}

TEST(FlatMirrors, AreNeitherCurvedNorBumpyNorClear) {
  SceneBuilder builder;
  const int m = builder.material(silver());
  Material clear = silver();
  clear.alphaMode = AlphaMode::blend;
  clear.baseColour.a = 0.5f;
  builder.sphere(m, {0, 0, 0}, 1, 12).floor(builder.material(clear), 1, 0, {5, 0});
  ColourImage bumps(2, 2, Rgba8(128, 128, 255, 255));
  Material bumpy = silver();
  bumpy.normalTexture = builder.texture(bumps);
  builder.floor(builder.material(bumpy), 1, 0, {10, 0});
  builder.lastMesh().tangents.assign(4, {1, 0, 0, 1});
  const auto scene = builder.rays();
  EXPECT_FALSE(FlatMirrors(scene->scene(), scene->plan()).any());
  const auto smooth = builder.rays({Effect::normalMaps});
  EXPECT_TRUE(FlatMirrors(smooth->scene(), smooth->plan()).any()) << "without its bumps it is flat";
  const auto none = builder.rays({Effect::normalMaps, Effect::mirrorReflection});
  EXPECT_FALSE(FlatMirrors(none->scene(), none->plan()).any());
}

TEST(FlatMirrors, OfMoreThanCanBeNumberedAreTheLargest) {
  SceneBuilder builder;
  const int m = builder.material(silver());
  constexpr int kFloors = 200;
  for (int i = 0; i < kFloors; ++i) builder.floor(m, 1 + 0.01f * float(i * 37 % kFloors), 0.1f * float(i));
  const auto scene = builder.rays();
  const FlatMirrors mirrors(scene->scene(), scene->plan());
  std::set<int> numbers;
  for (int i = 0; i < kFloors; ++i) {
    const float z = 0.1f * float(i);
    const int number = seenBy(*scene, mirrors, {0, 0, z + 0.05f}, {0.1f, 0, z});
    EXPECT_EQ(number != 0, i * 37 % kFloors >= kFloors - int(FlatMirrors::kMaxPlanes)) << i;
    if (number != 0) numbers.insert(number);
  }
  EXPECT_EQ(numbers.size(), FlatMirrors::kMaxPlanes);
}

}  // namespace
}  // namespace acentric
