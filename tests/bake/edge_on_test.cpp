#include "engine/bake/edge_on.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "baked_camera.h"
#include "engine/image/patches.h"

namespace acentric {
namespace {

using test::bakeAsSet;
using test::Baked;
using test::cameraAt;
using test::matte;
using test::SceneBuilder;
using test::square;

constexpr glm::vec3 kRed{0.6f, 0.05f, 0.05f};
constexpr glm::dvec2 kNear{4, 0.8}, kFar{4.3, 0.864};  ///< of the facet, in plan
constexpr glm::dvec3 kEye{0, 0.45, test::kEyeZ};       ///< sees it 0.3 degrees wide

/// Of its own colour whatever the light.
Material unlit(const glm::vec3& colour) {
  Material m = matte(colour);
  m.unlit = true;
  return m;
}

/// A red upright facet before a grey wall. The camera at the origin sees it a fiftieth of a degree wide.
SceneBuilder facetBeforeWall() {
  SceneBuilder builder;
  builder.box(builder.material(unlit({0.5f, 0.5f, 0.5f})), {20, -40, -30}, {60, 40, 30});
  const float low = 1.2f, high = 2.1f;
  builder.quad(builder.material(unlit(kRed)), {kFar, low}, {kNear, low}, {kNear, high}, {kFar, high});
  return builder;
}

BakeSettings coarseFacets() {
  BakeSettings settings;
  settings.samplesPerDegree = 3;
  return settings;
}

bool isRed(const CaptureSamples& list, std::uint32_t i) {
  const glm::vec4 colour = unpackColour(list.colour[i]);
  return colour.r > 3 * colour.g;
}

/// Where along an eye's ray a red sample is seen, as renderers see it: on its plane, in a part that it
/// covers. Metres of the ray; nothing where there is none.
std::optional<double> redAlong(const ColumnCamera& camera, const CaptureSamples& list, const glm::dvec3& eye,
                               const glm::dvec3& way) {
  const PixelSamples pixels(list, camera.rows, 0, camera.columns);
  for (std::uint32_t i = 0; i < list.sampleCount(); ++i) {
    if (!isRed(list, i)) continue;
    const glm::dvec3 normal(list.planes[list.plane[i]].normal), from = eye - camera.centreOfProjection;
    const double distance = (1 - glm::dot(normal, from)) / glm::dot(normal, way);
    if (!(distance > 0)) continue;
    const glm::dvec3 at = from + distance * way;
    const double x = (std::atan2(at.y, at.x) - camera.lowAzimuth) / camera.columnPitch();
    const double y = (camera.topElevation - std::atan2(at.z, std::hypot(at.x, at.y))) / camera.rowPitch();
    if (!pixels.holds(int(std::floor(x)), int(std::floor(y)))) continue;
    for (const std::uint32_t own : pixels.at(int(x), int(y)))
      if (own == i &&
          (list.coverage[i] >> (4 * int(4 * (y - std::floor(y))) + int(4 * (x - std::floor(x)))) & 1) != 0)
        return distance;
  }
  return {};
}

/// Of looks from the eye at the facet, from its near to its far edge, those that show it, and how far off
/// their places are at most, metres.
struct Seen {
  int shown = 0, of = 0;
  double off = 0;
};
Seen facetSeenBy(const ColumnCamera& camera, const CaptureSamples& list, const glm::dvec3& eye,
                 const std::function<glm::dvec3(const glm::dvec3&)>& image) {
  Seen seen;
  for (double along = 0.02; along < 1; along += 0.04)
    for (const double height : {1.4, 1.62, 1.9}) {
      const glm::dvec3 point = image({glm::mix(kNear, kFar, along), height});
      const double distance = glm::distance(point, eye);
      ++seen.of;
      if (const auto met = redAlong(camera, list, eye, (point - eye) / distance)) {
        ++seen.shown;
        seen.off = std::max(seen.off, std::abs(*met - distance));
      }
    }
  return seen;
}

TEST(EdgeOnFacets, AreSeenAsWideAsTheyAreByEyesToTheSide) {
  const Baked baked = bakeAsSet(facetBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), coarseFacets());
  const Seen seen = facetSeenBy(baked.columns, baked.capture, kEye, [](const glm::dvec3& p) { return p; });
  EXPECT_GE(seen.shown, 0.95 * seen.of);
  EXPECT_LT(seen.off, 0.06) << "the facet is 0.3 m deep";
  // Beyond its edges it is not seen.
  for (const double along : {-0.6, 1.6}) {
    const glm::dvec3 point(glm::mix(kNear, kFar, along), 1.62);
    EXPECT_FALSE(redAlong(baked.columns, baked.capture, kEye, glm::normalize(point - kEye))) << along;
  }
}

TEST(EdgeOnFacets, CoverAFewPartsOfTheirPixelsAndEachOnce) {
  const Baked baked = bakeAsSet(facetBeforeWall().rays(), cameraAt({0, 0}, {square(0.5)}), coarseFacets());
  const Capture& capture = baked.capture;
  const PixelSamples pixels(capture, baked.columns.rows, 0, baked.columns.columns);
  int parts = 0, twice = 0, rows = 0;
  for (int row = 0; row < baked.columns.rows; ++row) {
    int inRow = 0;
    for (int column = 0; column < baked.columns.columns; ++column) {
      std::uint32_t covered = 0;
      for (const std::uint32_t i : pixels.at(column, row)) {
        if (!isRed(capture, i)) continue;
        twice += std::popcount(covered & capture.coverage[i]);
        covered |= capture.coverage[i];
      }
      inRow += std::popcount(covered);
    }
    parts += inRow, rows += inRow > 0;
  }
  EXPECT_GT(rows, 20);
  EXPECT_LE(parts, 4 * 3 * rows) << "four lines of parts to a row, no more than three parts wide";
  EXPECT_LE(twice, parts / 20) << "its halves are triangles that meet";
}

TEST(EdgeOnFacets, MayBeAllThatACaptureHolds) {
  SceneBuilder builder;
  builder.quad(builder.material(unlit(kRed)), {kFar, 1.2f}, {kNear, 1.2f}, {kNear, 2.1f}, {kFar, 2.1f});
  BakeSettings settings = coarseFacets();
  settings.samplesPerDegree = 2;
  const Baked baked = bakeAsSet(builder.rays(), cameraAt({0, 0}, {square(0.5)}), settings);
  EXPECT_GT(baked.capture.sampleCount(), 0u);
  EXPECT_EQ(baked.counts.keptInAll(), baked.capture.sampleCount());
}

TEST(EdgeOnFacets, ThatNoEyeSeesHaveNoSamples) {
  SceneBuilder builder = facetBeforeWall();
  builder.box(0, {2, -10, -10}, {2.1f, 10, 10});
  const Baked baked = bakeAsSet(builder.rays(), cameraAt({0, 0}, {square(0.5)}), coarseFacets());
  for (std::uint32_t i = 0; i < baked.capture.sampleCount(); ++i) ASSERT_FALSE(isRed(baked.capture, i));
}

TEST(EdgeOnFacets, AreTheSameForAnyNumberOfThreads) {
  const auto scene = facetBeforeWall().rays();
  const LayoutCamera camera = cameraAt({0, 0}, {square(0.5)});
  EXPECT_EQ(bakeAsSet(scene, camera, coarseFacets(), 0).capture,
            bakeAsSet(scene, camera, coarseFacets(), 3).capture);
}

/// The same facet mirrored at the plane x = 6, where a mirror shows it.
TEST(EdgeOnFacets, AreTurnedInMirrorsToo) {
  SceneBuilder builder;
  builder.box(builder.material(unlit({0.5f, 0.5f, 0.5f})), {-20, -40, -30}, {60, 40, 30}, true);
  Material silver;
  silver.baseColour = {1, 1, 1, 1};
  silver.metallic = 1, silver.roughness = 0;
  builder.quad(builder.material(silver), {6, 5, -1}, {6, -5, -1}, {6, -5, 4}, {6, 5, 4});
  const auto mirrored = [](const glm::dvec3& p) { return glm::dvec3(12 - p.x, p.y, p.z); };
  const double factor = (12 - kNear.x) / kNear.x;  // on the same rays of the camera
  const auto behind = [&](const glm::dvec2& p) { return glm::vec2(12 - factor * p.x, factor * p.y); };
  const float low = 1.0f, high = 2.3f;
  const glm::vec2 near = behind(kNear), far = behind(kFar);
  builder.quad(builder.material(unlit(kRed)), {near, low}, {far, low}, {far, high}, {near, high});
  BakeSettings settings = coarseFacets();
  settings.samplesPerDegree = 6;
  const Baked baked = bakeAsSet(builder.rays(), cameraAt({0, 0}, {square(0.5)}), settings);
  int red = 0;
  for (std::uint32_t i = 0; i < baked.capture.reflections.sampleCount(); ++i)
    red += isRed(baked.capture.reflections, i);
  EXPECT_GT(red, 20);
  const Seen seen = facetSeenBy(baked.columns, baked.capture.reflections, kEye, [&](const glm::dvec3& p) {
    const glm::dvec2 plan = factor * glm::dvec2(p);
    return mirrored({12 - plan.x, plan.y, 1.6 + factor * 0.3 * (p.z - 1.6)});
  });
  EXPECT_GE(seen.shown, 0.9 * seen.of);
}

}  // namespace
}  // namespace acentric
