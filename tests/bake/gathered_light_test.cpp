#include "engine/bake/gathered_light.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <thread>

#include "engine/bake/shading.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::expectNear;
using test::matte;
using test::SceneBuilder;

RayScenePtr withBounces(const SceneBuilder& builder, std::initializer_list<Effect> off = {}) {
  EffectOverrides overrides{{Effect::diffuseInterreflection, true}};
  for (const Effect effect : off) overrides[effect] = false;
  const ScenePtr scene = builder.scene();
  auto rays = RayScene::build(scene, planEffects(*scene, overrides));
  EXPECT_TRUE(rays.has_value());
  return rays ? *rays : nullptr;
}

BakeSettings bouncing(int bounces) {
  BakeSettings settings;
  settings.bounces = bounces;
  settings.surfaceTexel = 0.25;
  return settings;
}

struct Probe {
  glm::vec3 radiance{0};
  RayCounts rays;
};
Probe probe(const RayScenePtr& scene, glm::vec3 from, glm::vec3 to, const BakeSettings& settings) {
  Probe out;
  out.radiance = Shader(*scene, settings)
                     .seenAlong({from, glm::normalize(to - from)}, &RayCounts::primary, out.rays)
                     .radiance;
  return out;
}

/// In a closed room of albedo a whose walls all emit E, radiance after n bounces is E (1 + a + ... + a^n)
/// everywhere, and E / (1 - a) in the limit.
TEST(GatheredLight, AFurnaceGlowsAsTheSumOfItsBounces) {
  const glm::vec3 albedo(0.7f, 0.5f, 0.2f), emission(1, 2, 3);
  SceneBuilder builder;
  Material wall = matte(albedo);
  wall.emissive = emission;
  builder.box(builder.material(wall), {-2, -1.5f, 0}, {2, 1.5f, 2.5f}, true);
  // Not as area lights: the glow itself is what bounces.
  const auto scene = withBounces(builder, {Effect::areaLights});
  glm::vec3 sum = emission;
  for (int n = 1; n <= 8; ++n) {
    sum = emission + albedo * sum;
    for (const glm::vec3 to :
         {glm::vec3(2, 0.3f, 1.1f), glm::vec3(-0.4f, 0.7f, 0), glm::vec3(0.3f, -1.5f, 2.4f)})
      expectNear(probe(scene, {0, 0, 1}, to, bouncing(n)).radiance, sum, 5e-3f);
  }
  expectNear(sum, emission / (1.0f - albedo), 0.05f);
}

/// The same room where the glow counts among the lights: its direct light is exact, and is one bounce more.
TEST(GatheredLight, WhatIsAmongTheLightsIsNotCountedTwice) {
  const float albedo = 0.5f;
  SceneBuilder builder;
  Material wall = matte(glm::vec3(albedo));
  wall.emissive = glm::vec3(2);
  builder.box(builder.material(wall), {-2, -1.5f, 0}, {2, 1.5f, 2.5f}, true);
  const auto scene = withBounces(builder);
  ASSERT_TRUE(scene->plan().on(Effect::areaLights));
  float sum = 2 + albedo * 2;
  for (int n = 1; n <= 3; ++n) {
    sum = 2 + albedo * sum;
    expectNear(probe(scene, {0, 0, 1}, {2, 0.3f, 1.1f}, bouncing(n)).radiance, glm::vec3(sum), 5e-3f);
  }
}

/// A lamp between two endless white planes: what a floor sends to the ceiling over it.
TEST(GatheredLight, OneBounceOfALampIsWhatTheLitFloorSends) {
  SceneBuilder builder;
  const int white = builder.material(matte(glm::vec3(0.5f)));
  const float radius = 0.5f, height = 2;
  // A floor lit evenly by a narrow sun through nothing, seen by a shelf that faces down at `height`.
  builder.floor(white, radius)
      .quad(white, {-9, 9, height}, {9, 9, height}, {9, -9, height}, {-9, -9, height})
      .spot({0, 0, 1.999f}, {0, 0, -1}, 40, 0.9f, 1.0f);
  const auto scene = withBounces(builder);
  BakeSettings settings = bouncing(1);
  settings.ambientRays = 1024;
  settings.surfaceTexel = 0.02;
  // Reference: the floor's radiance integrated over its area.
  const double pi = std::numbers::pi;
  double expected = 0;
  constexpr int kGrid = 400;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const double x = radius * (2 * (i + 0.5) / kGrid - 1), y = radius * (2 * (j + 0.5) / kGrid - 1);
      const double lamp = x * x + y * y + 1.999 * 1.999, up = x * x + y * y + height * height;
      const double radiance = 0.5 / pi * 40 * 1.999 / std::pow(lamp, 1.5);
      expected += radiance * height * height / (up * up) * std::pow(2 * radius / kGrid, 2);
    }
  const Probe p = probe(scene, {0.01f, 0.02f, 1}, {0.011f, 0.021f, 2}, settings);
  EXPECT_NEAR(p.radiance.x, 0.5 / pi * expected, 0.05 * 0.5 / pi * expected);
  EXPECT_GT(p.rays.bounce, 0u);
}

TEST(GatheredLight, MoreBouncesAddLessAndLess) {
  SceneBuilder builder;
  builder.box(builder.material(matte(glm::vec3(0.6f))), {-2, -2, 0}, {2, 2, 3}, true)
      .box(builder.material(matte(glm::vec3(0.3f))), {0.5f, 0.5f, 0}, {1, 1, 1.5f})
      .point({-1, -1, 2.5f}, 50);
  const auto scene = withBounces(builder);
  float before = 0, gained = std::numeric_limits<float>::infinity();
  for (int n = 1; n <= 5; ++n) {
    const float now = probe(scene, {-1, 0, 1.5f}, {1.5f, 1.9f, 0}, bouncing(n)).radiance.x;
    EXPECT_GT(now, before);
    if (n > 1) {
      EXPECT_LT(now - before, gained);
      gained = now - before;
    }
    before = now;
  }
}

TEST(GatheredLight, TheSkyLightsARoomThroughItsWindowOnly) {
  SceneBuilder builder;
  builder.box(builder.material(matte(glm::vec3(0.5f))), {-2, -2, 0}, {2, 2, 3}, true).sky(glm::vec3(1));
  const Probe closed = probe(withBounces(builder), {0, 0, 1}, {0.5f, 0.4f, 0}, bouncing(2));
  EXPECT_EQ(closed.radiance, glm::vec3(0));
  SceneBuilder open;
  open.floor(open.material(matte(glm::vec3(0.5f))), 5).sky(glm::vec3(2));
  expectNear(probe(withBounces(open), {0, 0, 1}, {0.5f, 0.4f, 0}, bouncing(2)).radiance, glm::vec3(1), 2e-3f);
}

TEST(GatheredLight, IsGatheredOnceWhoeverReadsIt) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true).point({0, 0, 2}, 9);
  const auto scene = withBounces(builder);
  const Probe first = probe(scene, {0, 0, 1}, {1, 0.3f, 0}, bouncing(2));
  const Probe second = probe(scene, {0.5f, 0.5f, 1.5f}, {1, 0.3f, 0}, bouncing(2));
  EXPECT_GT(first.rays.bounce, 0u);
  EXPECT_EQ(second.rays.bounce, 0u);
  EXPECT_NEAR(first.radiance.x, second.radiance.x, 1e-5f * first.radiance.x);
  EXPECT_EQ(scene->gatheredLight(bouncing(2)), scene->gatheredLight(bouncing(2)));
  EXPECT_NE(scene->gatheredLight(bouncing(2)), scene->gatheredLight(bouncing(3)));
}

TEST(GatheredLight, ReadByManyThreadsAtOnceItIsTheSameAndCountsEachRayOnce) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true).point({0, 0, 2}, 9);
  const auto look = [&](int threads) {
    const auto scene = withBounces(builder);
    std::vector<RayCounts> rays(std::size_t(threads) + 1);
    std::vector<std::vector<glm::vec3>> seen(std::size_t(threads) + 1);
    const auto run = [&](std::size_t n) {
      const Shader shader(*scene, bouncing(2));
      for (int i = 0; i < 300; ++i) {
        const glm::vec3 way =
            glm::normalize(glm::vec3(std::sin(i * 0.7f), std::cos(i * 0.4f), std::sin(i * 1.1f)));
        seen[n].push_back(shader.seenAlong({{0, 0, 1}, way}, &RayCounts::primary, rays[n]).radiance);
      }
    };
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t) pool.emplace_back(run, std::size_t(t));
    run(std::size_t(threads));
    for (std::thread& t : pool) t.join();
    RayCounts sum;
    for (const RayCounts& r : rays) sum += r;
    for (const auto& each : seen) EXPECT_EQ(each, seen[0]);
    return std::pair(seen[0], sum.bounce);
  };
  EXPECT_EQ(look(0), look(3));
}

RayScenePtr hallUnderSky() {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.box(white, {-4, -3, 0}, {4, 3, 3}, true)
      .box(white, {0.5f, 0.5f, 0.2f}, {1.5f, 1.2f, 1})
      .sky(glm::vec3(1));
  return builder.rays();
}
/// Some way to look in it, unit.
glm::vec3 wayNumbered(int i) {
  return glm::normalize(glm::vec3(std::sin(i * 0.7f), std::cos(i * 0.43f), 0.9f * std::sin(i * 1.3f)));
}

TEST(GatheredLight, ReadsBetweenPlacesWithinAPercentOfGatheringThere) {
  const auto scene = hallUnderSky();
  ASSERT_TRUE(scene->plan().on(Effect::ambientOcclusion));
  BakeSettings settings;
  settings.ambientRays = 512;
  const auto gathered = scene->gatheredLight(settings);
  const Ambient exact(*scene, {}, settings);
  RayCounts rays;
  double square = 0, sum = 0;
  int count = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 way = wayNumbered(i);
    const Hit hit = scene->trace({{-1, -1, 1.5f}, way});
    ASSERT_TRUE(hit.found());
    const float read = gathered->at(hit, glm::dot(hit.geometricNormal(), way) > 0, rays).radiance.x;
    const float there =
        exact.gather<true>(*scene, surfaceAt<false>(scene->scene(), hit, -way, {}, false), rays).radiance.x;
    square += (read - there) * (read - there), sum += there, ++count;
  }
  EXPECT_LT(std::sqrt(square / count), 0.01 * sum / count);
}

/// A scene with more triangles than there are places: what is kept of those read lately is what they would
/// be.
TEST(GatheredLight, OfMoreTrianglesThanPlacesIsTheSame) {
  const auto scene = hallUnderSky();
  const GatheredLight whole(*scene, {}), few(*scene, {}, 100);
  EXPECT_GT(whole.placeCount(), 100u);
  EXPECT_EQ(few.placeCount(), 0u);
  EXPECT_TRUE(whole.isLaidOut(0));
  EXPECT_FALSE(few.isLaidOut(0));
  RayCounts rays, again;
  for (RayCounts* counts : {&rays, &again})
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 way = wayNumbered(i);
      const Hit hit = scene->trace({{-1, -1, 1.5f}, way});
      ASSERT_TRUE(hit.found());
      const bool back = glm::dot(hit.geometricNormal(), way) > 0;
      EXPECT_EQ(few.at(hit, back, *counts).radiance, whole.at(hit, back, *counts).radiance);
    }
  EXPECT_GT(rays.total(), 0u);
  EXPECT_EQ(again.total(), 0u) << "kept";
}

/// Rooms of which every place and cell is asked for.
SceneBuilder furnishedRoom() {
  SceneBuilder builder;
  const int white = builder.material(matte(glm::vec3(0.8f)));
  return builder.box(white, {-2, -1.5f, 0}, {2, 1.5f, 2.5f}, true)
      .box(white, {0.5f, 0.5f, 0.2f}, {1.53f, 1.2f, 1})
      .point({-1, -1, 2}, 9);
}

TEST(GatheredLight, PlacesAndCellsKnowWhatSurfaceReadsThem) {
  const auto scene = withBounces(furnishedRoom());
  const GatheredLight light(*scene, bouncing(2));
  double area = 0;  // of both sides
  for (const Mesh& mesh : scene->scene().meshes)
    for (const glm::uvec3& t : mesh.triangles)
      area += double(glm::length(
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x])));
  const auto sumOf = [&](std::size_t count, const auto& spotAt) {
    double sum = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const GatheredLight::Spot spot = spotAt(n);
      const Mesh& mesh = scene->scene().meshes[spot.mesh];
      const glm::uvec3& t = mesh.triangles[spot.triangle];
      // Strictly inside its triangle, on its plane; the back faces the other way.
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      const glm::dvec3 across = glm::cross(b - a, c - a);
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        EXPECT_GT(glm::dot(glm::cross(to - from, spot.position - from), across), 0);
      EXPECT_NEAR(glm::dot(spot.position - a, across), 0, 1e-6);
      EXPECT_GT(glm::dot(glm::dvec3(spot.normal), across) * (spot.back ? -1 : 1), 0);
      sum += spot.squareMetres;
    }
    return sum;
  };
  EXPECT_NEAR(sumOf(light.placeCount(), [&](std::size_t n) { return light.place(n); }), 3 * area, 1e-4)
      << "each point of a surface reads three places";
  EXPECT_NEAR(sumOf(light.cellCount(), [&](std::size_t n) { return light.cell(n); }), area, 1e-4);
  const auto without = withBounces(furnishedRoom(), {Effect::diffuseInterreflection});
  EXPECT_EQ(GatheredLight(*without, bouncing(2)).cellCount(), 0u);
}

TEST(GatheredLight, WhatWasGatheredByNumberIsWhatSurfacesRead) {
  const auto scene = withBounces(furnishedRoom());
  const auto gathered = scene->gatheredLight(bouncing(2));
  RayCounts cells, places, read;
  for (std::size_t n = 0; n < gathered->cellCount(); ++n)
    for (int bounces = 0; bounces < 2; ++bounces) gathered->gatherCell(n, bounces, cells);
  EXPECT_GT(cells.shadow, 0u);
  EXPECT_EQ(cells.gathered, cells.total());
  EXPECT_LE(cells.bounce, gathered->cellCount() * std::uint64_t(GatheredLight::kCellRays));
  for (std::size_t n = 0; n < gathered->placeCount(); ++n) gathered->gatherPlace(n, places);
  EXPECT_EQ(places.gathered, places.bounce) << "every cell was there already";
  EXPECT_LE(places.bounce, gathered->placeCount() * std::uint64_t(bouncing(2).ambientRays));
  EXPECT_GT(places.bounce, gathered->placeCount() * std::uint64_t(bouncing(2).ambientRays) * 9 / 10);
  const Shader shader(*scene, bouncing(2));
  for (int i = 0; i < 300; ++i)
    shader.seenAlong(
        {{-1, 0, 1}, glm::normalize(glm::vec3(std::sin(i * 0.7f), std::cos(i * 0.4f), std::sin(i * 1.1f)))},
        &RayCounts::primary, read);
  EXPECT_GT(read.primary, 0u);
  EXPECT_EQ(read.gathered, 0u);
}

/// One place here leads to tens of thousands of cells that nobody has read yet, each of which leads to more.
TEST(GatheredLight, AStopEndsEvenALongGatherAndKeepsNothingUnfinished) {
  const auto scene = withBounces(furnishedRoom());
  BakeSettings settings = bouncing(8);
  settings.surfaceTexel = 0.004;
  settings.ambientRays = 1024;
  const GatheredLight light(*scene, settings);
  std::stop_source stop;
  RayCounts rays;
  std::chrono::steady_clock::time_point stopped;
  std::jthread timer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stopped = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  light.gatherPlace(5, rays, stop.get_token());
  const auto ended = std::chrono::steady_clock::now();
  timer.join();
  EXPECT_GE(ended, stopped);
  EXPECT_LT(ended - stopped, std::chrono::seconds(1));

  const GatheredLight whole(*scene, bouncing(3)), interrupted(*scene, bouncing(3));
  const Hit hit = scene->trace({{-1, 0, 1.5f}, {1, 0, 0}});
  RayCounts all, none, again;
  const glm::vec3 expected = whole.at(hit, false, all).radiance;
  interrupted.at(hit, false, none, stop.get_token());
  EXPECT_EQ(none.total(), 0u) << "nothing was kept";
  EXPECT_EQ(interrupted.at(hit, false, again).radiance, expected);
  EXPECT_EQ(again.total(), all.total());
}

TEST(ValuesOnDemand, AreMadeOnceAndKept) {
  const ValuesOnDemand values(3);
  RayCounts rays;
  int made = 0;
  for (int again = 0; again < 2; ++again)
    for (std::size_t i = 0; i < 3; ++i) {
      const HalfColour value = values.at(i, rays, [&](RayCounts& own) {
        ++made, ++own.bounce;
        return packColour({float(i), 0, 0, 1});
      });
      EXPECT_EQ(unpackColour(value).r, float(i));
    }
  EXPECT_EQ(made, 3);
  EXPECT_EQ(rays.bounce, 3u);
  EXPECT_EQ(rays.gathered, 3u);
}

TEST(ScatteredValuesOnDemand, AreWhatTheyAreReadForHoweverManyThereAre) {
  using Key = ScatteredValuesOnDemand::Key;
  const ScatteredValuesOnDemand values;
  const auto valueOf = [](const Key& key) {
    return HalfColour(1 + key.place % 7, 1 + key.triangle % 1000, 1 + key.triangle / 1000 % 1000,
                      1 + key.placed);
  };
  std::size_t made = 0;
  const auto read = [&](const Key& key, RayCounts& rays) {
    return values.at(key, rays, [&](RayCounts& own) {
      ++made;
      own.bounce += 3;
      return valueOf(key);
    });
  };
  RayCounts rays;
  constexpr std::uint32_t kMany = 9'000'000;  // more than are kept
  std::size_t wrong = 0;
  for (std::uint32_t n = 0; n < kMany; ++n) {
    const Key key{n % 5, n / 5, n % 3};
    if (read(key, rays) != valueOf(key)) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(made, kMany);
  EXPECT_EQ(rays.gathered, 3 * std::uint64_t(kMany));
  // What was read last is there still, and costs nothing; what is long ago may be made again, and is the
  // same.
  made = 0;
  for (std::uint32_t n = kMany - 100'000; n < kMany; ++n) {
    const Key key{n % 5, n / 5, n % 3};
    if (read(key, rays) != valueOf(key)) ++wrong;
  }
  EXPECT_LT(made, 5000u);
  for (std::uint32_t n = 0; n < 100'000; ++n) {
    const Key key{n % 5, n / 5, n % 3};
    if (read(key, rays) != valueOf(key)) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(ValuesOnDemand, AreMadeAgainIfTheyCouldNotBeMade) {
  const ValuesOnDemand values(1);
  RayCounts rays;
  const auto made = [&](float alpha) {
    return unpackColour(values.at(0, rays, [&](RayCounts& own) {
      ++own.bounce;
      return packColour({alpha, 0, 0, alpha});
    }));
  };
  EXPECT_EQ(made(0), glm::vec4(0));
  EXPECT_EQ(rays.bounce, 0u);
  EXPECT_EQ(made(1).r, 1);
  EXPECT_EQ(made(0).r, 1);
  EXPECT_EQ(rays.bounce, 1u);
}

}  // namespace
}  // namespace acentric
