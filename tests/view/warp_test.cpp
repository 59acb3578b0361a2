#include "engine/view/warp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/picture_axes.h"
#include "engine/view/splat_painter.h"
#include "tests/support/print_configuration.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticBox;
using test::AnalyticScene;

using test::cameraAt;
using test::frameOf;
using test::OneCapture;
using test::oneCapture;
using test::paint;
using test::plainSettings;
using test::RandomViews;
using test::shareOfDifferentPixels;

class ListPriority : public testing::TestWithParam<Configuration> {};

TEST_P(ListPriority, PaintsWhatADepthBufferShows) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, 4);
  RandomViews views(11);
  double sum = 0, worst = 0;
  constexpr int kViews = 40;
  for (int i = 0; i < kViews; ++i) {
    const PerspectiveView view = views.next(*layout, region, 60);
    const Frame list = frameOf(scene, view, plainSettings(Renderer::list));
    const Frame nearest = frameOf(scene, view, plainSettings(Renderer::zbuffer));
    EXPECT_EQ(list.holeCount(), nearest.holeCount());
    const double share = test::differingShare(list.colour, nearest.colour);
    sum += share;
    worst = std::max(worst, share);
  }
  RecordProperty("meanDifferingPercent", std::to_string(100 * sum / kViews));
  RecordProperty("worstDifferingPercent", std::to_string(100 * worst));
  EXPECT_LT(sum / kViews, 0.005);
  EXPECT_LT(worst, 0.02);
}

TEST_P(ListPriority, IsTheSameForAnyThreadCountAndKernel) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(6, 40, 3.4), layout, region, 3, 3);
  RandomViews views(13);
  for (double fov : {20.0, 60.0, 140.0, 60.0}) {
    const PerspectiveView view = views.next(*layout, region, fov);
    ViewSettings settings;
    settings.reconstruction = Reconstruction::splat;
    settings.renderer = Renderer::scalar;
    const Frame truth = frameOf(scene, view, settings, 0);
    settings.renderer = Renderer::list;
    for (int workers : {0, 1, 3}) {
      const Frame frame = frameOf(scene, view, settings, workers);
      EXPECT_EQ(frame.colour.pixels, truth.colour.pixels) << fov << " degrees, " << workers << " workers";
      EXPECT_EQ(frame.source.pixels, truth.source.pixels);
      EXPECT_EQ(frame.stats.samplesDrawn, truth.stats.samplesDrawn);
    }
  }
}

TEST_P(ListPriority, InDoublesShowsTheSameButForRounding) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(6, 40, 3.4), layout, region, 3, 3);
  RandomViews views(17);
  constexpr Reconstruction kAll[] = {Reconstruction::point, Reconstruction::splat};
  for (int round = 0; round < 6; ++round) {
    const Reconstruction reconstruction = kAll[round % 2];
    const PerspectiveView view = views.next(*layout, region, 60);
    ViewSettings settings = plainSettings(Renderer::scalar);
    settings.reconstruction = reconstruction;
    const Frame floats = frameOf(scene, view, settings);
    settings.renderer = Renderer::precise;
    const Frame doubles = frameOf(scene, view, settings);
    EXPECT_EQ(doubles.stats.samplesRead, floats.stats.samplesRead);
    const double share = test::differingShare(doubles.colour, floats.colour, 0);
    EXPECT_LT(share, 0.005) << nameOf(reconstruction);
  }
}

INSTANTIATE_TEST_SUITE_P(Configurations, ListPriority, testing::Values(Configuration::b, Configuration::e),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

TEST(Warp, PutsASampleWhereItsPointLies) {
  // One sample, any eye: the splat's centre is the projection of P + (c + t z) / w.
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(-1, 1);
  int seen = 0;
  for (int round = 0; round < 300; ++round) {
    const ColumnCamera camera =
        cameraAt({unit(random), unit(random), 1.6 + unit(random)}, 180 * unit(random), 1, 1);
    const float w = static_cast<float>(std::abs(unit(random)));
    Capture capture{{{0, 1}, {0}, {w}, {packColour({1, 1, 1, 1})}, {1}, {}}, camera, 0, {}, {}};
    PerspectiveView view;
    view.eye = {unit(random), unit(random), 1.6 + unit(random)};
    view.yawRadians = camera.azimuthAt(0.5) + 0.8 * unit(random);
    view.pitchRadians = 0.5 * unit(random);
    view.fovRadians = radians(90);
    OneCapture one;
    one.scene.captures.push_back(std::make_shared<const DisplayCapture>(prepareForDisplay(capture, 1)));
    PieceDraw piece;
    piece.baseline = glm::vec3(camera.centreOfProjection - view.eye);
    piece.maxInverseDistance = {std::numeric_limits<float>::infinity()};
    piece.runs = {{0, 1, true}};
    one.plan.pieces.push_back(piece);
    ViewSettings settings = plainSettings();
    settings.reconstruction = Reconstruction::point;
    const Canvas canvas = paint(one.scene, view, settings, one.plan);

    const glm::dvec3 towards(camera.directionAt(0.5), camera.tangentAt(0.5));
    const glm::dvec3 q =
        view.viewFromWorld() * (towards + static_cast<double>(w) * (camera.centreOfProjection - view.eye));
    const double u = 0.5 * view.width + view.focalPixels() * q.x / q.z,
                 v = 0.5 * view.height + view.focalPixels() * q.y / q.z;
    const bool inside = q.z > 0 && u > 0.5 && u < view.width - 0.5 && v > 0.5 && v < view.height - 0.5;
    std::size_t painted = 0;
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y)
        if (slotOf(canvas.column(x)[y]) != 0) {
          ++painted;
          EXPECT_NEAR(x + 0.5, u, 0.51);
          EXPECT_NEAR(y + 0.5, v, 0.51);
          EXPECT_NEAR(inverseZDepthOf(canvas.column(x)[y]), w / q.z, 1e-4 * (1 + w / q.z));
        }
    if (inside) {
      EXPECT_EQ(painted, 1u);
    }
    seen += inside;
  }
  EXPECT_GT(seen, 100);
}

TEST(Warp, DrawsTheLayersOfAPixelFromFarToNear) {
  const AnalyticScene analytic = test::randomBoxes(14, 90, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  for (const glm::dvec3 offset : {glm::dvec3(0.02, 0.03, 0), glm::dvec3(0, 0, 0), glm::dvec3(0.8, -0.3, 0.3),
                                  glm::dvec3(-0.8, 0.4, -0.4)}) {
    PerspectiveView view;
    view.eye = camera.centreOfProjection + offset;
    view.width = 320, view.height = 240;
    const OneCapture one = oneCapture(analytic, camera, view, 6);
    ASSERT_TRUE(one.scene.captures[0]->layered);
    EXPECT_LT(shareOfDifferentPixels(paint(one.scene, view, plainSettings(), one.plan),
                                     paint(one.scene, view, plainSettings(), one.plan, true)),
              0.01)
        << offset.x;
  }
}

TEST(Warp, BlendsEachPaneOnceOverWhatLiesBehind) {
  // A pane of half-transparent white before a black wall: the pane's pixels are all of the one mixed colour.
  AnalyticScene analytic;
  analytic.floor = false;
  analytic.boxes.push_back({{6, -20, -20}, {7, 20, 20}, {0, 0, 0, 1}});
  analytic.boxes.push_back({{3, -0.8, 0.8}, {3.01, 0.8, 2.4}, {0.7f, 0.7f, 0.7f, 0.5f}});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  for (const glm::dvec3 offset : {glm::dvec3(0), glm::dvec3(0.4, 0.5, 0.1)}) {
    PerspectiveView view;
    view.eye = camera.centreOfProjection + offset;
    view.width = 320, view.height = 240;
    const OneCapture one = oneCapture(analytic, camera, view, 2);
    ASSERT_TRUE(one.scene.captures[0]->blended);
    const Rgba8 tinted =
        blendOver(encodeForDisplay(glm::vec3(unpackColour(packColour({0.7f, 0.7f, 0.7f, 0.5f}))), 1, 0.5f),
                  Rgba8(0, 0, 0, 255));
    for (bool depthTest : {false, true}) {
      const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan, depthTest);
      std::size_t mixed = 0, other = 0;
      for (int x = 0; x < view.width; ++x)
        for (int y = 0; y < view.height; ++y) {
          const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
          const double t = (3 - view.eye.x) / ray.x;
          const glm::dvec3 at = view.eye + t * ray;
          if (std::abs(at.y) > 0.75 || at.z < 0.85 || at.z > 2.35) continue;  // well within the pane
          const Rgba8 pixel = colourOf(static_cast<std::uint32_t>(canvas.column(x)[y]) | 0xff000000u);
          (pixel == tinted ? mixed : other) += 1;
        }
      EXPECT_GT(mixed, 1000u);
      EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(mixed))
          << depthTest << " " << offset.x;
    }
  }
}

TEST(Warp, BlendsEachOfTwoPanesThatNearlyTouch) {
  // 12 cm apart at 3 m: nearer to each other than neighbouring samples of one slanted pane may be.
  AnalyticScene analytic;
  analytic.floor = false;
  analytic.boxes.push_back({{6, -20, -20}, {7, 20, 20}, {0, 0, 0, 1}});
  for (double x : {3.0, 3.12})
    analytic.boxes.push_back({{x, -0.8, 0.8}, {x + 0.01, 0.8, 2.4}, {0.7f, 0.7f, 0.7f, 0.5f}});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = camera.centreOfProjection + glm::dvec3(0.3, 0.2, 0.05);
  view.width = 320, view.height = 240;
  const OneCapture one = oneCapture(analytic, camera, view, 3);
  const Rgba8 pane = encodeForDisplay(glm::vec3(unpackColour(packColour({0.7f, 0.7f, 0.7f, 0.5f}))), 1, 0.5f);
  const Rgba8 tinted = blendOver(pane, blendOver(pane, Rgba8(0, 0, 0, 255)));
  ViewSettings settings = plainSettings();
  settings.reconstruction = Reconstruction::splat;
  const Canvas canvas = paint(one.scene, view, settings, one.plan);
  std::size_t twice = 0, other = 0;
  for (int x = 0; x < view.width; ++x)
    for (int y = 0; y < view.height; ++y) {
      const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
      const glm::dvec3 at = view.eye + (3 - view.eye.x) / ray.x * ray;
      if (std::abs(at.y) > 0.7 || at.z < 0.9 || at.z > 2.3) continue;  // well within both
      const Rgba8 pixel = colourOf(static_cast<std::uint32_t>(canvas.column(x)[y]) | 0xff000000u);
      (pixel == tinted ? twice : other) += 1;
    }
  EXPECT_GT(twice, 1000u);
  EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(twice));
}

TEST(Warp, DoesNotDependOnTheStrips) {
  const AnalyticScene analytic = test::randomBoxes(15, 60, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {0.5, 0.6, 1.9};
  view.pitchRadians = -0.3;
  view.width = 300, view.height = 170;
  const OneCapture one = oneCapture(analytic, camera, view);
  for (Reconstruction reconstruction : {Reconstruction::point, Reconstruction::splat}) {
    ViewSettings settings = plainSettings();
    settings.reconstruction = reconstruction;
    const Canvas whole = paint(one.scene, view, settings, one.plan, false, 1);
    for (int strips : {2, 7, 300})
      EXPECT_EQ(paint(one.scene, view, settings, one.plan, false, strips).pixels, whole.pixels);
  }
}

}  // namespace
}  // namespace acentric
