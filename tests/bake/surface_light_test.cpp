#include <gtest/gtest.h>

#include <algorithm>

#include "engine/bake/shading.h"
#include "engine/bake/surface_light_bake.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

Result<SurfaceLight> bakeAll(const RayScene& scene, const BakeSettings& settings, int workers = 0,
                             glm::vec3 viewer = {0, 0, 1.6f}, std::stop_token stop = {}) {
  const std::size_t n = scene.scene().triangleCount();
  TaskRunner runner(workers);
  return bakeSurfaceLight(scene, DrawnScene(scene.sharedScene()),
                          std::vector<LightSides>(n, LightSides::front), std::vector<glm::vec3>(n, viewer),
                          settings, runner, {}, stop);
}

BakeSettings texel(double metres) {
  BakeSettings settings;
  settings.surfaceTexel = metres;
  return settings;
}

TEST(SurfaceLight, TimesBaseColourPlusEmissionIsWhatARaySees) {
  SceneBuilder builder;
  Material wall = matte({0.8f, 0.3f, 0.2f});
  wall.emissive = {0.1f, 0.2f, 0.3f};
  builder.box(builder.material(wall), {-3, -3, 0}, {3, 3, 3}, true)
      .box(builder.material(matte()), {1, 1, 0.2f}, {2, 2, 1})
      .point({0, 0, 2.5f}, 100)
      .sky(glm::vec3(2));
  const auto scene = builder.rays();
  const auto light = bakeAll(*scene, texel(0.1));
  ASSERT_TRUE(light.has_value()) << light.error().describe();
  const Shader shader(*scene, texel(0.1));
  const auto first = scene->scene().firstTriangles();
  RayCounts rays;
  int compared = 0;
  for (int n = 0; n < 400; ++n) {
    // Places of the samples themselves, so that nothing is interpolated; from three sides.
    const std::uint32_t mesh = std::uint32_t(n) % 12, triangle = std::uint32_t(n / 12) & 1;
    const std::uint32_t number = first[mesh] + triangle, r = light->resolution[number];
    const std::uint32_t i = 1 + std::uint32_t(n * 7) % (r / 3), j = 1 + std::uint32_t(n * 3) % (r / 3);
    const glm::vec2 b = glm::mix(glm::vec2(i, j) / float(r), glm::vec2(1.0f / 3), 0.1f / float(r));
    const Mesh& m = scene->scene().meshes[mesh];
    const glm::uvec3 t = m.triangles[triangle];
    const glm::vec3 at = m.positions[t.x] * (1 - b.x - b.y) + m.positions[t.y] * b.x + m.positions[t.z] * b.y;
    const glm::vec3 from = at + 0.05f * (m.normals[0] + 0.3f * glm::vec3(0.1f, 0.2f, 0.15f));
    const glm::vec3 direction = glm::normalize(at - from);
    const auto seen = shader.seenAlong({from, direction}, &RayCounts::primary, rays);
    if (std::abs(seen.opaque.distance - glm::length(at - from)) > 1e-4f) continue;
    const Material& material = scene->scene().materials[std::size_t(m.material)];
    const glm::vec3 baked =
        glm::vec3(material.baseColour) *
            glm::vec3(unpackColour(light->light[light->firstSample[number] + surfaceSampleIndex(r, i, j)])) +
        material.emissive;
    test::expectNear(baked, seen.radiance, 0.009f);  // light is rounded to six bits behind the first
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(SurfaceLight, BakesOnlyWhatIsWantedAndOnlyTheSidesThatShow) {
  SceneBuilder builder;
  Material leaf = matte();
  leaf.doubleSided = true;
  Material film = matte();
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.5f;
  builder.floor(builder.material(matte()), 1)
      .floor(builder.material(leaf), 1, 1)
      .floor(builder.material(film), 1, 2)
      .sky(glm::vec3(1));
  const auto scene = builder.rays();
  TaskRunner runner;
  using enum LightSides;
  const std::vector<LightSides> wanted{front, none, front, none, front, none};
  const auto light = bakeSurfaceLight(*scene, DrawnScene(scene->sharedScene()), wanted,
                                      std::vector<glm::vec3>(6), texel(0.5), runner);
  ASSERT_TRUE(light.has_value());
  EXPECT_EQ(light->hasBack, (std::vector<std::uint8_t>{0, 0, 1, 0, 1, 0}));
  ASSERT_EQ(light->firstSample.size(), 7u);
  const std::uint32_t r = light->resolution[0], n = surfaceSampleCount(r);
  EXPECT_EQ(r, 6u) << "a diagonal of 2.83 m by half a metre";
  EXPECT_EQ(light->resolution[1], 0u);
  EXPECT_EQ(light->firstSample, (std::vector<std::uint32_t>{0, n, n, 3 * n, 3 * n, 5 * n, 5 * n}));
  EXPECT_EQ(light->light.size(), 5 * n);
}

TEST(SurfaceLight, TheTwoSidesOfALeafAreLitApart) {
  SceneBuilder builder;
  Material leaf = matte();
  leaf.doubleSided = true;
  builder.floor(builder.material(leaf), 1).sun({0, 0, -1}, 100).sky(glm::vec3(1e-3f));
  const auto light = bakeAll(*builder.rays(), texel(0.5));
  ASSERT_TRUE(light.has_value());
  EXPECT_NEAR(light->at(0, {0.3f, 0.3f}, false).x, 100 / 3.14159f, 0.25f);
  EXPECT_LT(light->at(0, {0.3f, 0.3f}, true).x, 2e-3f);
}

TEST(SurfaceLight, ABackThatIsSeenIsLitByWhatLiesBehind) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1).sun({0, 0, -1}, 100).sky(glm::vec3(1e-3f));
  TaskRunner runner(0);
  const auto scene = builder.rays();
  const auto light =
      bakeSurfaceLight(*scene, DrawnScene(scene->sharedScene()), {LightSides::both, LightSides::front},
                       std::vector<glm::vec3>(2, glm::vec3(0, 0, 1.6f)), texel(0.5), runner);
  ASSERT_TRUE(light.has_value());
  EXPECT_EQ(light->hasBack, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_NEAR(light->at(0, {0.3f, 0.3f}, false).x, 100 / 3.14159f, 0.25f);
  EXPECT_LT(light->at(0, {0.3f, 0.3f}, true).x, 2e-3f);
}

TEST(SurfaceLight, SamplesOnAnEdgeThatTouchesAWallAreNotInsideIt) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true).point({0, 0, 1.5f}, 100);
  const auto light = bakeAll(*builder.rays({Effect::ambientOcclusion}), texel(0.25));
  ASSERT_TRUE(light.has_value());
  for (const HalfColour& sample : light->light) EXPECT_GT(unpackColour(sample).x, 0.3f) << "no black rim";
}

TEST(SurfaceLight, UnlitSurfacesHaveLightOne) {
  SceneBuilder builder;
  Material sign = matte({0.2f, 0.3f, 0.4f});
  sign.unlit = true;
  builder.floor(builder.material(sign), 1).floor(builder.material(matte()), 1, -1).sun({0, 0, -1}, 5);
  const auto light = bakeAll(*builder.rays(), texel(0.1));
  ASSERT_TRUE(light.has_value());
  EXPECT_EQ(light->at(0, {0.2f, 0.3f}, false), glm::vec3(1));
}

TEST(SurfaceLight, ANeedleDoesNotGetTheSamplesOfAPlate) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.quad(white, {0, 0, 0}, {8, 0, 0}, {8, 0.001f, 0}, {0, 0.001f, 0})
      .floor(white, 4, -1)
      .sky(glm::vec3(1));
  const auto light = bakeAll(*builder.rays(), texel(0.05));
  ASSERT_TRUE(light.has_value());
  EXPECT_EQ(light->resolution[2], 227u);  // 8 * sqrt(2) / 0.05
  EXPECT_LE(light->resolution[0], 6u);
  EXPECT_GE(light->resolution[0], 1u);
}

Result<SurfaceLight> bakeInParts(const RayScene& scene, double metres, SurfaceLightParts& parts,
                                 int workers) {
  const std::size_t n = scene.scene().triangleCount();
  TaskRunner runner(workers);
  return bakeSurfaceLight(
      scene, DrawnScene(scene.sharedScene()), std::vector<LightSides>(n, LightSides::front),
      std::vector<glm::vec3>(n, glm::vec3(0, 0, 1.6f)), texel(metres), runner, {}, {}, &parts);
}

TEST(SurfaceLight, GoesOnFromThePartsOfABakeThatEndedToTheSameBytes) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true)
      .point({0, 0, 1.5f}, 100)
      .sky(glm::vec3(1));
  const auto scene = builder.rays();
  const auto whole = bakeAll(*scene, texel(0.05));
  ASSERT_TRUE(whole.has_value());
  const auto bakeWith = [&](SurfaceLightParts& parts, int workers) {
    return bakeInParts(*scene, 0.05, parts, workers);
  };
  std::vector<SurfaceLightPart> kept;
  SurfaceLightParts ended;
  ended.secondsBetween = 0;
  ended.keep = [&](const SurfaceLightPart& part) -> Status {
    if (kept.size() == 3) return fail(ErrorKind::outOfSpace, "the disk is full");
    kept.push_back(part);
    return {};
  };
  const auto failed = bakeWith(ended, 2);
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().message, "the disk is full");
  ASSERT_EQ(kept.size(), 3u);

  std::uint64_t before = 0, after = 0;
  for (const SurfaceLightPart& part : kept) before += part.light.size();
  const HalfColour mark = packColour({777, 3, 5, 1});
  // What is known is taken as it is, not baked to the same once more.
  SurfaceLightParts marked;
  marked.known = kept;
  for (SurfaceLightPart& part : marked.known) part.light.assign(part.light.size(), mark);
  const auto withMarks = bakeWith(marked, 0);
  ASSERT_TRUE(withMarks.has_value());
  EXPECT_EQ(std::uint64_t(std::ranges::count(withMarks->light, mark)), before);

  SurfaceLightParts next;
  next.known = kept;
  SurfaceLightPart alien = kept.front();  // fits nowhere: another number of samples, a run that is not there
  alien.sizes.front() += 1;
  next.known.push_back(alien);
  next.known.push_back({{1u << 30}, {1}, {HalfColour{}}});
  next.secondsBetween = 0;
  next.keep = [&](const SurfaceLightPart& part) -> Status {
    after += part.light.size();
    return {};
  };
  const auto resumed = bakeWith(next, 1);
  ASSERT_TRUE(resumed.has_value());
  EXPECT_EQ(resumed->light, whole->light);
  EXPECT_EQ(next.resumed, before);
  EXPECT_EQ(before + after, whole->light.size()) << "nothing is baked twice";
}

/// A floor in the sun, half of it under a roof that ends at x = 0.13, and another one beside it in the open.
std::shared_ptr<const RayScene> floorWithAShadow() {
  SceneBuilder builder;
  const int white = builder.material(matte());
  return builder.quad(white, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})
      .quad(white, {3, -1, 0}, {5, -1, 0}, {5, 1, 0}, {3, 1, 0})
      .quad(white, {-9, -9, 1}, {0.13f, -9, 1}, {0.13f, 9, 1}, {-9, 9, 1})
      .sun({0, 0, -1}, 5)
      .rays();
}

TEST(SurfaceLight, IsFinerAtTheEdgesOfShadows) {
  const auto scene = floorWithAShadow();
  const auto light = bakeAll(*scene, texel(0.1));
  ASSERT_TRUE(light.has_value()) << light.error().describe();
  EXPECT_EQ(light->resolution[2], 29u) << "in the open: the diagonal over the texel";
  EXPECT_EQ(light->resolution[0], 4 * 29u);
  EXPECT_EQ(light->resolution[1], 4 * 29u);
  const Mesh& floor = scene->scene().meshes[0];
  const float lit = light->at(2, {0.3f, 0.3f}, false).x;
  ASSERT_GT(lit, 0);
  for (const std::uint32_t t : {0u, 1u})
    for (float x = 0.01f; x < 1; x += 0.02f)
      for (float y = 0.01f; x + y < 1; y += 0.02f) {
        const glm::uvec3& corners = floor.triangles[t];
        const glm::vec3 place = floor.positions[corners.x] * (1 - x - y) + floor.positions[corners.y] * x +
                                floor.positions[corners.z] * y;
        if (std::abs(place.x - 0.13f) < 0.03f) continue;  // within a sample of the edge
        EXPECT_EQ(light->at(t, {x, y}, false).x > 0.5f * lit, place.x > 0.13f) << place.x;
      }
}

TEST(SurfaceLight, GoesOnFromPartsOfBothPassesToTheSameBytes) {
  const auto scene = floorWithAShadow();
  std::vector<SurfaceLightPart> kept;
  SurfaceLightParts first;
  first.secondsBetween = 0;
  first.keep = [&](const SurfaceLightPart& part) -> Status {
    kept.push_back(part);
    return {};
  };
  const auto whole = bakeInParts(*scene, 0.02, first, 2);
  ASSERT_TRUE(whole.has_value());
  ASSERT_GT(kept.size(), 4u);
  for (const std::size_t count : {kept.size() / 2, kept.size() - 1, kept.size()}) {
    std::size_t baked = 0;
    SurfaceLightParts next;
    next.known.assign(kept.begin(), kept.begin() + std::ptrdiff_t(count));
    next.secondsBetween = 0;
    next.keep = [&](const SurfaceLightPart& part) -> Status {
      baked += part.runs.size();
      return {};
    };
    const auto resumed = bakeInParts(*scene, 0.02, next, 0);
    ASSERT_TRUE(resumed.has_value());
    EXPECT_EQ(resumed->light, whole->light);
    EXPECT_EQ(resumed->resolution, whole->resolution);
    std::size_t missing = 0;
    for (std::size_t part = count; part < kept.size(); ++part) missing += kept[part].runs.size();
    EXPECT_EQ(baked, missing) << "nothing is baked twice";
  }
}

TEST(SurfaceLight, GivesTheSameBytesForAnyNumberOfThreadsAndReportsProgress) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true)
      .point({0, 0, 1.5f}, 100)
      .sky(glm::vec3(1));
  const auto scene = builder.rays();
  const auto one = bakeAll(*scene, texel(0.05)), three = bakeAll(*scene, texel(0.05), 2);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->light, three->light);
  TaskRunner runner(1);
  std::vector<ProgressState> seen;
  ASSERT_TRUE(bakeSurfaceLight(*scene, DrawnScene(scene->sharedScene()),
                               std::vector<LightSides>(12, LightSides::front), std::vector<glm::vec3>(12),
                               texel(0.05), runner, [&](const ProgressState& p) { seen.push_back(p); })
                  .has_value());
  ASSERT_GT(seen.size(), 3u);
  EXPECT_EQ(seen.back().done, seen.back().total);
}

TEST(SurfaceLight, TheFrozenViewerDecidesWhatAMirrorShows) {
  SceneBuilder builder;
  Material silver;
  silver.roughness = 0;
  Material left = matte();
  left.unlit = true;
  left.baseColour = {1, 0, 0, 1};
  Material right = left;
  right.baseColour = {0, 0, 1, 1};
  builder.floor(builder.material(silver), 0.1f)
      .quad(builder.material(left), {-2, -9, 0}, {-2, 9, 0}, {-2, 9, 9}, {-2, -9, 9})
      .quad(builder.material(right), {2, -9, 0}, {2, 9, 0}, {2, 9, 9}, {2, -9, 9});
  const auto scene = builder.rays();
  const auto fromLeft = bakeAll(*scene, texel(0.1), 0, {-1, 0, 1}),
             fromRight = bakeAll(*scene, texel(0.1), 0, {1, 0, 1});
  ASSERT_TRUE(fromLeft && fromRight);
  EXPECT_EQ(fromLeft->at(0, {0.3f, 0.3f}, false), glm::vec3(0, 0, 1));
  EXPECT_EQ(fromRight->at(0, {0.3f, 0.3f}, false), glm::vec3(1, 0, 0));
  EXPECT_EQ(bakeAll(*scene, texel(0.1), 0, {-1, 0, -1})->at(0, {0.3f, 0.3f}, false), glm::vec3(0, 0, 1))
      << "an eye below the mirror is taken as above it";
}

TEST(SurfaceLight, IsCancelledWhenStopped) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1).sky(glm::vec3(1));
  std::stop_source stop;
  stop.request_stop();
  const auto light = bakeAll(*builder.rays(), texel(0.1), 0, {}, stop.get_token());
  ASSERT_FALSE(light.has_value());
  EXPECT_EQ(light.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace acentric
