#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "engine/bake/bake.h"
#include "engine/bake/eye_views.h"
#include "engine/bake/truth.h"
#include "engine/image/colour.h"
#include "layout_builder.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::cameraAt;
using test::matte;
using test::SceneBuilder;
using test::square;

constexpr double kEyeZ = 1.6;

struct Baked {
  ColumnCamera columns;
  Capture capture;
  RayCounts rays;
  SampleCounts counts;

  struct Sample {
    double w;
    glm::vec4 colour;
    int roles;
  };
  /// Samples of the pixel that looks in a direction, nearest first, and last, without distance, the
  /// background.
  std::vector<Sample> pixel(double azimuth, double elevation) const {
    const int k = int((azimuth - columns.lowAzimuth) / columns.columnPitch());
    const int r = int((columns.topElevation - elevation) / columns.rowPitch());
    return pixelAt(k, r);
  }
  std::vector<Sample> pixelAt(int k, int r) const {
    std::vector<Sample> samples;
    for (auto i = capture.columnStart[std::size_t(k)]; i < capture.columnStart[std::size_t(k) + 1]; ++i)
      if (capture.row[i] == r)
        samples.push_back(
            {double(capture.inverseDistance[i]), unpackColour(capture.colour[i]), capture.roles[i]});
    const CaptureBackground& runs = capture.background;
    if (runs.runCount() == 0) return samples;
    for (auto i = runs.columnStart[std::size_t(k)]; i < runs.columnStart[std::size_t(k) + 1]; ++i)
      if (runs.firstRow[i] <= r && r < runs.endRow[i]) {
        const glm::dvec3 direction(columns.directionAt(k + 0.5), columns.tangentAt(r + 0.5));
        samples.push_back(
            {0, glm::vec4(runs.sky.radiance(glm::vec3(glm::normalize(direction))), 1), runs.roles[i]});
      }
    return samples;
  }
};

Baked bakeFrom(const RayScenePtr& scene, const LayoutCamera& camera, BakeSettings settings = {},
               int workers = 0) {
  if (settings == BakeSettings{})
    settings.samplesPerDegree = 2, settings.ambientRays = 12, settings.surfaceTexel = 0.2;
  Baked out;
  out.columns = columnCameraFor(camera, kEyeZ, 1, scene->scene().bounds, settings);
  TaskRunner runner(workers);
  CaptureCounts counts;
  auto capture = CameraBaker(*scene, settings).bake(camera, out.columns, runner, counts);
  out.rays = counts.rays;
  out.counts = counts.samples;
  EXPECT_TRUE(capture.has_value()) << (capture ? "" : capture.error().describe());
  if (!capture) return out;
  EXPECT_TRUE(capture->check().has_value()) << capture->check().error().describe();
  out.capture = std::move(*capture);
  return out;
}

/// A room whose wall in front is at x = 6, lit by a lamp.
SceneBuilder room() {
  SceneBuilder builder;
  builder.box(builder.material(matte({0.8f, 0.7f, 0.6f})), {-6, -5, 0}, {6, 5, 3}, true)
      .point({0, 0, 2.5f}, 100);
  return builder;
}

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

BakeSettings firstOnly() {
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  settings.maxLayers = 1;
  return settings;
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

/// A room with a screen of some half width before its far wall, and what the pixel straight ahead holds.
std::vector<int> behindScreen(float halfWidth, BakeSettings settings, SampleCounts* counts = nullptr) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  builder.quad(white, {3, halfWidth, 0}, {3, -halfWidth, 0}, {3, -halfWidth, 3}, {3, halfWidth, 3});
  settings.samplesPerDegree = 2;
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), settings);
  if (counts != nullptr) *counts = baked.counts;
  std::vector<int> decimetres;
  for (const auto& s : baked.pixel(0.01, 0.01))
    if (s.w > 0) decimetres.push_back(int(std::lround(10 / s.w)));
  return decimetres;
}

TEST(BakeCamera, KeepsWhatSomeEyeOfTheRegionSeesBehindTheFirstSurface) {
  // The wall at (6, 0.06) is seen past a screen at x = 3 from the corner (1, 1) where the screen reaches less
  // far than y = 1 - 0.94 * 2 / 5 = 0.624.
  EXPECT_EQ(behindScreen(0.6f, {}), (std::vector{30, 60}));
  EXPECT_EQ(behindScreen(0.65f, {}), (std::vector{30}));
  EXPECT_EQ(behindScreen(0.6f, firstOnly()), (std::vector{30}));
  BakeSettings all;
  all.pruning = false;
  SampleCounts counts;
  EXPECT_EQ(behindScreen(0.65f, all, &counts), (std::vector{30, 60}));
  EXPECT_EQ(counts.hidden, 0u);
  behindScreen(0.65f, {}, &counts);
  EXPECT_GT(counts.hidden, 0u);
  EXPECT_GT(counts.kept[0], 5 * counts.kept[1]);
  EXPECT_GT(counts.kept[1], 0u);
}

/// The back of a panel passes for its front before the test eyes' maps, and would show in its cracks.
TEST(BakeCamera, DropsWhatLiesRightBehindAnOpaqueSurface) {
  SceneBuilder builder = room();
  builder.box(builder.material(matte()), {4, -1, 0.5f}, {4.004f, 1, 2});
  const LayoutCamera camera = cameraAt({0.5, 0.2}, {square(1), square(2)});
  const Baked baked = bakeFrom(builder.rays(), camera);
  std::size_t thin = 0, deep = 0;
  for (int k = 0; k < baked.columns.columns; ++k)
    for (int r = 0; r < baked.columns.rows; ++r) {
      const auto samples = baked.pixelAt(k, r);
      for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i].roles & samples[i - 1].roles) {
          EXPECT_GT(1 - samples[i].w / samples[i - 1].w, 2e-3) << k << " " << r;
          ++deep;
        }
      const double x = samples.empty() ? 0 : 0.5 + baked.columns.directionAt(k + 0.5).x / samples[0].w;
      thin += std::abs(x - 4) < 0.01;
    }
  EXPECT_GT(thin, 50u) << "the panel's front";
  EXPECT_GT(deep, 50u) << "the wall behind it, seen from beside the camera";
}

/// The camera's ray leaves a box through a side that it only sees from within, and the region from without.
TEST(BakeCamera, ShadesTheSideThatIsSeenAndNotTheOneTheCameraLooksAt) {
  SceneBuilder builder;
  const glm::vec3 falling = glm::normalize(glm::vec3(0, -1, -0.3f));  // on the side that faces +y alone
  builder.box(builder.material(matte()), {4, -1, 0}, {5, 1, 3}).sun(falling, 10).sky(glm::vec3(1e-6f));
  const auto scene = builder.rays();
  const auto sideAhead = [&](const BakeSettings& settings) {
    for (const auto& sample : bakeFrom(scene, cameraAt({0, 0}, {square(2)}), settings).pixel(1 / 4.5, 0.01))
      if (std::abs(1 / sample.w - std::hypot(4.5, 1.0)) < 0.2) return sample.colour.r;
    return -1.0f;
  };
  EXPECT_NEAR(sideAhead({}), 10 * -falling.y / kPi, 0.02);
  BakeSettings unpruned;
  unpruned.pruning = false;
  EXPECT_LT(sideAhead(unpruned), 1e-3) << "nobody is asked who sees it";
}

/// A sheet of metal, 5 mm thick, that the camera's rays cross at a slant. Its far side, met from within, lies
/// so near behind the other that eyes on this side take both for one place; what those on the far side see is
/// not its dark inside.
TEST(BakeCamera, KeepsNoInnerSideOfAThinBody) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {3, 0.5, 0}, {7, 0.505f, 3}).sky(glm::vec3(1));
  const auto scene = builder.rays();
  const Baked baked = bakeFrom(scene, cameraAt({0, 0}, {square(2)}));
  int far = 0;
  for (const double x : {4.0, 4.5, 5.0, 5.5, 6.0})
    for (const auto& sample : baked.pixel(0.5025 / x, 0.01)) {
      if (sample.w == 0) continue;
      EXPECT_GT(sample.colour.r, 0.1f) << "at " << 1 / sample.w << " m, by " << x;
      ++far;
    }
  EXPECT_GE(far, 8) << "both sides are seen";
}

TEST(BakeCamera, DropsAFirstSurfaceThatNoRegionSees) {
  // The camera stands outside its region, in the next room.
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.box(white, {-6, -5, 0}, {2, 5, 3}, true).box(white, {2.1f, -5, 0}, {8, 5, 3}, true);
  const auto samples = [&](double x) {
    return bakeFrom(builder.rays(), cameraAt({x, 0}, {square(0.5)})).pixel(0.01, 0.01);
  };
  ASSERT_EQ(samples(0).size(), 1u);
  EXPECT_NEAR(1 / samples(0)[0].w, 2, 0.01) << "only the wall of the eye's own room";
  EXPECT_TRUE(samples(3).empty()) << "the wall at x = 8 is in a room that no eye of the region sees";
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

TEST(BakeCamera, PrunesAsIfEverySurfaceWereTracedFromEveryTestEye) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-4.5f, 4.5f), size(0.05f, 0.6f), height(0.2f, 2.6f);
  for (int n = 0; n < 40; ++n) {
    const glm::vec3 at(place(random) + 1, place(random), 0), half(size(random), size(random), height(random));
    builder.box(white, at - glm::vec3(half.x, half.y, 0), at + half);
  }
  const auto scene = builder.rays();
  LayoutCamera camera = cameraAt({-1, -0.5}, {square(1), square(0.7, {-1.7, 0})});
  camera.fovRadians = radians(20);
  BakeSettings settings;
  settings.maxLayers = 64;
  const Baked pruned = bakeFrom(scene, camera, settings);
  settings.pruning = false;
  const Baked all = bakeFrom(scene, camera, settings);
  settings.pruning = true;
  std::size_t deep = 0, missing = 0, superfluous = 0, compared = 0;
  for (int k = 0; k < all.columns.columns; k += 2)
    for (int r = 0; r < all.columns.rows; r += 2) {
      const glm::dvec3 direction(all.columns.directionAt(k + 0.5), all.columns.tangentAt(r + 0.5));
      const auto kept = pruned.pixelAt(k, r);
      for (const auto& surface : all.pixelAt(k, r)) {
        if (surface.w == 0) continue;
        const glm::dvec3 point = all.columns.centreOfProjection + direction / surface.w;
        int roles = 0, perhaps = 0;  // surely, and with what is behind another surface by a hair
        for (std::size_t role = 0; role < camera.roles.size(); ++role)
          for (const glm::dvec3& eye : testEyes(camera.roles[role].polygon, kEyeZ, settings)) {
            const glm::dvec3 way = point - eye;
            const double distance = glm::length(way);
            const double open =
                double(scene->occluderDistance({glm::vec3(eye), glm::vec3(way / distance)})) / distance;
            if (open > 1 - 1e-4) roles |= 1 << role;
            if (open > 1 - 2e-2) perhaps |= 1 << role;
          }
        roles &= surface.roles, perhaps &= surface.roles;
        const auto same = std::ranges::find(kept, surface.w, &Baked::Sample::w);
        const int found = same == kept.end() ? 0 : same->roles;
        missing += (roles & ~found) != 0 ? 1 : 0;
        superfluous += (found & ~perhaps) != 0 ? 1 : 0;
        deep += same != kept.end() && same != kept.begin() ? 1 : 0;
        ++compared;
      }
    }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(deep, 300u);
  EXPECT_LE(missing, compared / 200) << "of " << compared << ", through gaps finer than the map";
  EXPECT_LE(superfluous, compared / 100) << "behind things finer than the map";
}

TEST(BakeCamera, GlassInFrontGivesABlendedSampleAndWhatIsBehind) {
  SceneBuilder builder = room();
  Material glass = matte();
  glass.transmission = 1;
  builder.quad(builder.material(glass), {3, 2, 0}, {3, -2, 0}, {3, -2, 3}, {3, 2, 3});
  const auto pixel = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)})).pixel(0.01, 0.01);
  ASSERT_EQ(pixel.size(), 2u);
  EXPECT_NEAR(pixel[0].w, 1.0 / 3, 5e-4);
  EXPECT_NEAR(pixel[0].colour.a, 0.12, 0.01);
  EXPECT_NEAR(pixel[1].w, 1.0 / 6, 5e-4);
  EXPECT_EQ(pixel[1].colour.a, 1);
  // Glass within the region is local geometry.
  EXPECT_EQ(bakeFrom(builder.rays(), cameraAt({0, 0}, {square(4)})).pixel(0.01, 0.01).size(), 1u);
  // With transmission off it is a wall.
  const auto wall =
      bakeFrom(builder.rays({Effect::transmission}), cameraAt({0, 0}, {square(1)})).pixel(0.01, 0.01);
  ASSERT_EQ(wall.size(), 1u);
  EXPECT_NEAR(wall[0].w, 1.0 / 3, 5e-4);
}

TEST(BakeCamera, MoreLayersThanAllowedKeepTheNearestAndEndOnAnOpaqueOne) {
  SceneBuilder builder = room();
  Material film = matte();
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.5f;
  const int m = builder.material(film);
  for (const float x : {1.5f, 2.0f, 2.5f, 3.0f, 3.5f})
    builder.quad(m, {x, 2, 0}, {x, -2, 0}, {x, -2, 3}, {x, 2, 3});
  BakeSettings settings;
  settings.samplesPerDegree = 1;
  settings.maxLayers = 3;
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), settings);
  EXPECT_EQ(baked.capture.maxLayers(), 3);
  const auto pixel = baked.pixel(0.01, 0.01);
  ASSERT_EQ(pixel.size(), 3u);
  EXPECT_NEAR(1 / pixel[0].w, 1.5, 0.01);
  EXPECT_NEAR(1 / pixel[1].w, 2.0, 0.01);
  EXPECT_NEAR(1 / pixel[2].w, 6.0, 0.02);
  EXPECT_EQ(pixel[2].colour.a, 1);
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

/// A pixel may have all the samples that it can, and the sky be seen past them.
TEST(BakeCamera, KeepsTheBackgroundThatIsSeenBehindTheLastLayer) {
  const auto showsSky = [](float halfWidth) {
    SceneBuilder builder;
    const int white = builder.material(matte());
    builder.sky(glm::vec3(1)).floor(white, 10);
    for (const float x : {3.0f, 3.5f})
      builder.quad(white, {x, halfWidth, 0}, {x, -halfWidth, 0}, {x, -halfWidth, 9}, {x, halfWidth, 9});
    const auto pixel = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), firstOnly()).pixel(0.01, 0.3);
    return std::ranges::any_of(pixel, [](const Baked::Sample& s) { return s.w == 0; });
  };
  EXPECT_TRUE(showsSky(0.6f)) << "from the corner (1, 1)";
  EXPECT_FALSE(showsSky(4)) << "nobody sees past the screens";
}

/// Seen through a window the sky fills other directions from each place. The reference traces rays from eyes
/// that no bake asks.
TEST(BakeCamera, KeepsTheSkyThatAnyEyeOfTheRegionSeesThroughAHighWindow) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.sky(glm::vec3(1)).floor(white, 6);
  builder.quad(white, {-6, -6, 4}, {-6, 6, 4}, {6, 6, 4}, {6, -6, 4});
  for (const float y : {-6.0f, 6.0f}) builder.quad(white, {-6, y, 0}, {6, y, 0}, {6, y, 4}, {-6, y, 4});
  const auto wall = [&](float y0, float y1, float z0, float z1) {
    builder.quad(white, {6, y0, z0}, {6, y1, z0}, {6, y1, z1}, {6, y0, z1});
  };
  wall(-6, 6, 0, 3), wall(-6, 6, 3.5f, 4), wall(-6, -0.5f, 3, 3.5f), wall(0.5f, 6, 3, 3.5f);
  for (const float y : {-0.25f, 0.0f, 0.25f}) wall(y - 0.02f, y + 0.02f, 3, 3.5f);  // its bars
  const auto scene = builder.rays();
  const Baked baked = bakeFrom(scene, cameraAt({2, 0}, {square(2)}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2, 2), height(-0.15, 0.15), window(-0.5, 0.5);
  const auto seesSky = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
    return std::isinf(scene->occluderDistance({glm::vec3(eye), glm::vec3(direction)}));
  };
  int seen = 0, missing = 0;
  while (seen < 3000) {
    const glm::dvec3 eye(place(random), place(random), kEyeZ + height(random));
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(6, window(random), 3.25 + 0.5 * window(random)) - eye);
    const double azimuth = std::atan2(direction.y, direction.x);
    if (std::abs(azimuth) > radians(29) || !seesSky(eye, direction)) continue;
    ++seen;
    const auto pixel = baked.pixel(azimuth, std::asin(direction.z));
    missing += std::ranges::any_of(pixel, [](const Baked::Sample& s) { return s.w == 0; }) ? 0 : 1;
  }
  EXPECT_LE(missing, seen / 25) << "of " << seen << "; half of them with the test eyes alone";
  // Nothing but what an eye sees, there or less than two texels of the eyes' maps beside.
  const double texel = radians(1);
  for (int k = 0; k < baked.columns.columns; k += 3)
    for (int r = 0; r < baked.columns.rows; r += 3) {
      const auto pixel = baked.pixelAt(k, r);
      if (std::ranges::none_of(pixel, [](const Baked::Sample& s) { return s.w == 0; })) continue;
      const double elevation = baked.columns.elevationAt(r + 0.5), azimuth = baked.columns.azimuthAt(k + 0.5);
      bool found = false;
      for (double x = -2; x <= 2; x += 0.1)
        for (double y = -2; y <= 2; y += 0.1) {
          // Where the direction from there meets the wall.
          const double along = (6 - x) / std::cos(azimuth), slack = 2 * texel * along;
          const double atY = y + along * std::sin(azimuth), atZ = kEyeZ + along * std::tan(elevation);
          found = found || (std::abs(atY) < 0.5 + slack && std::abs(atZ - 3.25) < 0.25 + 0.15 + slack);
        }
      ASSERT_TRUE(found) << "column " << k << " row " << r;
    }
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

}  // namespace
}  // namespace acentric
