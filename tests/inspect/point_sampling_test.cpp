#include "engine/inspect/point_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/inspect/sampling_rate.h"
#include "tests/inspect/little_world.h"

namespace acentric {
namespace {

using test::emptyRoom;
using test::furnishedRoom;
using test::World;

SurfacePoint pointOn(const glm::dvec3& place, const glm::dvec3& normal) { return {place, normal, 0, 0}; }

TEST(PointSampling, TellsDistanceAngleAndRatesAsWorkedOutByHand) {
  const World world(emptyRoom(), Configuration::b);
  const CaptureReach reach = world.reach();
  const SurfaceJudge judge(reach, {});
  const glm::dvec3 place(9, 0.4, 2.1);
  const PointSampling sampling = samplingOfPoint(reach, judge, pointOn(place, {-1, 0, 0}));
  ASSERT_FALSE(sampling.cameras.empty());
  ASSERT_TRUE(sampling.eye.has_value());
  for (const CameraSampling& camera : sampling.cameras) {
    const ColumnCamera& columns = world.columns[std::size_t(camera.camera)];
    const glm::dvec3 offset = place - columns.centreOfProjection;
    EXPECT_NEAR(camera.distance, glm::length(offset), 1e-9);
    EXPECT_NEAR(camera.angle, std::acos(offset.x / glm::length(offset)), 1e-9);
    EXPECT_TRUE(camera.held);
    EXPECT_FALSE(camera.hidden);
    // Steps along y and z on the wall x = 9, in columns and rows per metre.
    const double flat = std::hypot(offset.x, offset.y), square = glm::dot(offset, offset);
    const glm::dmat2 steps{{offset.x / (flat * flat) / columns.columnPitch(),
                            -offset.y * offset.z / (flat * square) / columns.rowPitch()},
                           {0, flat / square / columns.rowPitch()}};
    double least = 1e9, leastOfDegrees = 1e9;
    const glm::dvec3 fromEye = place - *sampling.eye;
    for (int turn = 0; turn < 3600; ++turn) {
      const double angle = kPi * turn / 3600;
      const glm::dvec2 along(std::cos(angle), std::sin(angle));
      const double samples = glm::length(steps * along);
      least = std::min(least, samples);
      // A small step on the wall, as the eye's degrees.
      const glm::dvec3 step(0, along.x, along.y);
      const double seen = degrees(glm::length(glm::cross(fromEye, step)) / glm::dot(fromEye, fromEye));
      leastOfDegrees = std::min(leastOfDegrees, samples / seen);
    }
    EXPECT_NEAR(camera.samplesPerMetre, least, 1e-4 * least);
    EXPECT_NEAR(camera.samplesPerDegree, leastOfDegrees, 1e-4 * leastOfDegrees);
  }
}

TEST(PointSampling, NamesEveryCameraThatARegionWhichSeesThePointCouldShowItFromOnce) {
  const World world(furnishedRoom(), Configuration::c);
  const CaptureReach reach = world.reach();
  const SurfaceJudge judge(reach, {});
  const SurfacePoint point = pointOn({9, 0.4, 3.6}, {-1, 0, 0});  // over the screen, to be seen above it
  const PointSampling sampling = samplingOfPoint(reach, judge, point);
  std::set<int> expected, told;
  for (const std::uint32_t region : sampling.coverage.seenFrom)
    for (const Cover& cover : drawnCovers(world.layout, int(region)))
      expected.insert(pieceAt(cover, glm::dvec2(point.position))->camera);
  expected.erase(-1);
  bool held = true;
  for (const CameraSampling& camera : sampling.cameras) {
    EXPECT_TRUE(told.insert(camera.camera).second);
    EXPECT_EQ(camera.held, reach.holds(camera.camera, point.position));
    EXPECT_EQ(camera.hidden,
              hidden(world.tracer, reach.columns(camera.camera).centreOfProjection, point.position));
    EXPECT_TRUE(held || !camera.held);  // those that hold it come first
    held = camera.held;
  }
  EXPECT_EQ(told, expected);
  EXPECT_GT(told.size(), 2U);
}

TEST(PointSampling, OfAPointThatNobodySeesNamesNoCamera) {
  const World world(emptyRoom(), Configuration::b);
  const CaptureReach reach = world.reach();
  const PointSampling sampling =
      samplingOfPoint(reach, SurfaceJudge(reach, {}), pointOn({9.2, 0, 2}, {1, 0, 0}));
  EXPECT_EQ(sampling.coverage.surfaceClass, SurfaceClass::unseen);
  EXPECT_TRUE(sampling.cameras.empty());
  EXPECT_FALSE(sampling.eye.has_value());
}

TEST(PointSampling, BehindASurfaceIsHeldOnlyInADeeperLayer) {
  const World world(furnishedRoom(), Configuration::b);
  const SurfacePoint point = pointOn({9, 2.2, 1.2}, {-1, 0, 0});  // behind the screen for some
  const CaptureReach deep = world.reach(8), flat = world.reach(1);
  const SurfaceJudge deepJudge(deep, {}), flatJudge(flat, {});
  int behind = 0;
  for (const CameraSampling& camera : samplingOfPoint(deep, deepJudge, point).cameras)
    behind += camera.held && camera.hidden ? 1 : 0;
  EXPECT_GT(behind, 0);
  for (const CameraSampling& camera : samplingOfPoint(flat, flatJudge, point).cameras) {
    if (!camera.held || !camera.hidden) continue;
    // What is in the way then stands in the regions that the camera serves: their local geometry.
    const LayoutCamera& served = world.layout.cameras[std::size_t(camera.camera)];
    const glm::dvec3 centre = world.columns[std::size_t(camera.camera)].centreOfProjection;
    const glm::dvec3 way = point.position - centre;
    const double flatLength = glm::length(glm::dvec2(way));
    double last = 0;
    for (const Role& role : served.roles)
      if (const double exit = exitDistance(served, role, glm::dvec2(way) / flatLength); exit < flatLength)
        last = std::max(last, exit);
    EXPECT_FALSE(hidden(world.tracer, centre + last / flatLength * way, point.position)) << camera.camera;
  }
}

}  // namespace
}  // namespace acentric
