#include "engine/view/warp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic_scene.h"
#include "engine/view/column_order.h"
#include "engine/view/render.h"

namespace acentric {
namespace {

using test::AnalyticBox;
using test::AnalyticScene;

struct RandomViews {
  std::mt19937 random;
  explicit RandomViews(unsigned seed) : random(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  PerspectiveView next(const Layout& layout, int region, double fovDegrees) {
    const ConvexPolygon& polygon = layout.regions[static_cast<std::size_t>(region)].polygon;
    PerspectiveView view;
    view.eye = glm::dvec3(test::randomPointIn(polygon, random), layout.eyeZ() + between(-0.8, 0.8));
    view.yawRadians = between(0, kTwoPi);
    view.pitchRadians = between(-0.5, 0.5);
    view.fovRadians = radians(fovDegrees);
    view.width = 320;
    view.height = 200;
    return view;
  }
};

ViewSettings plainSettings(Renderer renderer = Renderer::list) {
  ViewSettings settings;
  settings.renderer = renderer;
  settings.secondaryCover = false;
  settings.fillHoles = false;
  return settings;
}

Frame frameOf(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
              int workers = 0) {
  TaskRunner runner(workers);
  auto frame = renderFrame(scene, view, settings, runner);
  if (!frame) {
    ADD_FAILURE() << frame.error().describe();
    return {};
  }
  return std::move(*frame);
}

/// One camera over a square region around the origin, for views that need no cover.
struct OneCapture {
  WalkScene scene;
  ViewPlan plan;
};

Canvas paint(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
             const ViewPlan& plan, bool depthTest = false, int bands = 4) {
  bool blended = false;
  for (const auto& capture : scene.captures) blended = blended || (capture && capture->blended);
  Canvas canvas = makeCanvas(view, blended);
  TaskRunner runner(0);
  WarpOptions options;
  options.depthTest = depthTest;
  options.bands = bands;
  warpPieces(scene, view, settings, plan, options, canvas, runner);
  return canvas;
}

/// A plan that draws one capture whole, in list priority order, without culling.
OneCapture oneCapture(const AnalyticScene& analytic, const ColumnCamera& camera, const PerspectiveView& view,
                      int layers = 1) {
  OneCapture one;
  one.scene.captures.push_back(std::make_shared<const DisplayCapture>(
      prepareForDisplay(test::capture(analytic, camera, nullptr, layers), 1)));
  PieceDraw piece;
  piece.baseline = glm::vec3(camera.centreOfProjection - view.eye);
  piece.maxInverseDistance.assign(static_cast<std::size_t>(camera.columns),
                                  std::numeric_limits<float>::infinity());
  piece.runs = columnOrder(camera, glm::dvec2(view.eye) - glm::dvec2(camera.centreOfProjection)).runs;
  one.plan.pieces.push_back(piece);
  return one;
}

ColumnCamera cameraAt(const glm::dvec3& centre, double middleDegrees, int columns = 240, int rows = 480) {
  ColumnCamera camera;
  camera.centreOfProjection = centre;
  camera.fovRadians = radians(60);
  camera.lowAzimuth = radians(middleDegrees - 30);
  camera.topElevation = radians(60);
  camera.bottomElevation = -radians(60);
  camera.columns = columns;
  camera.rows = rows;
  return camera;
}

double shareOfDifferentPixels(const Canvas& a, const Canvas& b) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    differing += (a.pixels[i] & 0xffffffff) != (b.pixels[i] & 0xffffffff);
  return static_cast<double>(differing) / static_cast<double>(a.pixels.size());
}

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

TEST_P(ListPriority, HoldsForEveryFieldOfView) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(5, 60, 3.4), layout, region, 3);
  RandomViews views(12);
  for (double fov : {1.0, 30.0, 59.999, 60.0, 90.0, 120.0, 150.0, 179.0}) {
    const PerspectiveView view = views.next(*layout, region, fov);
    const Frame list = frameOf(scene, view, plainSettings(Renderer::list));
    const Frame nearest = frameOf(scene, view, plainSettings(Renderer::zbuffer));
    EXPECT_LT(test::differingShare(list.colour, nearest.colour), 0.02) << fov;
  }
}

TEST_P(ListPriority, IsTheSameForAnyThreadCountAndKernel) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(6, 40, 3.4), layout, region, 3, 3);
  RandomViews views(13);
  for (double fov : {20.0, 60.0, 140.0}) {
    const PerspectiveView view = views.next(*layout, region, fov);
    ViewSettings settings;
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

INSTANTIATE_TEST_SUITE_P(Configurations, ListPriority, testing::Values(Configuration::b, Configuration::e),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

TEST(ProjectSamples, GivesTheSameBitsOneAtATimeAndEightAtATime) {
  std::mt19937 random(21);
  const auto uniform = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  std::vector<float> tangents(300);
  for (float& t : tangents) t = uniform(-2, 2);
  for (int round = 0; round < 400; ++round) {
    ProjectColumn column{};
    for (int i = 0; i < 3; ++i)
      column.a[i] = uniform(-300, 300), column.z[i] = uniform(-300, 300), column.b[i] = uniform(-300, 300);
    for (float* p : {column.a, column.z, column.b}) p[2] /= 300;
    column.maxInverseDistance = round % 3 == 0 ? 0.5f : std::numeric_limits<float>::infinity();
    column.footprint = round % 5 == 0 ? 0 : uniform(0, 20);
    column.maxSide = 16;
    column.centreX = 320, column.centreY = 200, column.inverseFocal = 1 / uniform(100, 500);
    column.x0 = 0, column.y0 = 50, column.x1 = 640, column.y1 = 300;
    column.partTest = static_cast<PartTest>(round % 3);
    for (float* p : {column.direction, column.baseline, column.low, column.high})
      p[0] = uniform(-1, 1), p[1] = uniform(-1, 1);
    const int count = 1 + round % 70;
    std::vector<std::uint16_t> rows;
    std::vector<float> inverse;
    for (int i = 0; i < count; ++i) {
      rows.push_back(static_cast<std::uint16_t>(random() % tangents.size()));
      const float specials[] = {0, 1e30f, std::numeric_limits<float>::infinity(), std::nanf(""), 1e-40f};
      inverse.push_back(random() % 8 == 0 ? specials[random() % 5] : uniform(0, 1));
    }
    std::vector<Splat> one(static_cast<std::size_t>(count) + 8), eight(one.size());
    const int n1 =
        projectSamplesScalar(column, tangents.data(), rows.data(), inverse.data(), count, 7, one.data());
    const int n8 =
        fastestProjectSamples()(column, tangents.data(), rows.data(), inverse.data(), count, 7, eight.data());
    ASSERT_EQ(n1, n8);
    for (int i = 0; i < n1; ++i) {
      const Splat &a = one[static_cast<std::size_t>(i)], &b = eight[static_cast<std::size_t>(i)];
      ASSERT_EQ(a.x, b.x);
      ASSERT_EQ(a.y, b.y);
      ASSERT_EQ(a.side, b.side);
      ASSERT_EQ(a.index, b.index);
      ASSERT_EQ(a.inverseZDepth, b.inverseZDepth);
      EXPECT_GE(a.side, 1);
      EXPECT_LE(a.side, 16);
    }
  }
}

TEST(Warp, AtTheCentreOfProjectionIsThePictureItself) {
  // Seen from P nothing moves: each sample's pixel holds its colour (points), whatever its distance.
  AnalyticScene analytic = test::randomBoxes(8, 40, 2);
  const ColumnCamera camera = cameraAt({0.3, -0.2, 1.6}, 40);
  PerspectiveView view;
  view.eye = camera.centreOfProjection;
  view.yawRadians = radians(40);
  view.fovRadians = radians(50);
  view.width = 400, view.height = 260;
  const OneCapture one = oneCapture(analytic, camera, view);
  const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan);
  std::size_t wrong = 0;
  const glm::dmat3 m = view.viewFromWorld();
  for (int x = 0; x < view.width; ++x)
    for (int y = 0; y < view.height; ++y) {
      const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
      const double column = wrapAngle(std::atan2(ray.y, ray.x) - camera.lowAzimuth) / camera.columnPitch();
      const double row = (camera.topElevation - std::asin(ray.z)) / camera.rowPitch();
      // The nearest sample, or a direct neighbour where its splat lies on top.
      const CanvasPixel pixel = canvas.column(x)[y];
      ASSERT_NE(slotOf(pixel), 0u);
      bool found = false;
      for (int dk = -2; dk <= 2; ++dk)
        for (int dr = -2; dr <= 2; ++dr) {
          const glm::dvec3 d(camera.directionAt(std::floor(column) + dk + 0.5),
                             camera.tangentAt(std::floor(row) + dr + 0.5));
          const auto hits = analytic.along(view.eye, d, 0);
          const glm::vec4 colour =
              unpackColour(packColour(hits.empty() ? analytic.skyColour : hits[0].colour));
          const Rgba8 expected = encodeForDisplay(glm::vec3(colour), 1);
          const double w = hits.empty() ? 0 : 1 / hits[0].distance;
          found = found || (colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u) == expected &&
                            std::abs(inverseZDepthOf(pixel) - w / (m * d).z) < 1e-4);
        }
      wrong += !found;
    }
  EXPECT_EQ(wrong, 0u);
}

TEST(Warp, PutsASampleWhereItsPointLies) {
  // One sample, any eye: the splat's centre is the projection of P + (c + t z) / w.
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(-1, 1);
  int seen = 0;
  for (int round = 0; round < 300; ++round) {
    const ColumnCamera camera =
        cameraAt({unit(random), unit(random), 1.6 + unit(random)}, 180 * unit(random), 1, 1);
    const float w = static_cast<float>(std::abs(unit(random)));
    Capture capture{camera, {0, 1}, {0}, {w}, {packColour({1, 1, 1, 1})}};
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

TEST(Warp, HoldsStraightAboveAndBelowTheCamera) {
  const AnalyticScene analytic = test::randomBoxes(9, 60, 1.2);
  for (double height : {0.4, 1.0, 2.4, 2.8}) {
    const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
    PerspectiveView view;
    view.eye = {0, 0, height};
    view.width = 320, view.height = 240;
    view.pitchRadians = height > 1.6 ? -0.4 : 0.2;
    const OneCapture one = oneCapture(analytic, camera, view);
    for (Reconstruction reconstruction : {Reconstruction::point, Reconstruction::splat}) {
      ViewSettings settings = plainSettings();
      settings.reconstruction = reconstruction;
      const double share = shareOfDifferentPixels(paint(one.scene, view, settings, one.plan),
                                                  paint(one.scene, view, settings, one.plan, true));
      // Columns have no order among themselves here, so splats overlap by chance along upright edges.
      EXPECT_LT(share, reconstruction == Reconstruction::point ? 0.002 : 0.015) << height;
    }
  }
}

TEST(Warp, HoldsWithTheEpipoleOnAColumnsEdgeAndInItsMiddle) {
  const AnalyticScene analytic = test::randomBoxes(10, 60, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  for (double column : {0.0, 0.5, 120.0, 120.5, 239.5, 240.0, -3.0, 250.0})
    for (double side : {1.0, -1.0}) {  // the eye ahead of the camera, and behind it
      PerspectiveView view;
      view.eye =
          camera.centreOfProjection + glm::dvec3(side * 0.9 * directionOf(camera.azimuthAt(column)), 0.2);
      view.width = 320, view.height = 240;
      const OneCapture one = oneCapture(analytic, camera, view);
      EXPECT_LT(shareOfDifferentPixels(paint(one.scene, view, plainSettings(), one.plan),
                                       paint(one.scene, view, plainSettings(), one.plan, true)),
                0.006)
          << column << " " << side;
    }
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

TEST(Warp, ShowsSkyAtInfinityWhereverTheEyeIs) {
  AnalyticScene analytic;
  analytic.floor = false;
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {0.9, -0.7, 2.2};
  view.width = 200, view.height = 120;
  view.fovRadians = radians(45);
  const OneCapture one = oneCapture(analytic, camera, view);
  const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan);
  const Rgba8 sky = encodeForDisplay(glm::vec3(unpackColour(packColour(analytic.skyColour))), 1);
  for (CanvasPixel pixel : canvas.pixels) {
    ASSERT_EQ(colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u), sky);
    ASSERT_EQ(inverseZDepthOf(pixel), 0.0f);
  }
}

TEST(Warp, DoesNotDependOnTheBands) {
  const AnalyticScene analytic = test::randomBoxes(15, 60, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {0.5, 0.6, 1.9};
  view.pitchRadians = -0.3;
  view.width = 300, view.height = 170;
  const OneCapture one = oneCapture(analytic, camera, view);
  const Canvas whole = paint(one.scene, view, plainSettings(), one.plan, false, 1);
  for (int bands : {2, 7, 170})
    EXPECT_EQ(paint(one.scene, view, plainSettings(), one.plan, false, bands).pixels, whole.pixels);
}

}  // namespace
}  // namespace acentric
