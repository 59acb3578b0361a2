#include "engine/bake/area_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/bake/direct_light.h"
#include "engine/bake/shading.h"
#include "engine/bake/spherical_triangle.h"
#include "engine/geometry/conventions.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

Material glowing(float radiance, glm::vec3 colour = glm::vec3(1)) {
  Material m = matte(glm::vec3(0));
  m.emissive = radiance * colour;
  return m;
}

Surface facingUp(glm::vec3 at) {
  Surface surface;
  surface.position = surface.rayOrigin = at;
  surface.normal = surface.geometricNormal = {0, 0, 1};
  return surface;
}

BakeSettings withShadowRays(int count) {
  BakeSettings settings;
  settings.shadowRays = count;
  return settings;
}

/// From a rectangle of radiance 1 that faces the lit point, whose corner lies straight over it.
double cornerIrradiance(double width, double depth, double height) {
  const double a = width / height, b = depth / height;
  const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
  return 0.5 * (a / p * std::atan(b / p) + b / q * std::atan(a / q));
}

TEST(AreaLights, ARectangleSendsWhatItsFormFactorSays) {
  // A panel of 2 x 1 m at 1.5 m that faces down, over a floor seen at several places beneath it.
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 20)
      .quad(builder.material(glowing(3)), {-1, 0.5f, 1.5f}, {1, 0.5f, 1.5f}, {1, -0.5f, 1.5f},
            {-1, -0.5f, 1.5f});
  const auto scene = builder.rays();
  const DirectLights lights(*scene, withShadowRays(16));
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.9, 0.4}, {-0.3, 0.2}, {1.0, 0.5}}) {
    double expected = 0;
    for (const double w : {1 - x, 1 + x})
      for (const double d : {0.5 - y, 0.5 + y}) expected += cornerIrradiance(w, d, 1.5);
    const Surface surface = facingUp({x, y, 1e-6f});
    RayCounts rays;
    EXPECT_NEAR(lights.wide<false>(surface, rays).x, 3 * expected, 1e-4 * expected);
    EXPECT_EQ(rays.softShadow, 0u);
    EXPECT_NEAR(lights.wide<true>(surface, rays).x, 3 * expected, 1e-4 * expected)
        << "with nothing in between, shadow rays add no noise";
    EXPECT_EQ(rays.softShadow, 16u);
  }
}

TEST(AreaLights, ADiscOfManyTrianglesIsExactNearAndWithinAPercentFarAway) {
  SceneBuilder builder;
  const int lamp = builder.material(glowing(5));
  builder.floor(builder.material(matte()), 0.01f, -50);
  constexpr int kSides = 96;
  const float radius = 0.5f;
  const auto rim = [&](int i) {
    const double angle = -2 * kPi * i / kSides;
    return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < kSides; i += 2) builder.quad(lamp, {0, 0, 0}, rim(i), rim(i + 1), rim(i + 2));
  const auto scene = builder.rays();
  const AreaLights lights(scene->scene(), scene->plan());
  ASSERT_FALSE(lights.empty());
  const double square = radius * radius * kSides / (2 * kPi) * std::sin(2 * kPi / kSides);  // of its area
  for (const double d : {0.05, 0.3, 1.0, 3.0, 8.0, 20.0}) {
    const double expected = 5 * kPi * square / (square + d * d);
    EXPECT_NEAR(lights.irradiance(facingUp({0, 0, -d})).x, expected, (d < 0.5 ? 2e-3 : 0.01) * expected)
        << d << " m";
  }
  EXPECT_EQ(lights.irradiance(facingUp({0, 0, 1})), glm::vec3(0)) << "behind it";
}

TEST(AreaLights, ASphereOfThousandsOfTrianglesFallsOffWithTheSquareOfItsDistance) {
  SceneBuilder builder;
  builder.sphere(builder.material(glowing(2)), {0, 0, 0}, 0.1f, 32)
      .floor(builder.material(matte()), 0.1f, -9);
  const auto scene = builder.rays();
  const AreaLights lights(scene->scene(), scene->plan());
  for (const float d : {0.2f, 0.5f, 1.0f, 4.0f}) {
    const double expected = 2 * kPi * 0.01 / (d * d);
    EXPECT_NEAR(lights.irradiance(facingUp({0, 0, -d})).x, expected, 0.04 * expected) << d << " m";
  }
}

TEST(AreaLights, OfManyLampsAroundComeWithinThreePercentOfAllTheirTriangles) {
  // 7 x 7 lamps of a hall, near and far from places between them: more parts than a cut may have.
  SceneBuilder builder;
  const int lamp = builder.material(glowing(2));
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      builder.sphere(lamp, {2.4f * float(x) + 0.3f * float(y % 2), 1.9f * float(y), 3}, 0.06f, 6);
  builder.floor(builder.material(matte()), 0.1f, -9);
  const auto scene = builder.rays();
  const AreaLights lights(scene->scene(), scene->plan());
  for (const glm::dvec3 place : {glm::dvec3{0.3, 0.2, 0}, {1.3, -2.9, 1.4}, {-4.1, 0.8, 2.2}, {2, 2, 2.8}}) {
    double expected = 0;
    for (const Mesh& mesh : scene->scene().meshes) {
      if (mesh.material != lamp) continue;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<glm::dvec3, 3> corners;
        for (int c = 0; c < 3; ++c) corners[c] = glm::dvec3(mesh.positions[mesh.triangles[t][c]]) - place;
        if (glm::dot(glm::dvec3(triangleNormal(mesh, t)), corners[0]) < 0)
          expected += 2 * triangleIrradiance(corners, {0, 0, 1});
      }
    }
    EXPECT_NEAR(lights.irradiance(facingUp(place)).x, expected, 0.03 * expected) << place.z << " m up";
  }
}

TEST(AreaLights, OnlyTheFrontShinesUnlessTheMaterialHasTwoSides) {
  for (const bool twoSided : {false, true}) {
    SceneBuilder builder;
    Material lamp = glowing(1);
    lamp.doubleSided = twoSided;
    builder.floor(builder.material(lamp), 1);  // faces up
    const auto scene = builder.rays();
    const AreaLights lights(scene->scene(), scene->plan());
    EXPECT_EQ(lights.irradiance(facingUp({0, 0, -1})).x > 0, twoSided);
  }
}

TEST(SphericalTriangle, DrawsDirectionsEvenlyAndMeasuresItsSolidAngle) {
  const std::array<glm::dvec3, 3> octant{{{2, 0, 0}, {0, 5, 0}, {0, 0, 1}}};
  const SphericalTriangle triangle(octant);
  EXPECT_NEAR(triangle.solidAngle(), kPi / 2, 1e-12);
  // The mean direction of an octant is (1, 1, 1) / 2, and the mean of z squared a third.
  glm::dvec3 mean(0);
  double square = 0;
  constexpr int kGrid = 200;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const glm::dvec3 d = triangle.directionAt({(i + 0.5) / kGrid, (j + 0.5) / kGrid});
      ASSERT_NEAR(glm::length(d), 1, 1e-9);
      ASSERT_GE(std::min({d.x, d.y, d.z}), -1e-9);
      mean += d / double(kGrid * kGrid);
      square += d.z * d.z / (kGrid * kGrid);
    }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 0.5, 1e-4);
  EXPECT_NEAR(square, 1.0 / 3, 1e-4);
  EXPECT_NEAR(triangleIrradiance(octant, {0, 0, 1}), kPi / 4, 1e-12) << "a quarter of the upper half's pi";
  EXPECT_NEAR(triangleIrradiance({{{2, 0, -2}, {0, 5, -5}, {0, 0, 1}}}, {0, 0, 1}),
              triangleIrradiance({{{4.0 / 3, 0, -1.0 / 3 + 1.0 / 3}, {0, 5.0 / 6, 0}, {0, 0, 1}}}, {0, 0, 1}),
              1e-9)
      << "what lies below the horizon sends nothing";
}

/// A floor, a light overhead, and a half-plane x < 0 that shades it, 1 m above the floor and 2 m below it.
TEST(AreaLights, APenumbraIsAsWideAsTheLightIsSeenPastTheEdge) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 50)
      .quad(builder.material(matte()), {-50, -50, 1}, {0, -50, 1}, {0, 50, 1}, {-50, 50, 1})
      .quad(builder.material(glowing(10)), {-0.1f, 0.1f, 3}, {0.1f, 0.1f, 3}, {0.1f, -0.1f, 3},
            {-0.1f, -0.1f, 3});
  const auto scene = builder.rays();
  const DirectLights lights(*scene, withShadowRays(256));
  RayCounts rays;
  // From x on the floor the edge hides the light up to x_light = 3/2 * 0 - ... = -2 x: all of it for x =
  // -0.05.
  for (const double x : {-0.1, -0.06, -0.04, -0.02, 0.0, 0.02, 0.04, 0.06, 0.1}) {
    const double share = std::clamp((0.1 + 2 * x) / 0.2, 0.0, 1.0);
    const Surface surface = facingUp({x, 0.013f, 1e-6f});
    const float open = lights.wide<false>(surface, rays).x;
    EXPECT_NEAR(lights.wide<true>(surface, rays).x / open, share, share == 0 || share == 1 ? 1e-6 : 0.02)
        << "x " << x;
  }
}

TEST(WideLights, ASunAndABulbCastPenumbrasOfTheirSizeAndKeepTheirStrength) {
  constexpr float kAngle = 0.05f, kRadius = 0.1f;
  for (const bool sun : {true, false}) {
    SceneBuilder builder;
    builder.floor(builder.material(matte()), 50)
        .quad(builder.material(matte()), {-50, -50, 1}, {0, -50, 1}, {0, 50, 1}, {-50, 50, 1});
    if (sun)
      builder.sun({0, 0, -1}, 10).size(kAngle);
    else
      builder.point({0, 0, 3}, 90).size(kRadius);
    const auto scene = builder.rays();
    const DirectLights lights(*scene, withShadowRays(256));
    RayCounts rays;
    const double width = sun ? std::tan(kAngle) : 0.5 * kRadius;  // of half the penumbra
    for (const double place : {-1.2, -0.5, 0.0, 0.5, 1.2}) {
      const float x = float(place * width);
      const double hidden = std::clamp(place, -1.0, 1.0);
      const double share = 0.5 + (hidden * std::sqrt(1 - hidden * hidden) + std::asin(hidden)) / kPi;
      const double open = sun ? 10 : 90 * 3 / std::pow(9 + double(x) * double(x), 1.5);
      EXPECT_NEAR(lights.wide<true>(facingUp({x, 0.017f, 1e-6f}), rays).x, open * share, 0.02 * open)
          << (sun ? "sun " : "bulb ") << place;
    }
    EXPECT_EQ(rays.softShadow, 5u * 256u);
    EXPECT_EQ(rays.shadow, 0u);
    // Off, they are lights without size.
    const DirectLights hard(*builder.rays({Effect::softShadows}), {});
    EXPECT_TRUE(hard.hasSmall() && !hard.hasWide());
  }
}

/// Random points of a furnished room, each shaded as two cameras see it.
TEST(WideLights, TwoCamerasFindTheSameLightAtOnePlace) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.box(white, {-4, -3, 0}, {4, 3, 3}, true)
      .box(white, {0.5f, 0.5f, 0.2f}, {1.5f, 1.2f, 1})
      .quad(builder.material(glowing(4)), {-1, 1, 2.9f}, {1, 1, 2.9f}, {1, -1, 2.9f}, {-1, -1, 2.9f})
      .point({-2, 1, 2}, 10)
      .size(0.2f);
  const auto scene = builder.rays();
  BakeSettings settings;
  settings.surfaceTexel = 0.2;
  const Shader shader(*scene, settings);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 1);
  int same = 0, compared = 0;
  RayCounts rays;
  for (int n = 0; n < 4000; ++n) {
    const glm::vec3 first(-3, -2, 1.6f), second(2, -1.5f, 1.7f);
    const glm::vec3 way =
        glm::normalize(glm::vec3(place(random) - 0.4f, place(random) - 0.4f, 0.7f * place(random) - 0.6f));
    const Hit a = scene->trace({first, way});
    ASSERT_TRUE(a.found());
    const glm::vec3 again = glm::normalize(first + way * a.distance - second);
    const Hit b = scene->trace({second, again});
    if (a.mesh != b.mesh || a.triangle != b.triangle) continue;
    if (glm::distance(first + way * a.distance, second + again * b.distance) > 1e-5f) continue;
    ++compared;
    const glm::vec3 lightA = shader.shade(a, -way, rays).light, lightB = shader.shade(b, -again, rays).light;
    same += glm::distance(lightA, lightB) <= 1e-4f * glm::length(lightA) ? 1 : 0;
  }
  ASSERT_GT(compared, 1500);
  EXPECT_GT(double(same) / compared, 0.99) << "all but points on the border of two cubes of samples";
}

TEST(PositionSamples, AnyPowerOfTwoOfThemLieInDifferentStrips) {
  const PositionSamples samples(0.01f);
  for (const glm::vec3 at : {glm::vec3(0), glm::vec3(1.7f, -20, 3e5f)})
    for (const std::uint32_t count : {2u, 16u, 64u}) {
      std::vector<int> columns(count, 0), rows(count, 0);
      const auto points = samples.at(at, 3);
      for (std::uint32_t k = 0; k < count; ++k) {
        const glm::vec2 p = points.at(k);
        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
        ++columns[std::size_t(p.x * float(count))], ++rows[std::size_t(p.y * float(count))];
      }
      EXPECT_EQ(columns, std::vector<int>(count, 1));
      EXPECT_EQ(rows, std::vector<int>(count, 1));
    }
  const glm::vec2 here = samples.at({1.001f, 0, 0}, 0).at(0);
  EXPECT_EQ(here, samples.at({1.002f, 0.001f, 0}, 0).at(0)) << "one cube, one draw";
  EXPECT_NE(here, samples.at({1.02f, 0, 0}, 0).at(0));
  EXPECT_NE(here, samples.at({1.001f, 0, 0}, 1).at(0)) << "another light, another draw";
}

}  // namespace
}  // namespace acentric
