#include "engine/bake/truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

Material unlit(glm::vec3 colour) {
  Material m = matte(colour);
  m.unlit = true;
  return m;
}

PerspectiveView smallView() {
  PerspectiveView view;
  view.eye = {0, 0, 1};
  view.width = 64;
  view.height = 48;
  return view;
}

TEST(Truth, MeasuresDistancesAlongTheRayThroughEachPixelCentre) {
  SceneBuilder builder;
  builder.quad(builder.material(matte()), {5, 9, -9}, {5, -9, -9}, {5, -9, 9}, {5, 9, 9}).sky(glm::vec3(1));
  const auto scene = builder.rays();
  TaskRunner runner(1);
  const PerspectiveView view = smallView();
  for (const int samples : {1, 4, 9}) {
    const TruthFrame frame = renderTruth(*scene, view, {}, 1, samples, runner);
    for (int y = 0; y < view.height; y += 7)
      for (int x = 0; x < view.width; x += 5)
        EXPECT_NEAR(frame.rayDistance.at(x, y), 5 / view.rayThrough(x + 0.5, y + 0.5).x, 1e-4);
  }
}

TEST(Truth, ShowsTheSkyAtNoDistance) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1, -100).sky(glm::vec3(0.25f));
  TaskRunner runner;
  const TruthFrame frame = renderTruth(*builder.rays(), smallView(), {}, 1, 1, runner);
  EXPECT_EQ(frame.rayDistance.at(10, 10), std::numeric_limits<float>::infinity());
  EXPECT_EQ(frame.colour.at(10, 10), encodeForDisplay(glm::vec3(0.25f), 1));
  EXPECT_EQ(frame.rays.primary, 64u * 48u);
}

TEST(Truth, ComposesBlendedLayersInLinearLightBeforeTheToneCurve) {
  SceneBuilder builder;
  Material film = unlit({1, 0, 0});
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.25f;
  builder.quad(builder.material(film), {2, 9, -9}, {2, -9, -9}, {2, -9, 9}, {2, 9, 9})
      .quad(builder.material(unlit({0, 0.4f, 0.4f})), {5, 99, -99}, {5, -99, -99}, {5, -99, 99}, {5, 99, 99});
  TaskRunner runner;
  const TruthFrame frame = renderTruth(*builder.rays(), smallView(), {}, 1, 1, runner);
  EXPECT_EQ(frame.colour.at(32, 24), encodeForDisplay({0.25f, 0.3f, 0.3f}, 1));
  EXPECT_NEAR(frame.rayDistance.at(32, 24), 5, 0.01) << "the first opaque surface, not the film";
}

TEST(Truth, MoreSamplesPerPixelAverageAnEdge) {
  SceneBuilder builder;
  // White to the left of the view's centre line, black to the right; the middle column of an odd width is
  // half of each.
  builder.quad(builder.material(unlit(glm::vec3(0.5f))), {5, 99, -99}, {5, 0, -99}, {5, 0, 99}, {5, 99, 99})
      .quad(builder.material(unlit(glm::vec3(0))), {5, 0, -99}, {5, -99, -99}, {5, -99, 99}, {5, 0, 99});
  PerspectiveView view = smallView();
  view.width = 65;
  TaskRunner runner;
  const TruthFrame frame = renderTruth(*builder.rays(), view, {}, 1, 16, runner);
  EXPECT_EQ(frame.colour.at(31, 20), encodeForDisplay(glm::vec3(0.5f), 1));
  EXPECT_EQ(frame.colour.at(32, 20), encodeForDisplay(glm::vec3(0.25f), 1));
  EXPECT_EQ(frame.colour.at(33, 20), encodeForDisplay(glm::vec3(0), 1));
}

TEST(ViewDependentPixels, AreThoseOfMetalsMirrorsAndGlass) {
  Material metal = matte(), clear = matte(), glass = matte(), blended = matte();
  metal.metallic = 1, metal.roughness = 0.4f;
  clear.alphaMode = blended.alphaMode = AlphaMode::blend;
  clear.baseColour.a = 0, blended.baseColour.a = 0.5f;
  glass.transmission = 0.9f;
  const auto shareBehind = [](const Material& front, const Material& back) {
    SceneBuilder builder;
    builder.quad(builder.material(front), {4, 9, -9}, {4, -9, -9}, {4, -9, 9}, {4, 9, 9});
    builder.quad(builder.material(back), {5, 12, -12}, {5, -12, -12}, {5, -12, 12}, {5, 12, 12})
        .sky(glm::vec3(1));
    TaskRunner runner(1);
    const Image<std::uint8_t> pixels =
        viewDependentPixels(*builder.rays(), smallView(), smallView().pixels(), runner);
    return double(std::ranges::count(pixels.pixels, 1)) / double(pixels.pixels.size());
  };
  EXPECT_EQ(shareBehind(matte(), metal), 0) << "hidden";
  EXPECT_EQ(shareBehind(metal, matte()), 1);
  EXPECT_EQ(shareBehind(glass, matte()), 1);
  EXPECT_EQ(shareBehind(blended, metal), 1);
  EXPECT_EQ(shareBehind(blended, matte()), 0);
  EXPECT_EQ(shareBehind(clear, matte()), 0);
}

TEST(Exposure, BringsTheTypicalRadianceToMiddleGreyWhateverItsUnit) {
  for (const float level : {0.02f, 1.0f, 300.0f}) {
    SceneBuilder builder;
    builder.box(builder.material(unlit(glm::vec3(level))), {-3, -3, 0}, {3, 3, 3}, true);
    TaskRunner runner(1);
    EXPECT_NEAR(estimateExposure(*builder.rays(), {{0, 0, 1}, {1, 1, 2}}, {}, runner) * level, 0.18f, 1e-4f);
  }
}

TEST(Exposure, IsNotDecidedByOneLampOrABlackCorner) {
  SceneBuilder builder;
  builder.box(builder.material(unlit(glm::vec3(1))), {-3, -3, 0}, {3, 3, 3}, true)
      .box(builder.material(unlit(glm::vec3(1e5f))), {2.5f, 2.5f, 2.5f}, {2.8f, 2.8f, 2.8f})
      .box(builder.material(unlit(glm::vec3(0))), {-2.9f, -2.9f, 0.1f}, {-2, -2, 2});
  TaskRunner runner;
  EXPECT_NEAR(estimateExposure(*builder.rays(), {{0, 0, 1}}, {}, runner), 0.18f, 1e-4f);
}

TEST(Exposure, OfDarknessIsOneAndExtremesAreBounded) {
  TaskRunner runner;
  EXPECT_EQ(estimateExposure(*SceneBuilder().rays(), {{0, 0, 1}}, {}, runner), 1);
  EXPECT_EQ(estimateExposure(*SceneBuilder().rays(), {}, {}, runner), 1);
  SceneBuilder bright;
  bright.box(bright.material(unlit(glm::vec3(1e7f))), {-3, -3, 0}, {3, 3, 3}, true);
  EXPECT_FLOAT_EQ(estimateExposure(*bright.rays(), {{0, 0, 1}}, {}, runner), 1e-4f);
}

TEST(Panorama, LooksAlongXInTheMiddleAndShowsWhatPicturesShow) {
  SceneBuilder builder;
  builder.box(builder.material(unlit({0.5F, 0.25F, 0.125F})), {-4, -3, 0}, {4, 3, 2.5F}, true);
  const auto rays = builder.rays();
  const glm::dvec3 eye(1, 0.5, 1);
  TaskRunner runner(2);
  constexpr int kHeight = 64;
  const Panorama panorama = tracePanorama(*rays, eye, kHeight, {}, runner);
  ASSERT_EQ(panorama.radiance.width, 2 * kHeight);
  const auto inTheRoom = [&](const glm::dvec3& way) {  // to the nearest wall
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec3 low(-4, -3, 0), high(4, 3, 2.5);
    for (int axis = 0; axis < 3; ++axis)
      if (way[axis] != 0)
        nearest = std::min(nearest, ((way[axis] > 0 ? high : low)[axis] - eye[axis]) / way[axis]);
    return nearest;
  };
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 2 * kHeight; ++x) {
      // From the middle column to the left: 0 to pi, as azimuths grow; from the top: zenith to nadir.
      const double azimuth = (kHeight - (x + 0.5)) / kHeight * kPi, polar = (y + 0.5) / kHeight * kPi;
      const glm::dvec3 way(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                           std::cos(polar));
      EXPECT_NEAR(panorama.rayDistance.at(x, y), inTheRoom(way), 1e-4) << x << ", " << y;
      EXPECT_NEAR(panorama.radiance.at(x, y).g, 0.25, 1e-6);
    }
}

}  // namespace
}  // namespace acentric
