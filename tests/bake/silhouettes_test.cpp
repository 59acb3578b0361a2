#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "baked_camera.h"
#include "engine/bake/shading.h"

namespace acentric {
namespace {

using test::bakeAsSet;
using test::Baked;
using test::cameraAt;
using test::matte;
using test::SceneBuilder;
using test::square;

BakeSettings withSilhouettes() {
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  settings.silhouettes = true;
  settings.pruning = false;
  settings.distanceShift = 0;
  return settings;
}

/// A block before a wall far away.
SceneBuilder blockBeforeWall() {
  SceneBuilder builder;
  const int grey = builder.material(matte({0.5f, 0.5f, 0.5f}));
  builder.box(grey, {20, -40, -30}, {60, 40, 30});
  builder.box(grey, {5, -0.31f, 1.07f}, {8, 0.23f, 2.11f});
  return builder;
}

/// And a post that is thinner than a sample.
SceneBuilder postBeforeWall() {
  SceneBuilder builder = blockBeforeWall();
  builder.box(0, {7, 1.03f, 0}, {7.01f, 1.06f, 3});
  return builder;
}

/// Of the surfaces that a ray through a part of a pixel meets, one by one.
struct Surfaces {
  int all = 0;
  int apart = 0;  ///< but those that no served eye can tell from the one before
};
Surfaces surfacesAlong(const RayScene& scene, const ColumnCamera& camera, const glm::vec3& direction) {
  constexpr double kReach = 0.75;  // of the camera's region, m
  const double indistinct = camera.rowPitch() / kReach;
  Surfaces surfaces;
  double before = 1e9;
  Ray ray{glm::vec3(camera.centreOfProjection), direction};
  for (Hit hit = scene.trace(ray); hit.found(); hit = scene.trace(ray)) {
    const double inverse = 1 / double(hit.distance);
    ++surfaces.all;
    surfaces.apart += before - inverse > indistinct;
    before = inverse;
    ray.nearest = justBehind(hit.distance);
  }
  return surfaces;
}

/// Samples of a pixel that cover a part.
int covering(const Capture& capture, int column, int row, int part) {
  int count = 0;
  for (auto i = capture.columnStart[std::size_t(column)]; i < capture.columnStart[std::size_t(column) + 1];
       ++i)
    if (capture.row[i] == row) count += capture.coverage[i] >> part & 1;
  return count;
}

/// Unit.
glm::vec3 directionThrough(const ColumnCamera& camera, int column, int row, int part) {
  const glm::dvec2 across = camera.directionAt(column + (part % 4 + 0.5) / 4);
  return glm::vec3(glm::normalize(glm::dvec3(across, camera.tangentAt(row + (double(part / 4) + 0.5) / 4))));
}

/// Calls `visit` with column, row and part of all pixels but the outermost that look about straight ahead,
/// the part's direction, and what it meets.
template <class Visit>
void forPartsAhead(const RayScene& scene, const ColumnCamera& camera, const Visit& visit) {
  for (int column = 1; column + 1 < camera.columns; ++column)
    for (int row = 1; row + 1 < camera.rows; ++row)
      for (int part = 0; part < 16; ++part) {
        const glm::vec3 way = directionThrough(camera, column, row, part);
        if (std::abs(way.y / way.x) > 0.3f || std::abs(way.z / way.x) > 0.3f) continue;
        visit(column, row, part, way, scene.trace({glm::vec3(camera.centreOfProjection), way}));
      }
}

TEST(Silhouettes, CoverTheVeryPartsWhereRaysMeetTheSurface) {
  const auto scene = blockBeforeWall().rays();
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), withSilhouettes());
  const ColumnCamera& camera = baked.columns;
  ASSERT_TRUE(baked.capture.hasSilhouettes());
  int edges = 0, missing = 0, over = 0, parts = 0;
  for (int column = 1; column + 1 < camera.columns; ++column)
    for (int row = 1; row + 1 < camera.rows; ++row) {
      bool whole = true;
      const int first = covering(baked.capture, column, row, 0);
      for (int part = 0; part < 16; ++part) {
        const Surfaces met = surfacesAlong(*scene, camera, directionThrough(camera, column, row, part));
        const int covered = covering(baked.capture, column, row, part);
        whole = whole && covered == first;
        missing += covered < met.apart;
        over += covered > met.all;  // surfaces overlap a little at the edge where they meet
        ++parts;
      }
      edges += !whole;
    }
  EXPECT_GT(edges, 40);
  EXPECT_LE(missing, edges / 20);
  EXPECT_LE(over, parts / 500);
}

/// A board closer before a wall than curved surfaces may leave their planes covers itself alone, and does not
/// spread to where the wall is seen beside it.
TEST(Silhouettes, OfMouldingsEndWhereTheWallBehindBegins) {
  SceneBuilder builder;
  const int grey = builder.material(matte({0.5f, 0.5f, 0.5f}));
  builder.quad(grey, {12, 40, -30}, {12, -40, -30}, {12, -40, 30}, {12, 40, 30});
  builder.quad(grey, {11.2f, 0.93f, 1.07f}, {11.2f, -0.71f, 1.07f}, {11.2f, -0.71f, 2.91f},
               {11.2f, 0.93f, 2.91f});
  const auto scene = builder.rays();
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), withSilhouettes());
  int wrong = 0, onBoard = 0;
  forPartsAhead(*scene, baked.columns, [&](int column, int row, int part, const glm::vec3&, const Hit& met) {
    const bool board = met.mesh == 1;
    onBoard += board;
    wrong += covering(baked.capture, column, row, part) != (board ? 2 : 1);
  });
  EXPECT_GT(onBoard, 3000);
  EXPECT_LE(wrong, onBoard / 500);
}

/// A pane and its bar lie in one plane: neither covers the other.
TEST(Silhouettes, OfBarsEndWhereThePanesBesideThemBegin) {
  SceneBuilder builder;
  Material glass = matte({0.9f, 0.9f, 0.9f});
  glass.transmission = 1;
  const int grey = builder.material(matte({0.5f, 0.5f, 0.5f})), clear = builder.material(glass);
  builder.box(grey, {30, -60, -60}, {60, 60, 60});
  builder.quad(grey, {5, 0.033f, -10}, {5, -0.041f, -10}, {5, -0.041f, 10}, {5, 0.033f, 10});
  builder.quad(clear, {5, 3, -10}, {5, 0.033f, -10}, {5, 0.033f, 10}, {5, 3, 10});
  const auto scene = builder.rays();
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), withSilhouettes());
  const ColumnCamera& camera = baked.columns;
  int wrong = 0, parts = 0;
  for (int column = 0; column < camera.columns; ++column)
    for (auto i = baked.capture.columnStart[std::size_t(column)];
         i < baked.capture.columnStart[std::size_t(column) + 1]; ++i) {
      if (1 / baked.capture.inverseDistance[i] > 6) continue;
      const bool opaque = unpackColour(baked.capture.colour[i]).a >= 1;
      for (int part = 0; part < 16; ++part) {
        if ((baked.capture.coverage[i] >> part & 1) == 0) continue;
        const glm::dvec2 across = camera.directionAt(column + (part % 4 + 0.5) / 4);
        const bool onBar = 5 * across.y / across.x < 0.033;
        ++parts;
        wrong += opaque != onBar;
      }
    }
  EXPECT_GT(parts, 5000);
  EXPECT_EQ(wrong, 0);
}

TEST(Silhouettes, ClearSamplesHaveFewOpacitiesAndKeepTheirLight) {
  SceneBuilder builder;
  Material glass = matte({0.9f, 0.7f, 0.9f});
  glass.transmission = 1;
  builder.box(builder.material(matte({0.5f, 0.5f, 0.5f})), {30, -60, -60}, {60, 60, 60});
  builder.quad(builder.material(glass), {5, 30, -30}, {5, -30, -30}, {5, -30, 30}, {5, 30, 30});
  BakeSettings settings = withSilhouettes();
  const auto scene = builder.rays();
  const Baked rounded = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), settings);
  settings.silhouettes = false;
  const Baked exact = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), settings);
  int compared = 0;
  for (int column = 0; column < exact.columns.columns; ++column) {
    const auto clearOf = [&](const Baked& baked) {
      std::map<int, glm::vec4> byRow;
      for (auto i = baked.capture.columnStart[std::size_t(column)];
           i < baked.capture.columnStart[std::size_t(column) + 1]; ++i)
        if (const glm::vec4 c = unpackColour(baked.capture.colour[i]); c.a < 1)
          byRow[baked.capture.row[i]] = c;
      return byRow;
    };
    const auto a = clearOf(rounded);
    for (const auto& [row, b] : clearOf(exact)) {
      const auto at = a.find(row);
      ASSERT_NE(at, a.end());
      ++compared;
      ASSERT_EQ(128 * at->second.a, std::round(128 * at->second.a));
      ASSERT_NEAR(at->second.a, b.a, 1 / 256.0 + 1e-6);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(at->second.a * at->second[k], b.a * b[k], 0.002f * b.a * b[k]);
    }
  }
  EXPECT_GT(compared, 5000);
}

/// Shadows of slats overhead, on the floor: half of them on half a sample.
SceneBuilder stripedFloor() {
  SceneBuilder builder;
  builder.floor(builder.material(matte({0.7f, 0.7f, 0.7f})), 20).sun({0, 0, -1}, 3);
  for (float x = -6; x < 6; x += 0.3f) builder.box(0, {x, -6, 8}, {x + 0.15f, 6, 8.1f});
  return builder;
}

TEST(Silhouettes, ColoursAreMeansOverWhatASampleCoversWhereItsLightChanges) {
  const auto scene = stripedFloor().rays();
  BakeSettings settings = withSilhouettes();
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), settings);
  const ColumnCamera& camera = baked.columns;
  const Shader shader(*scene, settings);
  RayCounts rays;
  const auto look = [&](double column, double row) {
    const glm::dvec3 way(camera.directionAt(column), camera.tangentAt(row));
    const Ray ray{glm::vec3(camera.centreOfProjection), glm::vec3(glm::normalize(way))};
    return shader.shade(scene->trace(ray), -ray.direction, rays).radiance().g;
  };
  double squares = 0, squaresOfOneRay = 0;
  int changing = 0;
  for (int column = 0; column < camera.columns; ++column)
    for (int row = 0; row < camera.rows; ++row) {
      if (camera.tangentAt(row + 0.5) > -0.3) continue;
      const auto samples = baked.pixelAt(column, row);
      ASSERT_GE(samples.size(), 1u);
      constexpr int kGrid = 12;
      float sum = 0, least = HUGE_VALF, most = 0;
      for (int i = 0; i < kGrid * kGrid; ++i) {
        const float seen = look(column + (i % kGrid + 0.5) / kGrid, row + (double(i / kGrid) + 0.5) / kGrid);
        sum += seen, least = std::min(least, seen), most = std::max(most, seen);
      }
      const float mean = sum / (kGrid * kGrid), own = look(column + 0.5, row + 0.5);
      if (most < 1.01f * least) {
        ASSERT_NEAR(samples[0].colour.g, own, 2e-3f * own);
        continue;
      }
      ++changing;
      squares += double(samples[0].colour.g - mean) * double(samples[0].colour.g - mean);
      squaresOfOneRay += double(own - mean) * double(own - mean);
    }
  EXPECT_GT(changing, 1000);
  EXPECT_LT(squares, 0.2 * squaresOfOneRay);
}

TEST(Silhouettes, PlanesTellHowFarTheSamplesAre) {
  const Baked baked = bakeAsSet(postBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), withSilhouettes());
  const Capture& capture = baked.capture;
  for (int column = 0; column < baked.columns.columns; ++column)
    for (auto i = capture.columnStart[std::size_t(column)]; i < capture.columnStart[std::size_t(column) + 1];
         ++i) {
      if (capture.coverage[i] != kWholePixel) continue;
      const double w = capture.planes[capture.plane[i]].inverseDistance(
          baked.columns.directionAt(column + 0.5), baked.columns.tangentAt(capture.row[i] + 0.5));
      ASSERT_NEAR(w, capture.inverseDistance[i], 2e-4) << "column " << column << ", row " << capture.row[i];
    }
}

TEST(Silhouettes, KeepEachPlaneOnceInTheOrderInWhichSamplesMeetThem) {
  const Capture capture =
      bakeAsSet(blockBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), withSilhouettes()).capture;
  std::uint32_t next = 0;
  for (const std::uint32_t plane : capture.plane) {
    ASSERT_LE(plane, next);
    if (plane == next) ++next;
  }
  EXPECT_EQ(next, capture.planes.size());
  EXPECT_LE(capture.planes.size(), 12u) << "of two boxes";
  for (std::size_t i = 0; i < capture.planes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(capture.planes[i], capture.planes[k]);
}

TEST(Silhouettes, OfAnEndlessWallTakeNoRays) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {4, -90, -90}, {4.5f, 90, 90});
  const auto scene = builder.rays();
  BakeSettings settings = withSilhouettes();
  const Baked with = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), settings);
  settings.silhouettes = false;
  const Baked without = bakeAsSet(scene, cameraAt({0, 0}, {square(0.5)}), settings);
  EXPECT_EQ(with.rays.primary, without.rays.primary);
  EXPECT_EQ(with.capture.sampleCount(), without.capture.sampleCount());
  EXPECT_FALSE(without.capture.hasSilhouettes());
  EXPECT_TRUE(without.capture.planes.empty());
}

TEST(Silhouettes, OfAPostReachIntoPixelsWhoseOwnRayPassesIt) {
  const Baked with = bakeAsSet(postBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), withSilhouettes());
  BakeSettings settings = withSilhouettes();
  settings.silhouettes = false;
  const Baked without = bakeAsSet(postBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), settings);
  EXPECT_GT(with.capture.sampleCount(), without.capture.sampleCount());
  EXPECT_EQ(with.counts.keptInAll(), with.capture.sampleCount());
}

TEST(Silhouettes, EndWhereNoServedRegionSeesTheSurface) {
  SceneBuilder builder;
  const int grey = builder.material(matte({0.5f, 0.5f, 0.5f}));
  builder.box(grey, {6, -40, -30}, {6.5f, 40, 30});
  builder.box(grey, {2, -40, -30}, {2.1f, 0.013f, 30});  // hides the wall from its edge on, from everywhere
  const auto scene = builder.rays();
  BakeSettings settings = withSilhouettes();
  settings.pruning = true;
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.3)}), settings);
  // Far behind the screen nothing of the wall is kept, in no part of a pixel.
  const int column = int(radians(5.0) / baked.columns.columnPitch());
  const int row = baked.columns.rows / 2;
  for (int part = 0; part < 16; ++part) EXPECT_LE(covering(baked.capture, column, row, part), 1);
  int partly = 0;
  for (const std::uint16_t mask : baked.capture.coverage) partly += mask != kWholePixel;
  EXPECT_GT(partly, 0);
}

/// A board hides the wall behind it, of which eyes to its right see more there than those straight before it:
/// a pixel whose own ray meets the wall where only they see it is needed by all, where the board leaves it
/// open.
TEST(Silhouettes, OfAWallReachToTheBoardForAllWhoSeeIt) {
  SceneBuilder builder;
  const int grey = builder.material(matte({0.5f, 0.5f, 0.5f}));
  builder.quad(grey, {6, 40, -30}, {6, -40, -30}, {6, -40, 30}, {6, 40, 30});
  builder.quad(grey, {5.5f, 1.3f, 0.2f}, {5.5f, -1.1f, 0.2f}, {5.5f, -0.7f, 2.9f}, {5.5f, 0.8f, 2.9f});
  const auto scene = builder.rays();
  BakeSettings settings = withSilhouettes();
  settings.pruning = true;
  const Baked baked = bakeAsSet(scene, cameraAt({0, 0}, {square(0.02), square(0.3, {0, -1.2})}), settings);
  const Capture& capture = baked.capture;
  std::array<int, 2> seen{}, missing{};
  forPartsAhead(*scene, baked.columns,
                [&](int column, int row, int part, const glm::vec3& way, const Hit& met) {
                  if (met.mesh != 0) return;
                  int roles = 0;
                  for (auto i = capture.columnStart[std::size_t(column)];
                       i < capture.columnStart[std::size_t(column) + 1]; ++i)
                    if (capture.row[i] == row && (capture.coverage[i] >> part & 1) != 0)
                      roles |= capture.roles[i];
                  const glm::vec3 point = glm::vec3(baked.columns.centreOfProjection) + met.distance * way;
                  for (std::size_t role = 0; role < 2; ++role) {
                    const glm::vec3 eye(0, role == 0 ? 0.0f : -1.2f, test::kEyeZ);
                    if (scene->trace({eye, glm::normalize(point - eye)}).mesh != 0) continue;
                    ++seen[role];
                    missing[role] += (roles >> role & 1) == 0;
                  }
                });
  for (std::size_t role = 0; role < 2; ++role) {
    EXPECT_GT(seen[role], 20000);
    EXPECT_LE(missing[role], seen[role] / 1000);
  }
}

TEST(Silhouettes, AreTheSameForAnyNumberOfThreads) {
  const auto scene = postBeforeWall().rays();
  const LayoutCamera camera = cameraAt({0, 0}, {square(0.5)});
  EXPECT_EQ(bakeAsSet(scene, camera, withSilhouettes(), 0).capture,
            bakeAsSet(scene, camera, withSilhouettes(), 3).capture);
}

}  // namespace
}  // namespace acentric
