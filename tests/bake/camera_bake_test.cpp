#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "baked_camera.h"
#include "engine/bake/truth.h"

namespace acentric {
namespace {

using test::bakeAsSet;
using test::Baked;
using test::bakeFrom;
using test::cameraAt;
using test::firstOnly;
using test::kEyeZ;
using test::matte;
using test::room;
using test::SceneBuilder;
using test::square;

TEST(BakeCamera, MeasuresTheWallsOfARoomExactly) {
  const Baked baked = bakeFrom(room().rays(), cameraAt({0.5, 0}, {square(1)}));
  ASSERT_EQ(baked.columns.columns, 120);
  std::size_t checked = 0;
  for (int k = 0; k < baked.columns.columns; ++k)
    for (int r = 0; r < baked.columns.rows; ++r) {
      const glm::dvec2 c = baked.columns.directionAt(k + 0.5);
      const double t = baked.columns.tangentAt(r + 0.5);
      double distance = (6 - 0.5) / c.x;
      if (c.y > 0) distance = std::min(distance, 5 / c.y);
      if (c.y < 0) distance = std::min(distance, -5 / c.y);
      if (t > 0) distance = std::min(distance, (3 - kEyeZ) / t);
      if (t < 0) distance = std::min(distance, -kEyeZ / t);
      // Floor and ceiling within the served square are local geometry: the march goes on to what lies below
      // or above them, which is nothing.
      const auto samples = baked.pixelAt(k, r);
      ASSERT_EQ(samples.size(), 1u);
      const double exit = std::min(0.5 / c.x, std::min(c.y > 0 ? 1 / c.y : 1e9, c.y < 0 ? -1 / c.y : 1e9));
      if (std::abs(distance - exit) < 1e-4) continue;
      if (distance < exit) {
        EXPECT_EQ(samples[0].w, 0);
      } else {
        EXPECT_NEAR(samples[0].w, 1 / distance, 0.5 * baked.capture.distanceStep + 1e-5 / distance)
            << "column " << k << ", row " << r;
        ++checked;
      }
    }
  EXPECT_GT(checked, baked.capture.sampleCount() / 2);
}

TEST(BakeCamera, RoundsDistancesAsMuchAsTheSettingsAllow) {
  const auto scene = room().rays();
  const LayoutCamera camera = cameraAt({0.5, 0}, {square(1)});
  BakeSettings settings = firstOnly();
  const Baked usual = bakeFrom(scene, camera, settings);
  ASSERT_GT(usual.capture.distanceStep, 0);
  settings.distanceShift = 4 * kUsualDistanceShift;
  const Baked coarse = bakeFrom(scene, camera, settings);
  EXPECT_EQ(coarse.capture.distanceStep, 4 * usual.capture.distanceStep);
  settings.distanceShift = 0;
  const Baked fine = bakeFrom(scene, camera, settings);
  EXPECT_EQ(fine.capture.distanceStep, 0);
  ASSERT_EQ(fine.capture.sampleCount(), coarse.capture.sampleCount());
  double worst = 0;
  for (std::size_t i = 0; i < fine.capture.sampleCount(); ++i)
    worst = std::max(
        worst, std::abs(double(fine.capture.inverseDistance[i]) - double(coarse.capture.inverseDistance[i])));
  EXPECT_GT(worst, 0.25 * coarse.capture.distanceStep);
  EXPECT_LE(worst, 0.51 * coarse.capture.distanceStep);
  EXPECT_TRUE(coarse.capture.check());
}

TEST(BakeCamera, SkipsWhatStandsInsideTheServedRegion) {
  SceneBuilder builder = room();
  builder.box(builder.material(matte()), {1, -0.5f, 1}, {1.5f, 0.5f, 2});  // an exhibit
  const auto scene = builder.rays();
  const auto inside = bakeFrom(scene, cameraAt({0, 0}, {square(2)}), firstOnly()).pixel(0.01, 0.01);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_NEAR(1 / inside[0].w, 6, 0.01) << "the wall behind the exhibit";
  const auto outside = bakeFrom(scene, cameraAt({0, 0}, {square(0.75)}), firstOnly()).pixel(0.01, 0.01);
  ASSERT_EQ(outside.size(), 1u);
  EXPECT_NEAR(1 / outside[0].w, 1, 0.01) << "the exhibit itself";
}

TEST(BakeCamera, KeepsTheFirstSurfaceOfEveryServedRegionOnce) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  builder.box(white, {1, -0.5f, 1}, {1.5f, 0.5f, 2}).box(white, {3, -0.5f, 1}, {3.5f, 0.5f, 2});
  const auto scene = builder.rays();
  const auto distances = [&](std::vector<ConvexPolygon> served) {
    std::vector<int> centimetres;
    for (const auto& s : bakeFrom(scene, cameraAt({0, 0}, std::move(served)), firstOnly()).pixel(0.01, 0.01))
      centimetres.push_back(int(std::lround(100 / s.w)));
    return centimetres;
  };
  EXPECT_EQ(distances({square(0.5)}), (std::vector{100}));
  EXPECT_EQ(distances({square(0.5), square(2)}), (std::vector{100, 300}));
  EXPECT_EQ(distances({square(4), square(0.5), square(2)}), (std::vector{100, 300, 600}));
  EXPECT_EQ(distances({square(0.5), square(0.8)}), (std::vector{100}))
      << "one surface serves both, stored once";
  EXPECT_EQ(distances({square(1.2)}), (std::vector{150})) << "the exhibit's far side, seen from within";
}

TEST(BakeCamera, EverySampleSaysWhichRolesNeedIt) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  builder.box(white, {1, -0.5f, 1}, {1.5f, 0.5f, 2}).box(white, {3, -0.5f, 1}, {3.5f, 0.5f, 2});
  BakeSettings settings = firstOnly();
  settings.pruning = false;
  LayoutCamera camera = cameraAt({0, 0}, {square(0.5), square(2), square(0.8)});
  const auto rolesAhead = [&] {
    std::vector<std::pair<int, int>> found;
    for (const auto& s : bakeFrom(builder.rays(), camera, settings).pixel(0.01, 0.01))
      found.emplace_back(int(std::lround(100 / s.w)), s.roles);
    return found;
  };
  EXPECT_EQ(rolesAhead(), (std::vector<std::pair<int, int>>{{100, 5}, {300, 2}}));
  // A role that draws only what lies beyond x = 2.
  camera.roles[0].clip = Clip{{{{2, 0}, {2, 1}}, false}};
  EXPECT_EQ(rolesAhead(), (std::vector<std::pair<int, int>>{{100, 4}, {300, 3}}));
}

TEST(BakeCamera, TheSkyIsBackgroundAndSoIsBlackWithoutOne) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.floor(white, 3)
      .box(white, {-3, -3, 0}, {-2.9f, 3, 3})
      .sky({0.2f, 0.4f, 0.8f}, {1, 1, 1}, {0.1f, 0.1f, 0.1f});
  const Baked open = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}));
  const double elevation = open.columns.elevationAt(10.5);
  EXPECT_EQ(open.counts.background, open.capture.background.pixelCount());
  const auto up = open.pixelAt(40, 10);
  ASSERT_EQ(up.size(), 1u);
  EXPECT_EQ(up[0].w, 0);
  const float s = float(std::sin(elevation));
  test::expectNear(glm::vec3(up[0].colour), glm::mix(glm::vec3(1), glm::vec3(0.2f, 0.4f, 0.8f), s), 1e-3f);

  const auto black = bakeFrom(builder.rays({Effect::sky}), cameraAt({0, 0}, {square(1)})).pixel(0.01, 0.1);
  ASSERT_EQ(black.size(), 1u);
  EXPECT_EQ(black[0].w, 0);
  EXPECT_EQ(black[0].colour, glm::vec4(0, 0, 0, 1));
}

TEST(BakeCamera, ACameraThatServesNoRegionHasNoSamples) {
  const Baked baked = bakeFrom(room().rays(), cameraAt({0, 0}, {}));
  EXPECT_EQ(baked.capture.sampleCount(), 0u);
  EXPECT_EQ(baked.rays.primary, 0u);
}

TEST(BakeCamera, AgreesWithTheReferencePictureAtTheSameEye) {
  SceneBuilder builder = room();
  Material silver;
  silver.roughness = 0.02f;
  Material glass = matte({0.7f, 0.9f, 0.8f});
  glass.transmission = 0.9f;
  builder.box(builder.material(silver), {3, -1, 0.5f}, {4, 1, 2})
      .quad(builder.material(glass), {2, 2, 0}, {2, -2, 0}, {2, -2, 3}, {2, 2, 3});
  const auto scene = builder.rays();
  BakeSettings settings;
  settings.samplesPerDegree = 1;
  // A tiny served region: everything is seen as from the centre of projection.
  const Baked baked = bakeFrom(scene, cameraAt({0.2, 0.1}, {square(1e-3, {0.2, 0.1})}), settings);
  TaskRunner runner;
  int compared = 0;
  for (int k = 0; k < baked.columns.columns; k += 3)
    for (int r = 0; r < baked.columns.rows; r += 5) {
      PerspectiveView view;
      view.eye = baked.columns.centreOfProjection;
      view.yawRadians = baked.columns.azimuthAt(k + 0.5);
      view.pitchRadians = baked.columns.elevationAt(r + 0.5);
      view.width = view.height = 1;
      view.fovRadians = radians(1);
      const float exposure = 0.05f;
      const TruthFrame truth = renderTruth(*scene, view, settings, exposure, 1, runner);
      glm::vec3 composed(0);
      float passing = 1;
      double opaque = 0;
      for (const auto& s : baked.pixelAt(k, r)) {
        composed += passing * s.colour.a * glm::vec3(s.colour);
        passing *= 1 - s.colour.a;
        opaque = s.w;
        if (s.colour.a == 1) break;
      }
      const Rgba8 expected = truth.colour.at(0, 0), actual = encodeForDisplay(composed, exposure);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(int(actual[c]), int(expected[c]), 1) << "column " << k << " row " << r;
      const double flat = std::cos(view.pitchRadians);
      EXPECT_NEAR(opaque, 1 / (double(truth.rayDistance.at(0, 0)) * flat), baked.capture.distanceStep);
      ++compared;
    }
  EXPECT_GT(compared, 300);
}

TEST(BakeCamera, GivesTheSameBytesForAnyNumberOfThreads) {
  SceneBuilder builder = room();
  builder.sky(glm::vec3(1));
  const LayoutCamera camera = cameraAt({0.3, 0.2}, {square(1), square(2)});
  const Baked one = bakeFrom(builder.rays(), camera);
  for (const int workers : {1, 3}) {
    // Made anew: light once gathered is not gathered again.
    const Baked many = bakeFrom(builder.rays(), camera, {}, workers);
    EXPECT_EQ(many.capture.columnStart, one.capture.columnStart);
    EXPECT_EQ(many.capture.row, one.capture.row);
    EXPECT_EQ(many.capture.inverseDistance, one.capture.inverseDistance);
    EXPECT_EQ(many.capture.colour, one.capture.colour);
    EXPECT_EQ(many.capture.background, one.capture.background);
    EXPECT_EQ(many.rays.primary, one.rays.primary);
    EXPECT_EQ(many.rays.ambient, one.rays.ambient);
  }
}

TEST(BakeCamera, StopsWithinASecondAndReturnsNothing) {
  SceneBuilder builder = room();
  builder.sky(glm::vec3(1));
  BakeSettings slow;
  slow.samplesPerDegree = 64;
  slow.ambientRays = 256;
  const auto scene = builder.rays();
  const LayoutCamera camera = cameraAt({0, 0}, {square(1)});
  const ColumnCamera columns = columnCameraFor(camera, kEyeZ, 1, scene->scene().bounds, slow);
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  TaskRunner runner(1);
  CaptureCounts counts;
  const auto capture = CameraBaker(*scene, slow).bake(camera, columns, runner, counts, stop.get_token());
  stopper.join();
  ASSERT_FALSE(capture.has_value());
  EXPECT_EQ(capture.error().kind, ErrorKind::cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(1));
}

TEST(BakeCamera, RefusesSettingsOutOfRange) {
  const auto scene = room().rays();
  const LayoutCamera camera = cameraAt({0, 0}, {square(1)});
  BakeSettings bad;
  bad.maxLayers = 0;
  TaskRunner runner;
  CaptureCounts counts;
  const auto capture =
      CameraBaker(*scene, bad).bake(camera, columnCameraFor(camera, 1.6, 1, {}, {}), runner, counts);
  ASSERT_FALSE(capture.has_value());
  EXPECT_EQ(capture.error().kind, ErrorKind::invalidArgument);
}

/// A pane that the camera sees at a slant and the regions on either side of it do not.
TEST(BakeCamera, GivesEachRegionTheGlassAsItSeesIt) {
  SceneBuilder builder = room();
  Material glass = matte({0.9f, 0.9f, 0.9f});
  glass.transmission = 1;
  builder.quad(builder.material(glass), {3, 0.8f, 0}, {5, 0.8f, 0}, {5, 0.8f, 3}, {3, 0.8f, 3});
  const RayScenePtr scene = builder.rays();
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  const ConvexPolygon near = square(0.4, {0, 0.2}), far = square(0.4, {0, -3});
  const Baked both = bakeAsSet(scene, cameraAt({0, 0}, {near, far}), settings);
  const auto paneOf = [&](const Baked& baked, int roles) {
    std::vector<Baked::Sample> panes;
    for (const auto& sample : baked.pixel(std::atan2(0.8, 4.0), 0))
      if (sample.colour.a < 1 && (sample.roles & roles) != 0) panes.push_back(sample);
    return panes;
  };
  ASSERT_EQ(paneOf(both, 3).size(), 2u);
  ASSERT_EQ(paneOf(both, 1).size(), 1u);
  const auto alone = [&](const ConvexPolygon& region) {
    return paneOf(bakeAsSet(scene, cameraAt({0, 0}, {region}), settings), 1).at(0);
  };
  const Baked::Sample asNear = alone(near), asFar = alone(far);
  EXPECT_EQ(paneOf(both, 1)[0].colour, asNear.colour);
  EXPECT_EQ(paneOf(both, 2)[0].colour, asFar.colour);
  EXPECT_GT(asNear.colour.a, asFar.colour.a + 0.2) << "glass hides more at a slant";
  // Matte surfaces look the same from everywhere.
  for (const auto& sample : both.pixel(radians(-20.0), 0)) EXPECT_EQ(sample.roles, 3);
  // And so does the pane to regions that see it alike.
  const Baked alike = bakeAsSet(scene, cameraAt({0, 0}, {near, square(0.4, {0.1, 0.2})}), settings);
  EXPECT_EQ(paneOf(alike, 3).size(), 1u);
}

}  // namespace
}  // namespace acentric
