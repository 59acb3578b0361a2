#include "engine/bake/preview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A previewRoom of 6 x 5 x 3 m whose sides face inwards.
RayScenePtr previewRoom(glm::vec3 colour = glm::vec3(0.5F)) {
  SceneBuilder builder;
  builder.box(builder.material(matte(colour)), {0, 0, 0}, {6, 5, 3}, true);
  return builder.rays();
}

struct Met {
  double distance;
  glm::dvec3 normal;
};
/// What a ray from within the previewRoom meets, by hand.
Met wallOfRoom(const glm::dvec3& from, const glm::dvec3& way) {
  Met met{1e9, {}};
  const glm::dvec3 size(6, 5, 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) continue;
    const double t = ((way[axis] > 0 ? size[axis] : 0.0) - from[axis]) / way[axis];
    if (t >= met.distance) continue;
    met = {t, glm::dvec3(0)};
    met.normal[axis] = way[axis] > 0 ? -1 : 1;
  }
  return met;
}

PerspectiveView viewFrom(const glm::dvec3& eye, double yaw, double pitch) {
  PerspectiveView view;
  view.eye = eye;
  view.yawRadians = yaw;
  view.pitchRadians = pitch;
  view.width = 61, view.height = 43;
  return view;
}

TEST(Preview, OfABoxRoomHasItsDistancesAndNormals) {
  const PreviewTracer tracer(previewRoom());
  TaskRunner runner(1);
  for (const double yaw : {0.3, 2.1, 4.4})
    for (const double pitch : {-0.9, 0.1, 0.8}) {
      const PerspectiveView view = viewFrom({2.2, 1.7, 1.6}, yaw, pitch);
      const PreviewPicture picture = previewView(tracer, view, kNoCut, runner);
      ASSERT_EQ(picture.rayDistance.width, view.width);
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
          const glm::dvec3 way = view.rayThrough(x + 0.5, y + 0.5);
          const Met met = wallOfRoom(view.eye, way);
          EXPECT_NEAR(picture.rayDistance.at(x, y), met.distance, 2e-6 * met.distance);
          EXPECT_EQ(picture.colour.at(x, y).a, 255);
          const PreviewSeen seen = tracer.along({glm::vec3(view.eye), glm::vec3(way)});
          EXPECT_NEAR(seen.distance, met.distance, 2e-6 * met.distance);
          EXPECT_NEAR(glm::length(glm::dvec3(seen.normal) - met.normal), 0, 1e-6);
        }
    }
}

TEST(Preview, CutsAwayWhatIsAboveAndLooksPastWallsSeenFromBehind) {
  const PreviewTracer tracer(previewRoom());
  const glm::dvec3 eye(-3, 2.5, 5);  // outside, above the previewRoom
  for (const double fall : {0.45, 0.6, 0.8}) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(1, 0.1, -fall));
    // Without a cut the ceiling or a wall is seen from behind.
    EXPECT_LT(tracer.along({glm::vec3(eye), glm::vec3(way)}).distance, 6);
    const PreviewSeen seen = tracer.along({glm::vec3(eye), glm::vec3(way)}, 1.8);
    const double inside = -eye.x / way.x;  // where the ray passes x = 0
    const Met met = wallOfRoom(eye + inside * way, way);
    EXPECT_NEAR(seen.distance, inside + met.distance, 1e-5) << fall;
    EXPECT_NEAR(glm::length(glm::dvec3(seen.normal) - met.normal), 0, 1e-6);
  }
  // Upwards from below the cut there is nothing; neither is there for an eye above it that looks up.
  EXPECT_FALSE(tracer.along({{3, 2, 1}, glm::normalize(glm::vec3(0.1F, 0, 1))}, 1.8).found());
  EXPECT_FALSE(tracer.along({{3, 2, 2.5F}, {0, 0, 1}}, 1.8).found());
  EXPECT_NEAR(tracer.along({{3, 2, 1}, {1, 0, 0}}, 1.8).distance, 3, 1e-5);
}

TEST(Preview, ClosesTheInsidesOfSolidsAtTheCut) {
  SceneBuilder builder;
  const int material = builder.material(matte());
  builder.floor(material, 9).box(material, {1, 1, 0}, {2, 2, 4});
  const PreviewTracer tracer(builder.rays());
  const PreviewSeen cap = tracer.along({{1.5F, 1.5F, 10}, {0, 0, -1}}, 1.8);
  EXPECT_TRUE(cap.cap);
  EXPECT_NEAR(cap.distance, 8.2, 1e-5);
  EXPECT_EQ(cap.normal, glm::vec3(0, 0, 1));
  const PreviewSeen beside = tracer.along({{2.5F, 1.5F, 10}, {0, 0, -1}}, 1.8);
  EXPECT_FALSE(beside.cap);
  EXPECT_NEAR(beside.distance, 10, 1e-5);
}

TEST(Preview, OfASceneWoundInsideOutStillShowsItUnderACut) {
  SceneBuilder builder;
  builder.quad(builder.material(matte()), {-9, 9, 0}, {9, 9, 0}, {9, -9, 0}, {-9, -9, 0});  // faces down
  const PreviewTracer tracer(builder.rays());
  const glm::vec3 way = glm::normalize(glm::vec3(0.3F, 0, -1));
  EXPECT_NEAR(tracer.along({{0, 0, 1}, way}, 1.8).distance, 1 / -way.z, 1e-5);
}

TEST(Preview, ShowsSurfacesInTheirOwnColourBrightestWhereTheyFaceTheEye) {
  const PreviewTracer tracer(previewRoom({0.8F, 0.2F, 0.1F}));
  const glm::vec3 eye(3, 2.5F, 1.5F);
  const glm::vec3 facing = tracer.along({eye, {1, 0, 0}}).colour;
  const glm::vec3 slanted = tracer.along({eye, glm::normalize(glm::vec3(1, 0.7F, 0))}).colour;
  EXPECT_NEAR(facing.g / facing.r, 0.25F, 1e-5F);
  EXPECT_NEAR(facing.b / facing.r, 0.125F, 1e-5F);
  EXPECT_GT(facing.r, slanted.r);
  const glm::vec3 floor = tracer.along({eye, {0, 0, -1}}).colour;
  const glm::vec3 ceiling = tracer.along({eye, {0, 0, 1}}).colour;
  EXPECT_GT(floor.r, ceiling.r);  // light comes from above
}

TEST(Preview, SeesThroughWhatIsBlendedAndEndsAtWhatIsNot) {
  SceneBuilder builder;
  Material film = matte({1, 0, 0});
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.5F;
  film.doubleSided = true;
  builder.quad(builder.material(film), {2, 9, -9}, {2, -9, -9}, {2, -9, 9}, {2, 9, 9});
  builder.quad(builder.material(matte({0, 1, 0})), {5, 9, -9}, {5, -9, -9}, {5, -9, 9}, {5, 9, 9});
  const PreviewTracer tracer(builder.rays());
  const PreviewSeen seen = tracer.along({{0, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(seen.distance, 5, 1e-5);
  EXPECT_NEAR(seen.colour.r, seen.colour.g, 1e-5F);
  EXPECT_GT(seen.colour.r, 0.1F);
  EXPECT_NEAR(seen.alpha, 1, 1e-6F);
}

TEST(Preview, OfACaptureCameraIsItsPanoramaWithTheFirstColumnAtTheRight) {
  const PreviewTracer tracer(previewRoom());
  LayoutCamera camera;
  camera.position = {2, 2};
  camera.lowAzimuth = 0.2;
  camera.fovRadians = 1.0;
  ColumnCamera columns;
  columns.centreOfProjection = {2, 2, 1.6};
  columns.lowAzimuth = camera.lowAzimuth;
  columns.fovRadians = camera.fovRadians;
  columns.topElevation = 0.9, columns.bottomElevation = -0.8;
  columns.columns = 40, columns.rows = 67;
  TaskRunner runner(1);
  const PreviewPicture picture = previewCapture(tracer, camera, columns, runner);
  ASSERT_EQ(picture.colour.width, 40);
  ASSERT_EQ(picture.colour.height, 67);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 67; ++y) {
      const double azimuth = 0.2 + (39 - x + 0.5) / 40, elevation = 0.9 - 1.7 * (y + 0.5) / 67;
      const glm::dvec3 way(std::cos(elevation) * directionOf(azimuth), std::sin(elevation));
      const double distance = wallOfRoom(columns.centreOfProjection, way).distance;
      EXPECT_NEAR(picture.rayDistance.at(x, y), distance, 3e-6 * distance) << x << " " << y;
    }
}

TEST(Preview, OfACaptureCameraBeginsBeyondTheRegionsThatItServes) {
  SceneBuilder builder;
  const int material = builder.material(matte());
  builder.box(material, {0, 0, 0}, {9, 9, 3}, true).box(material, {3, 3.5F, 0}, {3.4F, 4.5F, 3});
  LayoutCamera camera;
  camera.position = {2, 4};
  camera.lowAzimuth = -0.3;
  camera.fovRadians = 0.6;
  Role role;
  role.polygon.corners = role.grown.corners = {{2, 3}, {5, 3}, {5, 5}, {2, 5}};  // holds the pillar
  camera.roles = {role};
  ColumnCamera columns;
  columns.centreOfProjection = {2, 4, 1.6};
  columns.lowAzimuth = -0.3, columns.fovRadians = 0.6;
  columns.topElevation = 0.01, columns.bottomElevation = -0.01;
  columns.columns = 3, columns.rows = 1;
  TaskRunner runner;
  const PreviewPicture picture = previewCapture(PreviewTracer(builder.rays()), camera, columns, runner);
  EXPECT_NEAR(picture.rayDistance.at(1, 0), 7, 1e-4);  // the wall, not the pillar
}

TEST(Preview, IsTransparentWhereThereIsNothingAndEmptyWhenStopped) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1);
  const PreviewTracer tracer(builder.rays());
  TaskRunner runner(1);
  const PerspectiveView view = viewFrom({0, 0, 1}, 0, 0.9);
  const PreviewPicture picture = previewView(tracer, view, kNoCut, runner);
  EXPECT_EQ(picture.colour.at(30, 20), Rgba8(0));
  EXPECT_EQ(picture.rayDistance.at(30, 20), kInfinity);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(previewView(tracer, view, kNoCut, runner, stop.get_token()).empty());
}

}  // namespace
}  // namespace acentric
