/// Rays that will gather light, foretold, against those that the bake then traces.

#include "engine/pipeline/gather_forecast.h"

#include <gtest/gtest.h>

#include <numeric>

#include "engine/bake/gathered_light.h"
#include "engine/bake/surface_light_bake.h"
#include "engine/pipeline/local_triangles.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

using test::SceneBuilder;

/// A room whose boxes hide parts of it from all cameras, with a ball of many small triangles.
RayScenePtr litRoom(std::initializer_list<Effect> off = {}) {
  SceneBuilder builder;
  const int paint = builder.material(test::matte({0.8f, 0.7f, 0.6f}));
  builder.box(paint, {-4, -3, 0}, {4, 3, 3}, true).point({0, 0, 2.5f}, 50);
  builder.box(paint, {2, 1, 0.1f}, {3.5f, 2.5f, 2}).box(paint, {-3, -2.5f, 0}, {-2, -1, 1});
  builder.sphere(paint, {-2.5f, 1.5f, 1}, 0.6f, 24);
  return builder.rays(off);
}

Project project() {
  Project project = test::smallProject(0.8, 3);
  project.bake.surfaceTexel = 0.1;
  project.bake.ambientRays = 8;
  project.bake.testEyes = 2;
  return project;
}

std::vector<int> allCameras(const OpenProject& open) {
  std::vector<int> cameras(open.layout->cameras.size());
  std::iota(cameras.begin(), cameras.end(), 0);
  return cameras;
}

double gatheredBy(const OpenProject& open, const std::vector<int>& cameras) {
  TaskRunner runner(1);
  CameraBaker baker(*open.rays, open.project.bake);
  CaptureCounts counts;
  for (const int camera : cameras) {
    const LayoutCamera& served = open.layout->cameras[std::size_t(camera)];
    const ColumnCamera columns = columnCameraFor(served, *open.layout, open.scene->bounds, open.project.bake);
    EXPECT_TRUE(baker.bake(served, columns, runner, counts));
  }
  return double(counts.rays.gathered);
}

void expectForetold(const OpenProject& open, const std::vector<int>& cameras, double within) {
  TaskRunner runner(1);
  const auto forecast = forecastGathering(open, cameras, nullptr, runner);
  ASSERT_TRUE(forecast) << forecast.error().describe();
  const double gathered = gatheredBy(open, cameras);
  ASSERT_GT(gathered, 0);
  EXPECT_NEAR(forecast->captureRays / gathered, 1, within);
  EXPECT_EQ(forecast->lightRays, 0);
  EXPECT_GT(forecast->secondsPerRay, 0);
  EXPECT_LT(forecast->relativeError, 0.1);
}

const std::initializer_list<Effect> kNoBounces{Effect::diffuseInterreflection};

TEST(GatherForecast, TellsWhatAllCamerasGather) {
  const OpenProject open = test::openWith(litRoom(kNoBounces), project());
  ASSERT_TRUE(open.plan.on(Effect::ambientOcclusion));
  expectForetold(open, allCameras(open), 0.1);
}

TEST(GatherForecast, TellsWhatBouncesGatherOfTheirCells) {
  const OpenProject open = test::openWith(litRoom(), project());
  ASSERT_TRUE(open.plan.on(Effect::diffuseInterreflection));
  expectForetold(open, allCameras(open), 0.15);
}

TEST(GatherForecast, TellsWhatFewCamerasGatherAndWithoutPruning) {
  Project wanted = project();
  wanted.bake.pruning = false;
  wanted.bake.maxLayers = 2;
  const OpenProject open = test::openWith(litRoom(kNoBounces), wanted);
  // Facets seen edge on are gathered for over more than they cover, which the forecast does not know.
  expectForetold(open, {1, 4}, 0.2);
}

TEST(GatherForecast, OfThePartsTellsTheWholeAsNoPartCan) {
  // Two halves of the cameras gather more than the whole does: each finds nothing there.
  const OpenProject open = test::openWith(litRoom(kNoBounces), project());
  std::vector<int> even, odd;
  for (const int camera : allCameras(open)) (camera % 2 == 0 ? even : odd).push_back(camera);
  TaskRunner runner(1);
  const auto rays = [&](const std::vector<int>& cameras) {
    return forecastGathering(open, cameras, nullptr, runner)->captureRays;
  };
  EXPECT_GT(rays(even) + rays(odd), 1.1 * rays(allCameras(open)));
  EXPECT_EQ(rays({}), 0);
}

TEST(GatherForecast, TellsWhatTheSurfacesOwnLightGathersBeyondTheCaptures) {
  const OpenProject open = test::openWith(litRoom(kNoBounces), project());
  TaskRunner runner(1);
  const LocalTriangles local = localTrianglesOf(*open.rays, *open.drawn, *open.layout, runner);
  const auto layout = layOutSurfaceLight(*open.rays, *open.drawn, local.wanted, open.project.bake);
  ASSERT_TRUE(layout);
  for (const std::vector<int>& cameras : {std::vector<int>{}, std::vector{0}}) {
    // The light reads every place of the surfaces it is baked for; those not read before are gathered.
    const auto fresh = test::openWith(litRoom(kNoBounces), project());
    gatheredBy(fresh, cameras);
    const auto gathered = fresh.rays->gatheredLight(fresh.project.bake);
    RayCounts rest;
    for (std::size_t n = 0; n < gathered->placeCount(); ++n) {
      const GatheredLight::Spot spot = gathered->place(n);
      if (layout->resolution[spot.sceneTriangle] > 0 && (!spot.back || layout->hasBack[spot.sceneTriangle]))
        gathered->gatherPlace(n, rest);
    }
    ASSERT_GT(rest.gathered, 0u);
    const auto forecast = forecastGathering(open, cameras, &*layout, runner);
    ASSERT_TRUE(forecast);
    EXPECT_NEAR(forecast->lightRays / double(rest.gathered), 1, 0.15);
  }
}

TEST(GatherForecast, IsTheSameHoweverManyThreadsAndNothingWhereNothingIsGathered) {
  OpenProject open = test::openWith(litRoom(), project());
  TaskRunner one(0), three(2);
  const auto a = forecastGathering(open, {0, 2}, nullptr, one),
             b = forecastGathering(open, {0, 2}, nullptr, three);
  ASSERT_TRUE(a && b);
  EXPECT_DOUBLE_EQ(a->captureRays, b->captureRays);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(forecastGathering(open, {0}, nullptr, one, stop.get_token()).error().kind, ErrorKind::cancelled);
  open.project.bake.ambientRays = 0;
  EXPECT_EQ(forecastGathering(open, {0}, nullptr, one)->captureRays, 0);
}

}  // namespace
}  // namespace acentric
