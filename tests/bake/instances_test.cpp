/// A scene with instances is met by rays, shaded and captured as the same scene without: flattened() is the
/// reference. Rays are carried into a prototype's frame and back, which rounds otherwise than placing its
/// corners: distances agree to a few units in the last place of the coordinates, and a ray along an edge may
/// meet one neighbour in place of the other.

#include "engine/scene/instances.h"

#include <gtest/gtest.h>

#include <random>

#include "baked_camera.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/surface.h"
#include "engine/bake/surface_planes.h"

namespace acentric {
namespace {

using test::bakeAsSet;
using test::Baked;
using test::cameraAt;
using test::chequers;
using test::matte;
using test::SceneBuilder;
using test::square;

Material glass() {
  Material m = matte({0.9f, 0.6f, 0.7f});
  m.name = "glass";
  m.alphaMode = AlphaMode::blend;
  m.baseColour.a = 0.5f;
  return m;
}

glm::mat4x3 place(const glm::mat3& linear, const glm::vec3& at) {
  return {linear[0], linear[1], linear[2], at};
}

/// The meshes from `first` on become prototypes, each of which stands in each place.
std::shared_ptr<Scene> instanced(const Scene& from, std::size_t first,
                                 const std::vector<glm::mat4x3>& places) {
  auto scene = std::make_shared<Scene>(from);
  scene->prototypes.assign(scene->meshes.begin() + std::ptrdiff_t(first), scene->meshes.end());
  scene->meshes.resize(first);
  for (std::uint32_t p = 0; p < scene->prototypes.size(); ++p)
    for (const glm::mat4x3& at : places) scene->instances.push_back({p, at});
  scene->bounds = boundsOf(*scene);
  scene->parts = partsOf(*scene);
  scene->key = keyOf(scene->parts);
  return scene;
}

struct Twins {
  RayScenePtr instances, meshes;
  explicit Twins(const std::shared_ptr<Scene>& scene, const EffectOverrides& overrides = {}) {
    const auto flat = std::make_shared<const Scene>(flattened(*scene));
    instances = RayScene::build(scene, planEffects(*scene, overrides)).value();
    meshes = RayScene::build(flat, planEffects(*flat, overrides)).value();
  }
};

/// A floor, a sun and a sky, and of everything that shading knows something: a chequered box, a cut-out
/// sheet, a smooth ball, a pane.
SceneBuilder exhibits(std::size_t& first) {
  SceneBuilder builder;
  builder.floor(builder.material(matte({0.7f, 0.7f, 0.6f})), 30)
      .sun({0.4f, 0.3f, -0.8f}, 3)
      .sky({0.4f, 0.5f, 0.7f});
  first = builder.scene()->meshes.size();
  Material painted = matte();
  painted.baseColourTexture = builder.texture(chequers(8));
  builder.box(builder.material(painted), {-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1});
  Material holes = matte({0.2f, 0.8f, 0.3f});
  ColourImage leaf(4, 4, {255, 255, 255, 255});
  leaf.at(1, 1) = leaf.at(2, 2) = leaf.at(0, 3) = {255, 255, 255, 0};
  holes.baseColourTexture = builder.texture(leaf);
  holes.alphaMode = AlphaMode::mask;
  holes.doubleSided = true;
  const int sheet = builder.material(holes);
  builder.quad(sheet, {-1, 0, 1}, {1, 0, 1}, {1, 0.2f, 3}, {-1, 0.2f, 3});
  builder.sphere(builder.material(matte({0.8f, 0.3f, 0.2f})), {0, 0, 1.5f}, 0.45f, 8);
  builder.quad(builder.material(glass()), {-1, -1, 0.2f}, {1, -1, 0.2f}, {1, -1, 2}, {-1, -1, 2});
  return builder;
}

/// Exact in floats: moved, turned by quarters, doubled, mirrored.
std::vector<glm::mat4x3> exactPlaces() {
  return {place(glm::mat3(1), {6, 1, 0}), place({{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, {-2, 7.5f, 0}),
          place({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {-9, -3, 0}),
          place({{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {2, -6.25f, 0})};
}

std::vector<glm::mat4x3> crookedPlaces() {
  std::vector<glm::mat4x3> places;
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> random(-1, 1);
  for (int n = 0; n < 12; ++n) {
    const float turn = 3 * random(engine), tilt = 0.2f * random(engine), size = 1 + 0.5f * random(engine);
    const glm::mat3 about{
        {std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}, {0, 0, 1}};
    const glm::mat3 lean{{1, 0, tilt}, {0, 1, 0}, {-tilt, 0, 1}};
    const glm::mat3 stretch{{size, 0, 0}, {0, n % 3 == 0 ? -1.3f : 1.1f, 0}, {0, 0, 1}};
    places.push_back(
        place(about * lean * stretch, {12 * std::cos(float(n)), 12 * std::sin(float(n)), random(engine)}));
  }
  return places;
}

TEST(InstancesInRays, MeetWhatTheSameMeshesMeet) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  const Twins twins(instanced(*builder.scene(), first, crookedPlaces()));
  const Scene& scene = twins.instances->scene();
  ASSERT_EQ(scene.placedCount(), twins.meshes->scene().meshes.size());
  std::mt19937 engine(9);
  std::uniform_real_distribution<float> random(-1, 1);
  int met = 0, other = 0, onInstances = 0;
  for (int n = 0; n < 20000; ++n) {
    const Ray ray{{4 * random(engine), 4 * random(engine), 1 + random(engine)},
                  glm::normalize(glm::vec3(random(engine), random(engine), 0.3f * random(engine)))};
    const Hit a = twins.instances->trace(ray), b = twins.meshes->trace(ray);
    if (a.found() != b.found() || (a.found() && a.mesh != b.mesh)) {
      ++other;
      continue;
    }
    if (!a.found()) continue;
    ++met;
    onInstances += scene.isInstance(a.mesh) ? 1 : 0;
    EXPECT_NEAR(a.distance, b.distance, 3e-5f * (1 + b.distance));
    EXPECT_LT(glm::distance(a.geometricNormal(), b.geometricNormal()), 1e-4f);
    const glm::vec3 back = -ray.direction;
    const Surface one = surfaceAt<true>(scene, a, back, detailRules(twins.instances->plan()), true);
    const Surface two =
        surfaceAt<true>(twins.meshes->scene(), b, back, detailRules(twins.meshes->plan()), true);
    EXPECT_LT(glm::distance(one.position, two.position), 1e-4f * (1 + b.distance));
    EXPECT_LT(glm::distance(one.rayOrigin, two.rayOrigin), 2e-4f * (1 + b.distance));
    if (a.triangle == b.triangle) {
      EXPECT_LT(glm::distance(one.normal, two.normal), 2e-3f);
    }
    const SurfacePlane p = planeOf(scene, a, glm::dvec3(ray.origin), ray.direction, false),
                       q = planeOf(twins.meshes->scene(), b, glm::dvec3(ray.origin), ray.direction, false);
    if (a.triangle == b.triangle && glm::length(q.normal) < 10) {
      EXPECT_LT(glm::distance(p.normal, q.normal), 1e-3f * (1 + glm::length(q.normal)));
    }
    const glm::vec3 light = twins.instances->transmittance({ray.origin, ray.direction, 0, 40}),
                    same = twins.meshes->transmittance({ray.origin, ray.direction, 0, 40});
    if (light != same) ++other;
  }
  EXPECT_GT(met, 10000);
  EXPECT_GT(onInstances, 1000);
  EXPECT_LT(other, 20);
}

TEST(InstancesInRays, ArePacketsAndSolidRaysToo) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  const Twins twins(instanced(*builder.scene(), first, crookedPlaces()));
  std::mt19937 engine(19);
  std::uniform_real_distribution<float> random(-1, 1);
  int differ = 0;
  for (int n = 0; n < 500; ++n) {
    RayPacket packet;
    packet.origin = {random(engine), random(engine), 1.5f};
    packet.count = RayPacket::kSize;
    const float turn = 3.2f * random(engine);
    for (int k = 0; k < packet.count; ++k)
      packet.direction[std::size_t(k)] = glm::normalize(glm::vec3(
          std::cos(turn + 0.01f * float(k)), std::sin(turn + 0.01f * float(k)), 0.1f * random(engine)));
    std::array<Hit, RayPacket::kSize> hits;
    std::array<float, RayPacket::kSize> solid{};
    twins.instances->trace(packet, hits);
    twins.instances->occluderDistances(packet, solid);
    for (std::size_t k = 0; k < std::size_t(packet.count); ++k) {
      const Ray ray{packet.origin, packet.direction[k]};
      const Hit alone = twins.instances->trace(ray);
      differ += alone.mesh != hits[k].mesh || alone.triangle != hits[k].triangle ? 1 : 0;
      if (alone.mesh == hits[k].mesh && alone.triangle == hits[k].triangle && alone.found()) {
        EXPECT_LT(glm::distance(alone.geometricNormal(), hits[k].geometricNormal()), 1e-5f);
      }
      const float expected = twins.meshes->occluderDistance(ray);
      if (std::isfinite(expected) && std::isfinite(solid[k]))
        differ += std::abs(solid[k] - expected) > 1e-4f * (1 + expected) ? 1 : 0;
      else
        differ += std::isfinite(expected) != std::isfinite(solid[k]) ? 1 : 0;
    }
  }
  EXPECT_LT(differ, 8);
}

TEST(InstancesInRays, BrokenOnesAreRefused) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  for (const auto& harm : {+[](Scene& s) { s.instances[0].prototype = 99; },
                           +[](Scene& s) { s.instances[0].worldFromPrototype[0] = glm::vec3(0); },
                           +[](Scene& s) { s.prototypes[0].triangles[0].x = 1000; }}) {
    const auto scene = instanced(*builder.scene(), first, exactPlaces());
    harm(*scene);
    EXPECT_FALSE(RayScene::build(scene, EffectPlan{}));
  }
}

struct Difference {
  std::size_t pixels = 0, otherCounts = 0, samples = 0, otherDistances = 0, otherColours = 0;
  double colour = 0;  ///< mean, of channels
};

Difference compare(const Baked& a, const Baked& b) {
  Difference d;
  EXPECT_EQ(a.columns.rows, b.columns.rows);
  EXPECT_EQ(a.capture.distanceStep, b.capture.distanceStep);
  for (int k = 0; k < a.columns.columns; ++k)
    for (int r = 0; r < a.columns.rows; ++r) {
      const auto one = a.pixelAt(k, r), two = b.pixelAt(k, r);
      ++d.pixels;
      if (one.size() != two.size()) {
        ++d.otherCounts;
        continue;
      }
      for (std::size_t i = 0; i < one.size(); ++i) {
        ++d.samples;
        if (std::abs(one[i].w - two[i].w) > 1.01 * a.capture.distanceStep + 1e-4 * two[i].w)
          ++d.otherDistances;
        double most = 0;
        for (int c = 0; c < 3; ++c) {
          const double off = std::abs(double(one[i].colour[c]) - double(two[i].colour[c]));
          most = std::max(most, off), d.colour += off / 3;
        }
        if (most > 0.01) ++d.otherColours;
      }
    }
  d.colour /= double(std::max<std::size_t>(1, d.samples));
  return d;
}

/// `share`: of pixels or samples that may differ: those along edges, and by sampled light.
void expectSameFrames(const std::vector<glm::mat4x3>& places, bool silhouettes, double share,
                      const EffectOverrides& overrides = {}) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  const Twins twins(instanced(*builder.scene(), first, places), overrides);
  BakeSettings settings;
  settings.samplesPerDegree = 2, settings.ambientRays = 16, settings.surfaceTexel = 0.25;
  settings.silhouettes = silhouettes;
  const LayoutCamera camera = cameraAt({0.25, 0}, {square(1)});
  const Baked a = bakeAsSet(twins.instances, camera, settings), b = bakeAsSet(twins.meshes, camera, settings);
  const Difference d = compare(a, b);
  EXPECT_GT(d.samples, 10000u);
  EXPECT_LE(double(d.otherCounts), share * double(d.pixels));
  EXPECT_LE(double(d.otherDistances), share * double(d.samples));
  EXPECT_LE(double(d.otherColours), share * double(d.samples));
  EXPECT_LT(d.colour, 0.2 * share);
  testing::Test::RecordProperty("otherCounts", int(d.otherCounts));
  testing::Test::RecordProperty("otherDistances", int(d.otherDistances));
  testing::Test::RecordProperty("otherColours", int(d.otherColours));
}

TEST(InstancesInFrames, LookLikeMeshesWhereTheirPlacesAreExact) {
  expectSameFrames(exactPlaces(), false, 0.002);
}
TEST(InstancesInFrames, LookLikeMeshesInAnyPlace) { expectSameFrames(crookedPlaces(), false, 0.01); }
TEST(InstancesInFrames, LookLikeMeshesWithSilhouettes) { expectSameFrames(crookedPlaces(), true, 0.02); }
/// Fins of instances that the camera sees nearly edge on are turned towards it as those of meshes are; those
/// beside the picture, and those of which no triangle is as large as a part of a pixel, are left out.
TEST(InstancesInFrames, TurnTheSameFacetsThatAreSeenEdgeOn) {
  SceneBuilder builder;
  builder.floor(builder.material(matte({0.6f, 0.6f, 0.6f})), 40).sun({0.4f, 0.3f, -0.8f}, 3);
  const std::size_t first = builder.scene()->meshes.size();
  const int paint = builder.material(matte({0.9f, 0.2f, 0.1f}));
  for (int n = -4; n <= 4; ++n) {
    const float y = 0.25f * float(n);
    builder.box(paint, {-0.15f, y - 0.004f, 0.5f}, {0.15f, y + 0.004f, 3});
  }
  std::vector<glm::mat4x3> places;
  for (int n = 0; n < 10; ++n) {
    const float turn = 0.63f * float(n);
    places.push_back(
        place({{std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}, {0, 0, 1}},
              {9 * std::cos(turn), 9 * std::sin(turn), 0}));
  }
  places.push_back(place(glm::mat3(1e-3f), {9, 3, 1}));  // too small for any picture
  const Twins twins(instanced(*builder.scene(), first, places));
  BakeSettings settings;
  settings.samplesPerDegree = 4, settings.ambientRays = 0;
  const LayoutCamera camera = cameraAt({0.25, 0}, {square(1)});
  const Baked a = bakeAsSet(twins.instances, camera, settings), b = bakeAsSet(twins.meshes, camera, settings);
  settings.silhouettes = false;
  const Baked plain = bakeAsSet(twins.instances, camera, settings);
  EXPECT_GT(a.capture.sampleCount(), plain.capture.sampleCount() + 200);
  const Difference d = compare(a, b);
  EXPECT_LE(double(d.otherCounts), 0.001 * double(d.pixels));
  EXPECT_LE(double(d.otherDistances), 0.002 * double(d.samples));
  EXPECT_LE(double(d.otherColours), 0.002 * double(d.samples));
}

/// Bounced light is sampled by numbers of triangles, which instances do not have: it differs by its noise.
TEST(InstancesInFrames, LookLikeMeshesUnderBouncedLightButForItsNoise) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  const Twins twins(instanced(*builder.scene(), first, exactPlaces()),
                    {{Effect::diffuseInterreflection, true}});
  BakeSettings settings;
  settings.samplesPerDegree = 1, settings.ambientRays = 256, settings.surfaceTexel = 0.5;
  settings.silhouettes = false;
  const LayoutCamera camera = cameraAt({0.25, 0}, {square(1)});
  const Baked a = bakeAsSet(twins.instances, camera, settings), b = bakeAsSet(twins.meshes, camera, settings);
  EXPECT_LT(compare(a, b).colour, 0.005);
}

TEST(InstancesInFrames, AreTheSameWhateverTheNumberOfThreads) {
  std::size_t first = 0;
  const SceneBuilder builder = exhibits(first);
  const auto scene = instanced(*builder.scene(), first, crookedPlaces());
  BakeSettings settings;
  settings.samplesPerDegree = 1, settings.ambientRays = 8, settings.surfaceTexel = 0.25;
  const LayoutCamera camera = cameraAt({0.25, 0}, {square(1)});
  const Baked alone = bakeAsSet(Twins(scene).instances, camera, settings, 0),
              many = bakeAsSet(Twins(scene).instances, camera, settings, 3);
  EXPECT_EQ(alone.capture.row, many.capture.row);
  EXPECT_EQ(alone.capture.inverseDistance, many.capture.inverseDistance);
  ASSERT_EQ(alone.capture.colour.size(), many.capture.colour.size());
  for (std::size_t i = 0; i < alone.capture.colour.size(); ++i)
    EXPECT_EQ(unpackColour(alone.capture.colour[i]), unpackColour(many.capture.colour[i]));
}

TEST(InstancesInFrames, ShadowsFallOnThemAndFromThem) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.floor(white, 30).sun({0, 0, -1}, 3);
  const std::size_t first = builder.scene()->meshes.size();
  builder.floor(white, 1, 2);
  const Twins twins(
      instanced(*builder.scene(), first,
                {place(glm::mat3(1), {5, 0, 0}), place({{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, {5, 0.5f, 1})}));
  const auto lit = [&](const glm::vec3& at) {
    return twins.instances->transmittance({at, {0, 0, 1}}) == glm::vec3(1);
  };
  EXPECT_TRUE(lit({0, 0, 0.001f}));
  EXPECT_FALSE(lit({5, 0, 0.001f}));
  EXPECT_FALSE(lit({5, 0.5f, 2.001f})) << "one stands over the other";
  EXPECT_TRUE(lit({5, 0.5f, 3.001f}));
}

}  // namespace
}  // namespace acentric
