#include "engine/bake/ray_scene.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/ray_log.h"
#include "engine/bake/surface.h"
#include "engine/scene/import.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

const glm::vec3 kUp(0, 0, 1), kDown(0, 0, -1);

TEST(RayScene, FindsTheNearestSurfaceWithItsDistanceCornerWeightsAndNormal) {
  SceneBuilder builder;
  const int grey = builder.material(matte());
  builder.floor(grey, 4).floor(grey, 4, -1);
  const auto rays = builder.rays();
  const Hit hit = rays->trace({{1, -2, 3}, kDown});
  ASSERT_TRUE(hit.found());
  EXPECT_FLOAT_EQ(hit.distance, 3);
  EXPECT_EQ(hit.mesh, 0u);
  EXPECT_EQ(hit.geometricNormal(), kUp);
  const Mesh& mesh = rays->scene().meshes[hit.mesh];
  const glm::uvec3 t = mesh.triangles[hit.triangle];
  const glm::vec3 p = mesh.positions[t.x] * (1 - hit.barycentric.x - hit.barycentric.y) +
                      mesh.positions[t.y] * hit.barycentric.x + mesh.positions[t.z] * hit.barycentric.y;
  EXPECT_LT(glm::length(p - glm::vec3(1, -2, 0)), 1e-5f);
}

TEST(RayScene, HitsBackSidesAndKeepsTheWoundNormal) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1);
  const Hit hit = builder.rays()->trace({{0.1f, 0.2f, -2}, kUp});
  ASSERT_TRUE(hit.found());
  EXPECT_FLOAT_EQ(hit.distance, 2);
  EXPECT_EQ(hit.geometricNormal(), kUp);
}

TEST(RayScene, RespectsTheNearAndFarEndOfARay) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1);
  const auto rays = builder.rays();
  EXPECT_FALSE(rays->trace({{0.1f, 0.2f, 2}, kDown, 2.001f}).found());
  EXPECT_FALSE(rays->trace({{0.1f, 0.2f, 2}, kDown, 0, 1.999f}).found());
  EXPECT_TRUE(rays->trace({{0.1f, 0.2f, 2}, kDown, 1.999f, 2.001f}).found());
}

TEST(RayScene, AnEmptySceneIsTraceableAndHoldsNothing) {
  const auto rays = SceneBuilder().rays();
  ASSERT_NE(rays, nullptr);
  EXPECT_FALSE(rays->trace({{0, 0, 0}, kUp}).found());
  EXPECT_EQ(rays->transmittance({{0, 0, 0}, kUp}), glm::vec3(1));
}

TEST(RayScene, RefusesTrianglesThatNameMissingCorners) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1);
  auto broken = std::make_shared<Scene>(*builder.scene());
  broken->meshes[0].triangles[1].z = 17;
  const auto built = RayScene::build(broken, EffectPlan{});
  ASSERT_FALSE(built.has_value());
  EXPECT_EQ(built.error().kind, ErrorKind::malformed);
  EXPECT_NE(built.error().describe().find("mesh 1"), std::string::npos) << built.error().describe();
}

/// A floor whose left half (u < 0.5) is cut out, above another floor.
SceneBuilder cutOutScene() {
  SceneBuilder builder;
  ColourImage image(2, 1, Rgba8(255));
  image.at(0, 0).a = 0;
  Material leaf = matte();
  leaf.alphaMode = AlphaMode::mask;
  leaf.baseColourTexture = builder.texture(std::move(image));
  builder.floor(builder.material(leaf), 1, 1).floor(builder.material(matte()), 1, 0);
  return builder;
}

TEST(RayScene, OccludersAreNearerThanTheRaysEnd) {
  SceneBuilder builder;
  Material glass = matte();
  glass.alphaMode = AlphaMode::blend;
  glass.baseColour.a = 0.5f;
  builder.box(builder.material(matte()), {1, -1, -1}, {2, 1, 1}).floor(builder.material(glass), 9, -2);
  const auto rays = builder.rays();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-1, 1), end(0.5f, 4);
  int occluded = 0;
  for (int n = 0; n < 5000; ++n) {
    Ray ray{{any(random), 3 * any(random), any(random)},
            glm::normalize(glm::vec3(1, any(random), any(random)))};
    if (n % 3 != 0) ray.farthest = end(random);
    if (n % 5 == 0) ray.farthest = rays->occluderDistance(ray);  // what it meets at its end does not count
    const bool expected = rays->occluderDistance(ray) < ray.farthest;
    ASSERT_EQ(rays->isOccluded(ray), expected);
    occluded += expected ? 1 : 0;
  }
  EXPECT_GT(occluded, 500);
  EXPECT_FALSE(rays->isOccluded({{0, 0, 0}, kDown})) << "light passes it";
}

TEST(RayScene, ALogIsAskedAgainAsItWasAsked) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), glm::vec3(-1), glm::vec3(1), true);
  RayLog log;
  const auto rays = RayScene::build(builder.scene(), planEffects(*builder.scene()), &log);
  ASSERT_TRUE(rays);
  const std::uint64_t asked = 3 * RayLog::kRun * RayLog::kEvery;
  for (std::uint64_t n = 0; n < asked / 2; ++n) {
    (*rays)->trace({glm::vec3(0), kUp});
    (*rays)->isOccluded({glm::vec3(0), kUp, 0, 0.5f});  // nothing
  }
  EXPECT_NEAR(log.scale(), double(RayLog::kEvery), 0.01);
  EXPECT_EQ((*rays)->replay(log), log.singles().size() / 2);
  EXPECT_EQ(log.singles().size(), asked / RayLog::kEvery);
  log.clear();
  RayPacket packet;
  packet.direction.fill(kUp);
  packet.count = 5;
  std::array<Hit, RayPacket::kSize> hits;
  (*rays)->trace(packet, hits);
  EXPECT_EQ((*rays)->replay(log), 5u);
}

TEST(RayScene, AlphaTestedSurfacesAreCutOutForEveryKindOfRay) {
  const auto rays = cutOutScene().rays();
  const Ray hole{{-0.5f, 0.1f, 3}, kDown}, leaf{{0.5f, 0.1f, 3}, kDown};
  EXPECT_FLOAT_EQ(rays->trace(hole).distance, 3);
  EXPECT_FLOAT_EQ(rays->trace(leaf).distance, 2);
  EXPECT_FLOAT_EQ(rays->occluderDistance(hole), 3);
  EXPECT_FLOAT_EQ(rays->occluderDistance(leaf), 2);
  EXPECT_EQ(rays->transmittance({hole.origin, kDown, 0, 2.5f}), glm::vec3(1));
  EXPECT_EQ(rays->transmittance({leaf.origin, kDown, 0, 2.5f}), glm::vec3(0));
}

/// Of a mapped scene file the ray tracer reads vertices and triangles in place.
TEST(RayScene, RaysMeetAMappedSceneAsTheSameSceneInMemory) {
  SceneBuilder builder = cutOutScene();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 1);
  const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
  auto scene = std::make_shared<Scene>(*builder.scene());
  Mesh soup;
  for (std::uint32_t i = 0; i < 300; ++i) soup.positions.push_back(point());
  soup.normals.assign(soup.positions.size(), kUp);
  for (std::uint32_t i = 0; i < 300; i += 3) soup.triangles.push_back({i, i + 1, i + 2});
  scene->prototypes = {soup};
  scene->instances = {{0, glm::mat4x3(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 3)}};
  const auto path = std::filesystem::temp_directory_path() / "acentric_mapped_rays.acscene";
  ASSERT_TRUE(writeSceneFile(*scene, path));
  auto read = readSceneFile(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_TRUE(read->meshes[0].positions.isMapped() && read->prototypes[0].triangles.isMapped());
  const EffectPlan plan = planEffects(*scene);
  const auto inMemory = RayScene::build(scene, plan);
  const auto mapped = RayScene::build(std::make_shared<const Scene>(std::move(*read)), plan);
  ASSERT_TRUE(inMemory && mapped);
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray{2.0f * point() + glm::vec3(0, 0, 2), glm::normalize(point())};
    const Hit a = (*inMemory)->trace(ray), b = (*mapped)->trace(ray);
    ASSERT_EQ(a.found(), b.found());
    if (!a.found()) continue;
    ++found;
    ASSERT_EQ(a.distance, b.distance);
    ASSERT_EQ(a.mesh, b.mesh);
    ASSERT_EQ(a.triangle, b.triangle);
    ASSERT_EQ(a.barycentric, b.barycentric);
  }
  EXPECT_GT(found, 2000);
}

TEST(RayScene, WithoutTheAlphaTestMaskedSurfacesAreWhole) {
  const auto rays = cutOutScene().rays({Effect::alphaTest});
  EXPECT_FLOAT_EQ(rays->trace({{-0.5f, 0.1f, 3}, kDown}).distance, 2);
}

TEST(RayScene, LightPassesBlendedAndTransmissiveSurfacesByTheirShareAndStopsAtOpaqueOnes) {
  SceneBuilder builder;
  Material film = matte();
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.25f;
  Material green = matte({0.5f, 1, 0.25f});
  green.transmission = 1;
  builder.floor(builder.material(film), 1, 3)
      .floor(builder.material(green), 1, 2)
      .floor(builder.material(matte()), 1, 0);
  const auto rays = builder.rays();
  const glm::vec3 above(0.1f, 0.2f, 4);
  test::expectNear(rays->transmittance({above, kDown, 0, 1.5f}), glm::vec3(0.75f), 1e-5f);
  test::expectNear(rays->transmittance({above, kDown, 0, 3.5f}), 0.75f * 0.92f * glm::vec3(0.5f, 1, 0.25f),
                   1e-5f);
  EXPECT_EQ(rays->transmittance({above, kDown}), glm::vec3(0));
  EXPECT_FLOAT_EQ(rays->occluderDistance({above, kDown}), 4) << "glass does not occlude ambient light";
  EXPECT_FLOAT_EQ(rays->trace({above, kDown}).distance, 1);

  const auto solid = builder.rays({Effect::alphaBlend, Effect::transmission});
  EXPECT_EQ(solid->transmittance({above, kDown, 0, 1.5f}), glm::vec3(0));
  EXPECT_FLOAT_EQ(solid->occluderDistance({above, kDown}), 1);
}

/// Rays lifted off a surface by the rule of the shading: none may meet the surface again.
TEST(RayScene, NoSurfaceShadowsItselfAtAnyScaleOrPlace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const float size : {1e-3f, 1.0f, 1e2f, 1e4f})
    for (const float offset : {0.0f, 1.0f, 1e4f}) {
      if (offset > 1e3f * size) continue;  // a millimetre 10 km away is below the step of a float
      SceneBuilder builder;
      const glm::vec3 at = offset * glm::vec3(1, -0.7f, 0.3f);
      const glm::vec3 x = size * glm::normalize(glm::vec3(1, 0.3f, 0.2f)),
                      y = size * glm::normalize(glm::vec3(-0.1f, 1, 0.6f));
      builder.quad(builder.material(matte()), at - x - y, at + x - y, at + x + y, at - x + y);
      const auto rays = builder.rays();
      int met = 0;
      for (int n = 0; n < 4000; ++n) {
        const float u = unit(random), v = unit(random) * (1 - u);
        Hit hit{1,
                0,
                std::uint32_t(n & 1),
                {u, v},
                triangleNormal(rays->scene().meshes[0], std::uint32_t(n & 1))};
        const Surface s = surfaceAt<false>(rays->scene(), hit, hit.geometricNormal(), {}, false);
        const float azimuth = 6.2831853f * unit(random), height = 0.02f + 0.98f * unit(random);
        const glm::vec3 a = glm::normalize(glm::cross(s.normal, glm::vec3(0, 0.3f, 1))),
                        b = glm::cross(s.normal, a);
        const float flat = std::sqrt(1 - height * height);
        const glm::vec3 direction =
            glm::normalize(height * s.normal + flat * (std::cos(azimuth) * a + std::sin(azimuth) * b));
        if (rays->occluderDistance({s.rayOrigin, direction}) < std::numeric_limits<float>::infinity()) ++met;
      }
      EXPECT_EQ(met, 0) << "size " << size << ", offset " << offset;
    }
}

TEST(RayScene, NoLightLeaksThroughTheEdgesAndCornersOfAClosedRoom) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const float size : {1e-3f, 1.0f, 1e4f}) {
    SceneBuilder builder;
    builder.box(builder.material(matte()), size * glm::vec3(-1, -0.8f, 0), size * glm::vec3(1.3f, 1, 1),
                true);
    const auto rays = builder.rays();
    int leaks = 0;
    for (int n = 0; n < 6000; ++n) {
      // Points crowd towards an edge of each triangle, down to 1e-4 of its size.
      const float near = 1e-4f + 0.05f * unit(random) * unit(random);
      const float along = near + (1 - 3 * near) * unit(random);
      const glm::vec2 weights = n % 3 == 0   ? glm::vec2(near, along)
                                : n % 3 == 1 ? glm::vec2(along, near)
                                             : glm::vec2(along, 1 - along - near);
      const auto mesh = std::uint32_t(n % 6);
      Hit hit{1, mesh, std::uint32_t((n / 6) & 1), weights, {}};
      hit.across = triangleNormal(rays->scene().meshes[mesh], hit.triangle);
      const Surface s = surfaceAt<false>(rays->scene(), hit, hit.geometricNormal(), {}, false);
      glm::vec3 direction = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.5f);
      if (glm::dot(direction, s.normal) < 0) direction = -direction;
      if (rays->transmittance({s.rayOrigin, direction}) != glm::vec3(0)) ++leaks;
    }
    EXPECT_EQ(leaks, 0) << "size " << size;
  }
}

TEST(FlushDenormals, GivesTheThreadItsFormerModeBack) {
  const unsigned before = _mm_getcsr();
  {
    const FlushDenormals flush;
    EXPECT_EQ(_mm_getcsr() & 0x8040u, 0x8040u);
  }
  EXPECT_EQ(_mm_getcsr(), before);
}

}  // namespace
}  // namespace acentric
