#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "baked_camera.h"
#include "engine/bake/bake.h"
#include "engine/bake/eye_views.h"
#include "engine/bake/shading.h"
#include "layout_builder.h"
#include "mirror_materials.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::cameraAt;
using test::glowing;
using test::kEyeZ;
using test::SceneBuilder;
using test::silver;
using test::square;

/// A room with walls of six colours and a mirror before the wall at x = 6, looked at from the middle.
struct MirrorRoom {
  static constexpr float kMirrorX = 5.5f;
  std::array<glm::vec3, 6> colours = {glm::vec3{0.9f, 0.1f, 0.1f}, {0.1f, 0.8f, 0.1f}, {0.1f, 0.2f, 0.9f},
                                      {0.7f, 0.7f, 0.1f},          {0.1f, 0.6f, 0.6f}, {0.6f, 0.1f, 0.6f}};
  glm::vec3 low{-6, -5, 0}, high{6, 5, 3};
  glm::vec3 tint{0.9f, 0.8f, 0.7f};
  SceneBuilder builder;

  MirrorRoom() {
    const auto wall = [&](std::size_t side) { return builder.material(glowing(colours[side])); };
    builder.quad(wall(0), {-6, -5, 0}, {-6, 5, 0}, {-6, 5, 3}, {-6, -5, 3});
    builder.quad(wall(1), {6, -5, 0}, {6, -5, 3}, {6, 5, 3}, {6, 5, 0});
    builder.quad(wall(2), {-6, -5, 0}, {-6, -5, 3}, {6, -5, 3}, {6, -5, 0});
    builder.quad(wall(3), {-6, 5, 0}, {6, 5, 0}, {6, 5, 3}, {-6, 5, 3});
    builder.quad(wall(4), {-6, -5, 0}, {6, -5, 0}, {6, 5, 0}, {-6, 5, 0});
    const float x = kMirrorX;
    builder.quad(builder.material(silver(tint)), {x, -2, 0.5f}, {x, -2, 2.5f}, {x, 2, 2.5f}, {x, 2, 0.5f});
    builder.sky(colours[5]);
  }
  /// The side of a colour (tinted by the mirror) that a point lies on, give or take `slack`; -1: none.
  int sideOf(const glm::dvec3& p, double slack, const glm::vec3& seen) const {
    for (int side = 0; side < 5; ++side) {
      const double plane = double(side % 2 == 0 ? low[side / 2] : high[side / 2]);
      if (std::abs(p[side / 2] - plane) < slack && shows(side, seen)) return side;
    }
    return -1;
  }
  bool shows(int side, const glm::vec3& seen) const {
    const glm::vec3 expected = colours[std::size_t(side)] * tint;
    return glm::all(glm::lessThan(glm::abs(seen - expected), 2e-3f * expected));
  }
};

struct BakedMirrors {
  Capture capture;
  CaptureCounts counts;
};

BakedMirrors bakeMirrors(const RayScenePtr& scene, const LayoutCamera& camera, bool pruning = false,
                         bool silhouettes = false) {
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  settings.pruning = pruning;
  settings.silhouettes = silhouettes;
  const ColumnCamera columns = columnCameraFor(camera, kEyeZ, 1, scene->scene().bounds, settings);
  TaskRunner runner(0);
  BakedMirrors baked;
  auto capture = CameraBaker(*scene, settings).bake(camera, columns, runner, baked.counts);
  EXPECT_TRUE(capture.has_value());
  if (!capture) return baked;
  EXPECT_TRUE(capture->check().has_value()) << capture->check().error().describe();
  baked.capture = std::move(*capture);
  return baked;
}

/// Position of sample i of column k; for the sky its direction.
glm::dvec3 placeOf(const Capture& capture, const CaptureSamples& list, std::size_t k, std::size_t i) {
  const glm::dvec3 along(capture.camera.directionAt(double(k) + 0.5),
                         capture.camera.tangentAt(list.row[i] + 0.5));
  const double w = double(list.inverseDistance[i]);
  return w > 0 ? capture.camera.centreOfProjection + along / w : along;
}

/// Metres: how far the rounding of its inverse distance, by half a step, may move a sample.
double roundingAt(const Capture& capture, float inverseDistance) {
  return capture.distanceStep / double(inverseDistance * inverseDistance) + 1e-3;
}

TEST(BakeMirrors, KeepWhatTheyShowAtItsMirrorImage) {
  const MirrorRoom room;
  const BakedMirrors baked = bakeMirrors(room.builder.rays(), cameraAt({0.5, 0.2}, {square(1)}));
  const Capture& capture = baked.capture;
  const CaptureSamples& shown = capture.reflections;
  std::set<std::pair<std::size_t, int>> mirrorPixels, shownPixels;
  int sky = 0;
  std::set<int> sides;
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k) {
    for (auto i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i)
      if (capture.mirror[i] != 0) {
        mirrorPixels.insert({k, capture.row[i]});
        EXPECT_NEAR(placeOf(capture, capture, k, i).x, double(MirrorRoom::kMirrorX),
                    roundingAt(capture, capture.inverseDistance[i]));
      }
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
      shownPixels.insert({k, shown.row[i]});
      EXPECT_EQ(shown.mirror[i], shown.mirror[0]);
      const glm::vec3 seen(unpackColour(shown.colour[i]));
      if (shown.inverseDistance[i] == 0) {
        ++sky;
        EXPECT_TRUE(room.shows(5, seen));
        continue;
      }
      glm::dvec3 place = placeOf(capture, shown, k, i);
      place.x = 2 * double(MirrorRoom::kMirrorX) - place.x;  // its original
      const int side = room.sideOf(place, roundingAt(capture, shown.inverseDistance[i]), seen);
      ASSERT_GE(side, 0) << place.x << " " << place.y << " " << place.z;
      sides.insert(side);
    }
  }
  EXPECT_EQ(shownPixels, mirrorPixels) << "one for each sample of the mirror";
  EXPECT_EQ(baked.counts.reflections, shown.sampleCount());
  EXPECT_EQ(baked.counts.rays.mirror, shown.sampleCount()) << "a ray each, no more than without them";
  EXPECT_GT(mirrorPixels.size(), 1000u);
  EXPECT_GT(sky, 50);
  EXPECT_GE(sides.size(), 4u) << "the wall behind, both at the sides, the floor";
}

TEST(BakeMirrors, LeaveTheSurfacesAsTheyAreWithoutThem) {
  const MirrorRoom room;
  const auto camera = cameraAt({0.5, 0.2}, {square(1)});
  const BakedMirrors with = bakeMirrors(room.builder.rays(), camera),
                     without = bakeMirrors(room.builder.rays({Effect::mirrorReflection}), camera);
  EXPECT_FALSE(without.capture.hasReflections());
  EXPECT_TRUE(without.capture.mirror.empty());
  EXPECT_EQ(without.counts.rays.mirror, 0u);
  EXPECT_EQ(without.counts.reflections, 0u);
  EXPECT_EQ(with.capture.columnStart, without.capture.columnStart);
  EXPECT_EQ(with.capture.row, without.capture.row);
  EXPECT_EQ(with.capture.inverseDistance, without.capture.inverseDistance);
  EXPECT_EQ(with.capture.roles, without.capture.roles);
  for (std::size_t i = 0; i < with.capture.sampleCount(); ++i)
    if (with.capture.mirror[i] == 0) {
      ASSERT_EQ(with.capture.colour[i], without.capture.colour[i]);
    }
  // A camera that sees no mirror has no list.
  auto away = camera;
  away.lowAzimuth += kPi;
  const BakedMirrors unseen = bakeMirrors(room.builder.rays(), away);
  EXPECT_FALSE(unseen.capture.hasReflections());
  EXPECT_TRUE(unseen.capture.mirror.empty());
}

/// The reference: the surface's colour is what the shading kernel gives.
TEST(BakeMirrors, ColourTheMirrorAsEverySurfaceIsShaded) {
  const MirrorRoom room;
  const auto scene = room.builder.rays();
  const BakedMirrors baked = bakeMirrors(scene, cameraAt({0.5, 0.2}, {square(1)}));
  const Shader shader(*scene, {});
  RayCounts rays;
  const Capture& capture = baked.capture;
  int compared = 0;
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k)
    for (auto i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i) {
      if (capture.mirror[i] == 0) continue;
      const glm::vec3 from(capture.camera.centreOfProjection);
      const Ray ray{from, glm::normalize(glm::vec3(placeOf(capture, capture, k, i)) - from)};
      const glm::vec3 expected = shader.shade(scene->trace(ray), -ray.direction, rays).radiance();
      const glm::vec3 actual(unpackColour(capture.colour[i]));
      compared += glm::all(glm::lessThan(glm::abs(actual - expected), 2e-3f * expected + 1e-4f)) ? 1 : 0;
    }
  EXPECT_GT(compared, 0.98 * double(baked.counts.reflections)) << "all but those on an edge";
}

TEST(BakeMirrors, ServeTheRolesWhosePartHoldsTheVirtualPlace) {
  const MirrorRoom room;
  // Two regions' parts meet at x = 10, behind the mirror: only the second draws what lies beyond, though the
  // mirror itself lies in the first one's part.
  LayoutCamera camera = cameraAt({0.5, 0.2}, {square(1), square(1.2)});
  const BorderLine line{{10, -50}, {10, 50}};
  camera.roles[0].clip = Clip{{line, true}};
  camera.roles[1].clip = Clip{{line, false}};
  for (const bool pruning : {false, true}) {
    const BakedMirrors baked = bakeMirrors(room.builder.rays(), camera, pruning);
    const CaptureSamples& shown = baked.capture.reflections;
    int near = 0, far = 0;
    for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
      for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
        const double x = placeOf(baked.capture, shown, k, i).x;
        if (shown.inverseDistance[i] > 0 &&
            std::abs(x - 10) < roundingAt(baked.capture, shown.inverseDistance[i]))
          continue;
        const bool beyond = shown.inverseDistance[i] == 0 || x > 10;
        ASSERT_EQ(shown.roles[i], beyond ? 2 : 1);
        ++(beyond ? far : near);
      }
    EXPECT_GT(near, 50);
    EXPECT_GT(far, 500);
    for (std::size_t i = 0; i < baked.capture.sampleCount(); ++i)
      if (baked.capture.mirror[i] != 0) {
        ASSERT_EQ(baked.capture.roles[i], 1) << "the mirror is the first one's";
      }
  }
}

/// A role's region may see what lies behind a mirror where the camera does not; the reference asks, at twice
/// the density of test eyes and with rays alone, whether an eye of the region sees a virtual place in the
/// mirror.
bool seenInMirrorFrom(const RayScene& scene, const ConvexPolygon& region, const glm::dvec3& place,
                      double slack) {
  BakeSettings dense;
  dense.testEyes = 64;
  const double x = double(MirrorRoom::kMirrorX);
  for (const glm::dvec3& eye : placedEyes(region, kEyeZ, dense)) {
    const glm::dvec3 at = eye + (x - eye.x) / (place.x - eye.x) * (place - eye);
    if (std::abs(at.y) > 2 + slack || std::abs(at.z - 1.5) > 1 + slack) continue;
    const glm::dvec3 from = at - glm::dvec3(1e-3, 0, 0),
                     way = glm::dvec3(2 * x - place.x, place.y, place.z) - from;
    const Ray ray{glm::vec3(from), glm::vec3(glm::normalize(way)), 0, float(glm::length(way) * (1 - slack))};
    if (std::isinf(scene.occluderDistance(ray))) return true;
  }
  return false;
}

/// Places that eyes see in the room's mirror, and those of them that have no sample near by, along the
/// camera's own columns.
struct Seen {
  int all = 0, missing = 0;
};

Seen seenInMirror(const RayScene& scene, const LayoutCamera& camera, const Capture& capture,
                  const std::vector<glm::dvec3>& eyes) {
  const CaptureSamples& shown = capture.reflections;
  std::set<std::pair<std::size_t, int>> pixels;
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) pixels.insert({k, shown.row[i]});
  const ColumnCamera& columns = capture.camera;
  Seen seen;
  for (const glm::dvec3& eye : eyes)
    for (double y = -1.9; y < 2; y += 0.2)
      for (double z = 0.6; z < 2.4; z += 0.2) {
        const glm::dvec3 at(double(MirrorRoom::kMirrorX), y, z);
        const glm::dvec3 on = glm::normalize(at - eye);
        const Ray toMirror{glm::vec3(eye), glm::vec3(on), 0, float(glm::distance(at, eye) - 1e-3)};
        if (!std::isinf(scene.occluderDistance(toMirror))) continue;
        const Hit hit = scene.trace({glm::vec3(at - glm::dvec3(1e-3, 0, 0)), glm::vec3(-on.x, on.y, on.z)});
        if (!hit.found()) continue;
        const glm::dvec3 way = at + double(hit.distance) * on - columns.centreOfProjection;
        const double azimuth = std::atan2(way.y, way.x) - camera.lowAzimuth;
        const double k = azimuth / columns.columnPitch();
        int row = 0;
        const double tangent = way.z / std::hypot(way.x, way.y);
        while (row < columns.rows && columns.tangentAt(row + 1.0) > tangent) ++row;
        if (k < 1 || k > columns.columns - 1 || row < 1 || row >= columns.rows - 1) continue;
        ++seen.all;
        bool found = false;
        for (int dk = -1; dk <= 1; ++dk)
          for (int dr = -1; dr <= 1; ++dr)
            found = found || pixels.contains({std::size_t(int(k) + dk), row + dr});
        seen.missing += found ? 0 : 1;
      }
  return seen;
}

TEST(BakeMirrors, KeepWhatOnlyOtherEyesOfTheRegionSeeInThem) {
  const MirrorRoom room;
  const auto scene = room.builder.rays();
  // The camera looks along the mirror from the region's border: what eyes on the other side see in it lies
  // beside the mirror's opening for the camera.
  const ConvexPolygon region = square(2);
  const LayoutCamera camera = cameraAt({2, -2}, {region});
  const Capture few = bakeMirrors(scene, camera, false).capture;
  const BakedMirrors baked = bakeMirrors(scene, camera, true);
  const CaptureSamples& shown = baked.capture.reflections;
  std::size_t beside = 0;
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
      if (shown.inverseDistance[i] == 0) continue;
      const glm::dvec3 place = placeOf(baked.capture, shown, k, i),
                       from = baked.capture.camera.centreOfProjection;
      glm::dvec3 original = place;
      original.x = 2 * double(MirrorRoom::kMirrorX) - place.x;
      const double slack = roundingAt(baked.capture, shown.inverseDistance[i]);
      ASSERT_GE(room.sideOf(original, slack, glm::vec3(unpackColour(shown.colour[i]))), 0);
      ASSERT_TRUE(seenInMirrorFrom(*scene, region, place, 0.02)) << "nothing that no eye sees";
      const glm::dvec3 at =
          from + (double(MirrorRoom::kMirrorX) - from.x) / (place.x - from.x) * (place - from);
      beside += std::abs(at.y) > 2 || std::abs(at.z - 1.5) > 1 ? 1 : 0;
    }
  EXPECT_GT(beside, 1000u);
  EXPECT_GT(shown.sampleCount(), few.reflections.sampleCount() + beside / 2);
  const Seen seen = seenInMirror(*scene, camera, baked.capture, placedEyes(region, kEyeZ, {}));
  EXPECT_GT(seen.all, 300);
  EXPECT_EQ(seen.missing, 0);
}

/// Through the gaps of a colonnade each eye sees other places in the mirror: 8 test eyes stand for few
/// others.
TEST(BakeMirrors, KeepWhatEyesBetweenTheTestEyesSeeInThem) {
  MirrorRoom room;
  const int grey = room.builder.material(glowing(glm::vec3(0.4f)));
  for (float y = -4.5f; y < 5; y += 0.6f) room.builder.box(grey, {3, y, 0}, {3.2f, y + 0.4f, 3});
  const auto scene = room.builder.rays();
  const ConvexPolygon region = square(2);
  const LayoutCamera camera = cameraAt({2, -2}, {region});
  BakeSettings dense;
  dense.testEyes = 64;
  const Seen seen = seenInMirror(*scene, camera, bakeMirrors(scene, camera, true).capture,
                                 placedEyes(region, kEyeZ, dense));
  EXPECT_GT(seen.all, 300);
  EXPECT_LT(seen.missing, seen.all / 25);
}

TEST(BakeMirrors, KeepWhatIsHiddenBehindWhatTheyShowFirst) {
  MirrorRoom room;
  // A pillar between the mirror and the wall behind the region.
  const glm::vec3 grey(0.3f, 0.31f, 0.32f);
  room.builder.box(room.builder.material(glowing(grey)), {-4, -0.4f, 0}, {-3.5f, 0.4f, 3});
  const auto scene = room.builder.rays();
  const ConvexPolygon region = square(2);
  const BakedMirrors baked = bakeMirrors(scene, cameraAt({0.5, 0}, {region}), true);
  const CaptureSamples& shown = baked.capture.reflections;
  int behind = 0;
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k] + 1; i < shown.columnStart[k + 1]; ++i) {
      if (shown.row[i] != shown.row[i - 1]) continue;
      EXPECT_LT(shown.inverseDistance[i], shown.inverseDistance[i - 1]);
      if (shown.inverseDistance[i] == 0) continue;
      const glm::dvec3 place = placeOf(baked.capture, shown, k, i);
      ASSERT_TRUE(seenInMirrorFrom(*scene, region, place, 0.02));
      behind += room.shows(0, glm::vec3(unpackColour(shown.colour[i]))) ? 1 : 0;
    }
  EXPECT_GT(behind, 50) << "the wall behind the pillar";
}

TEST(BakeMirrors, KeepWhatTheyShowCloseBeforeThem) {
  MirrorRoom room;
  // Its image lies within the grown region, where nothing else would draw it.
  const glm::vec3 grey(0.3f, 0.31f, 0.32f);
  room.builder.box(room.builder.material(glowing(grey)), {5.2f, -0.1f, 0}, {5.3f, 0.1f, 2});
  LayoutCamera camera = cameraAt({0.5, 0.2}, {square(5)});
  camera.roles[0].grown = square(6.5);
  const Capture capture = bakeMirrors(room.builder.rays(), camera, true).capture;
  const CaptureSamples& shown = capture.reflections;
  int close = 0;
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
      const glm::dvec3 place = placeOf(capture, shown, k, i);
      const bool isGrey = glm::distance(glm::vec3(unpackColour(shown.colour[i])), grey * room.tint) < 1e-3f;
      close += isGrey && std::abs(place.x - 5.75) < 0.1 ? 1 : 0;
    }
  EXPECT_GT(close, 20);
}

/// Glass before the wall behind the region: the mirror shows it, and the wall through it.
TEST(BakeMirrors, KeepGlassAndWhatIsBehindItApart) {
  MirrorRoom room;
  Material pane = glowing({0.2f, 0.5f, 0.9f});
  pane.baseColour.a = 0.4f, pane.alphaMode = AlphaMode::blend;
  constexpr float kPaneX = -4;
  room.builder.quad(room.builder.material(pane), {kPaneX, -2, 0}, {kPaneX, 2, 0}, {kPaneX, 2, 3},
                    {kPaneX, -2, 3});
  const auto scene = room.builder.rays();
  for (const bool pruning : {false, true}) {
    const Capture capture = bakeMirrors(scene, cameraAt({0.5, 0.2}, {square(1)}), pruning).capture;
    const CaptureSamples& shown = capture.reflections;
    int panes = 0, behind = 0, composed = 0;
    for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k) {
      std::uint32_t own = capture.columnStart[k];
      for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
        const glm::vec4 colour = unpackColour(shown.colour[i]);
        if (shown.inverseDistance[i] == 0) {
          EXPECT_TRUE(room.shows(5, glm::vec3(colour)));
          continue;
        }
        glm::dvec3 place = placeOf(capture, shown, k, i);
        place.x = 2 * double(MirrorRoom::kMirrorX) - place.x;
        const double slack = roundingAt(capture, shown.inverseDistance[i]);
        if (colour.a == 1) {
          ASSERT_GE(room.sideOf(place, slack, glm::vec3(colour)), 0) << "as it looks without the glass";
          continue;
        }
        ++panes;
        EXPECT_NEAR(place.x, double(kPaneX), slack);
        EXPECT_NEAR(colour.a, 0.4f, 1e-3f);
        const glm::vec3 expected = glm::vec3(pane.baseColour) * room.tint;
        EXPECT_LT(glm::distance(glm::vec3(colour), expected), 2e-3f);
        if (i + 1 == shown.columnStart[k + 1] || shown.row[i + 1] != shown.row[i]) continue;
        ++behind;
        while (own < capture.columnStart[k + 1] && capture.row[own] < shown.row[i]) ++own;
        if (own == capture.columnStart[k + 1] || capture.row[own] != shown.row[i] || capture.mirror[own] == 0)
          continue;
        ++composed;
        const glm::vec3 through =
            glm::mix(glm::vec3(unpackColour(shown.colour[i + 1])), glm::vec3(colour), colour.a);
        EXPECT_LT(glm::distance(through, glm::vec3(unpackColour(capture.colour[own]))), 2e-3f)
            << "together what the camera saw";
      }
    }
    EXPECT_GT(panes, 500);
    EXPECT_EQ(behind, panes);
    EXPECT_GT(composed, 500);
  }
}

/// What is shown of a place: the original's position, and the colour without the mirror's tint.
struct ShownPlace {
  glm::dvec3 original{0};
  glm::vec3 colour{0};
  int roles = 0;
};
/// All that is shown above the floor of the plane y = 0 between two x.
std::vector<ShownPlace> shownAtTheMiddle(const MirrorRoom& room, const Capture& capture, double fromX,
                                         double toX) {
  std::vector<ShownPlace> places;
  const CaptureSamples& shown = capture.reflections;
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
      if (shown.inverseDistance[i] == 0) continue;
      glm::dvec3 place = placeOf(capture, shown, k, i);
      place.x = 2 * double(MirrorRoom::kMirrorX) - place.x;
      const double slack = roundingAt(capture, shown.inverseDistance[i]);
      if (std::abs(place.y) < slack && place.z > 0.1 && place.x > fromX + slack && place.x < toX - slack)
        places.push_back({place, glm::vec3(unpackColour(shown.colour[i])) / room.tint, shown.roles[i]});
    }
  return places;
}
constexpr float kSunOnSide = 10;
/// Sunlight that falls on what faces +y, and not on what faces -y.
void lightFromPositiveY(MirrorRoom& room) { room.builder.sun({0, -1, -1}, kSunOnSide).sky(glm::vec3(1e-6f)); }
const float kLit = kSunOnSide * std::sqrt(0.5f) / float(kPi);  ///< at least, of white

/// The mirrored ray leaves a cupboard by a side that it only meets from within, and the region sees that side
/// from without.
TEST(BakeMirrors, ShadeTheSideThatIsSeenInThemAndNotTheOneTheMirroredRayMeets) {
  MirrorRoom room;
  lightFromPositiveY(room);
  room.builder.box(room.builder.material(test::matte()), {3, -0.4f, 0}, {4.5f, 0, 3});
  const auto scene = room.builder.rays();
  const BakedMirrors baked = bakeMirrors(scene, cameraAt({1.5, -1}, {square(1.5, {0.5, 0.1})}), true);
  const auto places = shownAtTheMiddle(room, baked.capture, 3, 4.5);
  EXPECT_GT(places.size(), 100u);
  for (const ShownPlace& place : places) ASSERT_GT(place.colour.r, 0.99f * kLit) << place.original.x;
  for (const ShownPlace& place :
       shownAtTheMiddle(room, bakeMirrors(scene, cameraAt({1.5, -1}, {square(1)})).capture, 3, 4.5))
    ADD_FAILURE() << "the camera itself does not see it: " << place.original.x;
}

TEST(BakeMirrors, KeepASampleOfEachSideThatDifferentRolesSeeInThem) {
  MirrorRoom room;
  lightFromPositiveY(room);
  room.builder.quad(room.builder.material(test::matte()), {3, 0, 0}, {5, 0, 0}, {5, 0, 3}, {3, 0, 3});
  const auto scene = room.builder.rays();
  // A sheet along the way to the mirror, and a region to its left and to its right.
  const ConvexPolygon right = square(0.5, {1.5, -1}), left = square(0.5, {1.5, 1});
  for (const bool rightFirst : {true, false}) {
    const LayoutCamera camera =
        cameraAt({1.5, -1}, rightFirst ? std::vector{right, left} : std::vector{left, right});
    const Capture capture = bakeMirrors(scene, camera, true).capture;
    std::array<int, 2> found{};
    for (const ShownPlace& place : shownAtTheMiddle(room, capture, 3, 5)) {
      const bool lit = place.colour.r > 0.99f * kLit;
      if (!lit) {
        ASSERT_LT(place.colour.r, 0.6f * kLit);
      }
      ASSERT_EQ(place.roles, lit == rightFirst ? 2 : 1) << place.original.x << (lit ? " lit" : " dark");
      ++found[lit ? 1 : 0];
    }
    EXPECT_GT(found[0], 100);
    EXPECT_GT(found[1], 100);
  }
  // One that sees it from the left only: no sample of the side that the camera itself sees.
  const auto places =
      shownAtTheMiddle(room, bakeMirrors(scene, cameraAt({1.5, -1}, {left}), true).capture, 3, 5);
  EXPECT_GT(places.size(), 100u);
  for (const ShownPlace& place : places) ASSERT_GT(place.colour.r, 0.99f * kLit);
}

/// Else frames would take the lit side for one that the eye cannot see.
TEST(BakeMirrors, TellWhichSideOfASurfaceTheyShow) {
  MirrorRoom room;
  lightFromPositiveY(room);
  room.builder.quad(room.builder.material(test::matte()), {3, 0, 0}, {5, 0, 0}, {5, 0, 3}, {3, 0, 3});
  const std::vector regions = {square(0.5, {1.5, -1}), square(0.5, {1.5, 1})};
  const Capture capture = bakeMirrors(room.builder.rays(), cameraAt({1.5, -1}, regions), true, true).capture;
  const CaptureSamples& shown = capture.reflections;
  std::array<int, 2> found{};
  for (std::size_t k = 0; k + 1 < shown.columnStart.size(); ++k)
    for (auto i = shown.columnStart[k]; i < shown.columnStart[k + 1]; ++i) {
      if (shown.inverseDistance[i] == 0 || shown.coverage[i] != kWholePixel) continue;
      const glm::dvec3 place = placeOf(capture, shown, k, i);
      const double slack = roundingAt(capture, shown.inverseDistance[i]);
      if (std::abs(place.y) > slack || place.z < 0.1 || place.x < 6 + slack || place.x > 8 - slack) continue;
      const bool lit =
          unpackColour(shown.colour[i]).r > 0.8f * kLit;  // from the side where the camera is not
      ASSERT_EQ(shown.planes[shown.plane[i]].away, lit ? 1u : 0u) << place.x << " " << place.z;
      ++found[lit ? 1 : 0];
    }
  EXPECT_GT(found[0], 100);
  EXPECT_GT(found[1], 100);
}

TEST(BakeMirrors, AverageTexturesOverWhatASampleShows) {
  SceneBuilder builder;
  Material material = glowing(glm::vec3(1));
  material.baseColourTexture = builder.texture(test::chequers(1024));
  builder.floor(builder.material(material), 20);  // tiles of 4 cm
  const int mirror = builder.material(silver(glm::vec3(1)));
  builder.quad(mirror, {3, -3, 0}, {3, -3, 3}, {3, 3, 3}, {3, 3, 0});
  const auto scene = builder.rays();
  for (const bool pruning : {false, true}) {
    const Capture capture = bakeMirrors(scene, cameraAt({0, 0}, {square(1)}), pruning).capture;
    const CaptureSamples& shown = capture.reflections;
    int far = 0;
    double worst = 0, sum = 0;
    for (std::size_t i = 0; i < shown.sampleCount(); ++i) {
      const double distance = 1 / double(shown.inverseDistance[i]);
      if (distance < 8 || distance > 12) continue;
      ++far;
      const double off = std::abs(double(unpackColour(shown.colour[i]).g) - 0.5);
      worst = std::max(worst, off), sum += off;
    }
    EXPECT_GT(far, 50);
    EXPECT_LT(worst, 0.3);
    EXPECT_LT(sum / far, 0.1);
  }
}

TEST(BakeMirrors, CostNoRaysWhereNoneCanBeSeen) {
  const MirrorRoom room;
  auto camera = cameraAt({0.5, 0.2}, {square(1)});
  EXPECT_EQ(bakeMirrors(room.builder.rays({Effect::mirrorReflection}), camera, true).counts.rays.mirror, 0u);
  const auto scene = room.builder.rays();
  EXPECT_GT(bakeMirrors(scene, camera, true).counts.rays.mirror, 1000u);
  camera.lowAzimuth += kPi;
  EXPECT_EQ(bakeMirrors(scene, camera, true).counts.rays.mirror, 0u) << "the camera looks away";
  auto behind = cameraAt({10, 0}, {square(1, {10, 0})});
  EXPECT_EQ(bakeMirrors(scene, behind, true).counts.rays.mirror, 0u) << "the region lies behind the mirror";
}

}  // namespace
}  // namespace acentric
