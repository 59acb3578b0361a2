/// Surfaces where a bake's numbers go wrong: through the centre of projection, and given twice. Each case is
/// checked on the real thing and on a deliberately naive variant that must fail.

#include <gtest/gtest.h>

#include "engine/bake/bake.h"
#include "engine/bake/light_set.h"
#include "tests/bake/layout_builder.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::cameraAt;
using test::matte;
using test::SceneBuilder;
using test::square;

Capture bakeCase(const RayScenePtr& scene, const LayoutCamera& camera, double eyeZ, double nearBand) {
  BakeSettings settings;
  settings.eyeRange = 0;  // heights are chosen by place, and would differ from scale to scale
  settings.samplesPerDegree = 1;
  settings.ambientRays = 0;
  TaskRunner runner(0);
  CaptureCounts counts;
  const ColumnCamera columns = columnCameraFor(camera, eyeZ, nearBand, scene->scene().bounds, settings);
  auto capture = CameraBaker(*scene, settings).bake(camera, columns, runner, counts);
  EXPECT_TRUE(capture.has_value()) << (capture ? "" : capture.error().describe());
  return capture ? std::move(*capture) : Capture{};
}

TEST(HardCases, AWallThroughTheCentreOfProjectionLeavesNoNoiseInTheCaptureAtAnyScale) {
  std::vector<std::size_t> samples;
  std::size_t noiseAtOneScale = 0;
  for (const double scale : {1e-3, 1.0, 1e4}) {
    // The region lies behind the camera, which stands on its border: rays leave it at once. A slanted wall
    // passes through the centre of projection, as it does where a lattice corner lies in a wall.
    const glm::dvec2 centre = scale * glm::dvec2(0.3, -0.7);
    const double eyeZ = 1.6 * scale;
    const LayoutCamera camera = cameraAt(centre, {square(scale, centre - glm::dvec2(scale, 0))});
    const glm::dvec2 along = scale * directionOf(1.9);
    SceneBuilder builder;
    const int white = builder.material(matte());
    builder.box(white, glm::vec3(-6 * scale, -5 * scale, 0), glm::vec3(6 * scale, 5 * scale, 3 * scale),
                true);
    builder.quad(white, {centre - along, 0}, {centre + along, 0}, {centre + along, 3 * scale},
                 {centre - along, 3 * scale});
    const RayScenePtr scene = builder.rays();
    const Capture capture = bakeCase(scene, camera, eyeZ, 0);
    ASSERT_TRUE(capture.check().has_value());
    for (const float w : capture.inverseDistance)
      EXPECT_LE(double(w) * scale, 10) << "the room, its ceiling under 85 degrees";
    samples.push_back(capture.sampleCount());

    // Naively: everything from the centre of projection on.
    std::size_t noise = 0;
    for (int k = 0; k < capture.camera.columns; ++k)
      for (int r = 0; r < capture.camera.rows; ++r) {
        const double elevation = capture.camera.elevationAt(r + 0.5);
        const glm::dvec2 flat = std::cos(elevation) * capture.camera.directionAt(k + 0.5);
        const Hit hit = scene->trace({glm::vec3(centre, eyeZ), glm::vec3(flat, std::sin(elevation)), 0});
        noise += hit.found() && double(hit.distance) < 1e-4 * scale;
      }
    noiseAtOneScale = std::max(noiseAtOneScale, noise);
  }
  EXPECT_EQ(samples[0], samples[1]);
  EXPECT_EQ(samples[2], samples[1]);
  EXPECT_GT(noiseAtOneScale, 10u) << "rounding is recorded as a surface";
}

/// How many triangles of the scene a ray passes through.
std::size_t trianglesAlong(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction) {
  std::size_t met = 0;
  for (const Mesh& mesh : scene.meshes)
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - origin,
                       b = glm::dvec3(mesh.positions[t.y]) - origin,
                       c = glm::dvec3(mesh.positions[t.z]) - origin;
      const double u = glm::dot(direction, glm::cross(a, b)), v = glm::dot(direction, glm::cross(b, c)),
                   w = glm::dot(direction, glm::cross(c, a)), volume = glm::dot(a, glm::cross(b, c));
      met += volume > 0 ? u > 0 && v > 0 && w > 0 : u < 0 && v < 0 && w < 0;
    }
  return met;
}

TEST(HardCases, ASurfaceGivenTwiceIsKeptOnceAndNotOncePerTriangle) {
  struct Made {
    Capture capture;
    std::size_t everyTriangle = 0;  ///< naively: each triangle that a pixel's ray meets is a layer of its own
  };
  const auto capturedWith = [](int walls) {
    SceneBuilder builder;
    const int white = builder.material(matte());
    for (int n = 0; n < walls; ++n) builder.quad(white, {3, 2, 0}, {3, -2, 0}, {3, -2, 3}, {3, 2, 3});
    builder.box(white, {-6, -5, 0}, {6, 5, 3}, true);
    const RayScenePtr rays = builder.rays();
    Made made{bakeCase(rays, cameraAt({0, 0}, {square(1), square(2)}), 1.6, 1)};
    const ColumnCamera& camera = made.capture.camera;
    for (int k = 0; k < camera.columns; ++k)
      for (int r = 0; r < camera.rows; ++r)
        made.everyTriangle += trianglesAlong(rays->scene(), camera.centreOfProjection,
                                             {camera.directionAt(k + 0.5), camera.tangentAt(r + 0.5)});
    return made;
  };
  const Made once = capturedWith(1), twice = capturedWith(2);
  EXPECT_EQ(once.capture.row, twice.capture.row);
  EXPECT_EQ(once.capture.inverseDistance, twice.capture.inverseDistance);
  EXPECT_GT(twice.everyTriangle, once.everyTriangle + 1000);
}

TEST(HardCases, ALampLightsWhatIsNearItAlikeInAnyUnitAndNotByAClosestDistanceInMetres) {
  // Candela go by the square of the unit, so that irradiance stays.
  int naiveDarker = 0;
  for (const float scale : {1e-3f, 1.0f, 1e4f})
    for (const float distance : {0.03f, 0.5f, 4.0f}) {
      Scene scene;
      Light lamp;
      lamp.kind = LightKind::point;
      lamp.intensity = 7 * scale * scale;
      scene.lights = {lamp};
      EffectOverrides on;
      on[Effect::pointLights] = true;
      const LightSet lights = lightSet(scene, planEffects(scene, on));
      ASSERT_EQ(lights.point.size(), 1u);
      const float expected = 7 / (distance * distance);
      const glm::vec3 open = openIrradiance(lights, {distance * scale, 0, 0});
      EXPECT_NEAR(open.x, expected, 1e-4f * expected) << "scale " << scale << ", " << distance << " m";
      const float clamped = std::max(distance * scale, 1e-4f);
      naiveDarker += lamp.intensity / (clamped * clamped) < 0.5f * expected;
    }
  EXPECT_GT(naiveDarker, 0);
}

}  // namespace
}  // namespace acentric
