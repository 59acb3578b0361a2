#include "engine/view/view_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic_scene.h"
#include "engine/view/column_culling.h"
#include "engine/view/column_order.h"
#include "engine/view/hole_fill.h"
#include "engine/view/render.h"

namespace acentric {
namespace {

TEST(ColumnCulling, NeverDropsAVisibleSample) {
  std::mt19937 random(2);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int visible = 0, culled = 0;
  for (int round = 0; round < 3000; ++round) {
    PerspectiveView view;
    view.yawRadians = uniform(0, kTwoPi);
    view.pitchRadians = uniform(-1.5, 1.5);
    const double fovs[] = {0.2, 1, 60, 120, 179.9};
    view.fovRadians = radians(fovs[round % 5]);
    const int x0 = static_cast<int>(uniform(0, 900)), y0 = static_cast<int>(uniform(0, 500));
    const PixelRect rect = round % 2 == 0 ? PixelRect{0, 0, 960, 540} : PixelRect{x0, y0, x0 + 60, y0 + 40};
    const FrustumPlanes planes = frustumPlanes(view, rect, 0);
    const glm::dvec3 b(uniform(-3, 3), uniform(-3, 3), uniform(-1, 1));
    const double azimuth = round % 5 < 2 ? view.yawRadians + uniform(-0.02, 0.02) : uniform(0, kTwoPi);
    const glm::dvec2 c = directionOf(azimuth), range(uniform(0, 0.3), uniform(0.3, 2));
    const TangentRange all{-1.7, 1.7};
    const auto kept = visibleTangents(planes, c, b, range, all);
    culled += !kept.has_value();
    for (int i = 0; i < 60; ++i) {
      const double t = uniform(all.low, all.high), w = uniform(range.x, range.y);
      const glm::dvec3 q = view.viewFromWorld() * (glm::dvec3(c, t) + w * b);
      if (q.z <= 0) continue;
      const double u = 480 + view.focalPixels() * q.x / q.z, v = 270 + view.focalPixels() * q.y / q.z;
      if (u < rect.x0 || u >= rect.x1 || v < rect.y0 || v >= rect.y1) continue;
      ++visible;
      ASSERT_TRUE(kept.has_value());
      EXPECT_GE(t, kept->low);
      EXPECT_LE(t, kept->high);
    }
  }
  EXPECT_GT(visible, 1000);
  EXPECT_GT(culled, 500);
}

TEST(ColumnOrder, DrawsEachColumnOnceAndTheNearestToTheEpipoleLast) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  ColumnCamera camera;
  camera.columns = 37;
  camera.rows = 10;
  camera.fovRadians = radians(60);
  for (int round = 0; round < 500; ++round) {
    camera.lowAzimuth = 4 * unit(random);
    const glm::dvec2 e(unit(random), unit(random));
    const ColumnOrder order = columnOrder(camera, e);
    std::vector<int> drawn;
    for (const ColumnRun& run : order.runs)
      for (int n = 0; n < run.last - run.first; ++n)
        drawn.push_back(run.ascending ? run.first + n : run.last - 1 - n);
    std::vector<int> sorted = drawn;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), 37u);
    for (int k = 0; k < 37; ++k) ASSERT_EQ(sorted[static_cast<std::size_t>(k)], k);
    // On either side of the epipole the angle to it never grows.
    const auto signedAngle = [&](int k) {
      return std::remainder(camera.azimuthAt(k + 0.5) - std::atan2(e.y, e.x), kTwoPi);
    };
    for (double side : {-1.0, 1.0}) {
      double last = 4;
      for (int k : drawn) {
        if (signedAngle(k) * side < 0) continue;
        EXPECT_LE(std::abs(signedAngle(k)), last + 1e-12);
        last = std::abs(signedAngle(k));
      }
    }
  }
}

TEST(ColumnOrder, RowsGoTheWayTheEpipoleLies) {
  // Along the great circle towards e the elevation rises exactly where the rule says that it does.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 2000; ++round) {
    const glm::dvec3 e(unit(random), unit(random), unit(random));
    const glm::dvec2 c = directionOf(4 * unit(random));
    const double t = 2 * unit(random);
    const glm::dvec3 d = glm::normalize(glm::dvec3(c, t));
    const glm::dvec3 step = glm::normalize(d + 1e-6 * glm::normalize(e));
    const double rise = step.z - d.z;
    if (std::abs(rise) < 1e-8) continue;
    const RowOrder order = rowOrder(c, e);
    const bool above = t > static_cast<double>(order.pivotTangent);
    EXPECT_EQ(rise > 0, order.inwards ? !above : above);
  }
}

TEST(ColumnOrder, TheFootIsWhereAColumnComesNearestToTheEyeAndNoSampleLiesBeforeOneBehindTheCamera) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-3, 3);
  int ahead = 0, behind = 0;
  for (int round = 0; round < 500; ++round) {
    const glm::dvec3 e(unit(random), unit(random), unit(random));
    const glm::dvec2 c = directionOf(unit(random));
    double nearest = 0;  // of places along the column, from the camera out to beyond any foot
    for (double distance = 0; distance < 5; distance += 1e-3)
      if (glm::distance(c * distance, glm::dvec2(e)) < glm::distance(c * nearest, glm::dvec2(e)))
        nearest = distance;
    const RowOrder order = rowOrder(c, e);
    if (nearest < 0.01) {
      behind += nearest == 0;
      if (nearest == 0) {
        EXPECT_GT(order.footInverse, 1000) << round;
      }
    } else {
      EXPECT_NEAR(1 / double(order.footInverse), nearest, 1e-3) << round;
      ++ahead;
    }
  }
  EXPECT_GT(ahead, 100);
  EXPECT_GT(behind, 100);
}

TEST(ViewPlan, RefusesAnEyeOutsideAndNamesTheNearestPoint) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  ASSERT_NE(layout, nullptr);
  WalkScene scene;
  scene.layout = layout;
  PerspectiveView view;
  view.eye = {100, 0, 1.6};
  const auto plan = planView(scene, view, {});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("nearest point"), std::string::npos) << plan.error().message;
  view.eye = {0, 0, 1.6};
  view.fovRadians = 4;
  EXPECT_FALSE(planView(scene, view, {}));
  ViewSettings settings;
  settings.maxSplatPixels = 0;
  view.fovRadians = 1;
  EXPECT_FALSE(planView(scene, view, settings));
}

TEST(ViewPlan, CountsWhatIsNotLoadedAndLeavesHolesThere) {
  WalkScene scene;
  scene.layout = test::layoutAroundOrigin(Configuration::b);
  ASSERT_NE(scene.layout, nullptr);
  PerspectiveView view;
  view.eye = {0.1, 0.2, 1.6};
  view.width = 64, view.height = 36;
  TaskRunner runner(0);
  const auto frame = renderFrame(scene, view, {}, runner);
  ASSERT_TRUE(frame) << frame.error().describe();
  EXPECT_GE(frame->stats.missingImages, 2);
  EXPECT_EQ(frame->stats.images, 0);
  EXPECT_EQ(frame->holeCount(), 64u * 36u);
  EXPECT_EQ(frame->holeMask().at(3, 4), Rgba8(255));
  ViewSettings gl;
  gl.renderer = Renderer::gl;
  EXPECT_FALSE(renderFrame(scene, view, gl, runner));
}

TEST(ViewPlan, LimitsSamplesToWhatLiesBeyondTheGrownRegion) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const Region& home = layout->regions[static_cast<std::size_t>(region)];
  const WalkScene scene = test::walkScene(test::randomBoxes(1, 5, 4), layout, region, 1);
  PerspectiveView view;
  view.eye = {0.1, 0.05, 1.6};
  view.fovRadians = radians(100);
  const auto plan = planView(scene, view, {});
  ASSERT_TRUE(plan);
  int secondary = 0;
  for (std::size_t i = 0; i < plan->pieces.size(); ++i) {
    const PieceDraw& piece = plan->pieces[i];
    secondary += piece.secondary;
    if (i > 0 && piece.secondary) {
      EXPECT_TRUE(plan->pieces[i - 1].secondary) << "the other hand is painted first";
    }
    const ColumnCamera& camera = scene.captures[static_cast<std::size_t>(piece.camera)]->camera;
    for (int k = 0; k < camera.columns; ++k) {
      // Samples are drawn from a little within on, where surfaces that cross the border have their last one.
      const double nearest = 1 / static_cast<double>(piece.maxInverseDistance[static_cast<std::size_t>(k)]);
      const double exit = nearest / (1 - kBorderOverlap);
      const glm::dvec2 centre(camera.centreOfProjection), c = camera.directionAt(k + 0.5);
      EXPECT_TRUE(home.grown.containsClosed(centre + exit * 0.999 * c));
      EXPECT_FALSE(home.grown.containsClosed(centre + exit * 1.001 * c));
    }
  }
  EXPECT_GT(secondary, 0);
  EXPECT_LT(secondary, static_cast<int>(plan->pieces.size()));
}

TEST(HoleFill, ContinuesTheFartherSideAndMarksWhatItMadeUp) {
  // Left of the hole something near and red, right of it a far blue wall.
  Frame frame;
  frame.colour = ColourImage(20, 5, Rgba8(0));
  frame.source = Image<PixelSource>(20, 5, kSourceHole);
  FloatImage inverseZDepth(20, 5, 0.0f);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 20; ++x) {
      if (x >= 8 && x < 11) continue;
      frame.colour.at(x, y) = x < 8 ? Rgba8(255, 0, 0, 255) : Rgba8(0, 0, 255, 255);
      frame.source.at(x, y) = PixelSource(x < 8 ? 1 : 2);
      inverseZDepth.at(x, y) = x < 8 ? 1.0f : 0.1f;
    }
  TaskRunner runner(2);
  fillHoles(frame, inverseZDepth, 100, runner);
  EXPECT_EQ(frame.holeCount(), 15u);
  for (int y = 0; y < 5; ++y) {
    for (int x = 8; x < 11; ++x) {
      EXPECT_EQ(frame.colour.at(x, y), Rgba8(0, 0, 255, 255)) << "up to the edge that the hole lies behind";
      EXPECT_EQ(frame.source.at(x, y), kSourceInvented);
    }
    EXPECT_EQ(frame.source.at(7, y), 1);
  }
}

TEST(HoleFill, ReachesAcrossHolesWiderThanItsLines) {
  Frame frame;
  frame.colour = ColourImage(300, 200, Rgba8(0));
  frame.source = Image<PixelSource>(300, 200, kSourceHole);
  FloatImage inverseZDepth(300, 200, 0.0f);
  for (int y = 0; y < 200; ++y)
    for (const int x : {0, 299}) {
      frame.colour.at(x, y) = Rgba8(x == 0 ? 50 : 100, 0, 0, 255);
      frame.source.at(x, y) = 1;
      inverseZDepth.at(x, y) = 0.1f;
    }
  TaskRunner runner(2);
  fillHoles(frame, inverseZDepth, 4096, runner);
  for (int y = 0; y < 200; ++y)
    for (int x = 1; x < 299; ++x) {
      ASSERT_EQ(frame.source.at(x, y), kSourceInvented);
      ASSERT_GE(frame.colour.at(x, y).r, 50);
      ASSERT_LE(frame.colour.at(x, y).r, 100);
    }
}

TEST(HoleFill, TakesLocalGeometryOnlyWhereNothingElseIsNear) {
  for (bool background : {true, false}) {
    Frame frame;
    frame.colour = ColourImage(9, 1, Rgba8(0));
    frame.source = Image<PixelSource>(9, 1, kSourceHole);
    FloatImage inverseZDepth(9, 1, 0.0f);
    frame.colour.at(0, 0) = Rgba8(10, 20, 30, 255);
    frame.source.at(0, 0) = kSourceLocal;
    inverseZDepth.at(0, 0) = 0.01f;
    if (background) {
      frame.colour.at(8, 0) = Rgba8(200, 100, 50, 255);
      frame.source.at(8, 0) = 3;
      inverseZDepth.at(8, 0) = 0.5f;
    }
    TaskRunner runner(2);
    fillHoles(frame, inverseZDepth, 100, runner);
    EXPECT_EQ(frame.colour.at(1, 0), background ? Rgba8(200, 100, 50, 255) : Rgba8(10, 20, 30, 255));
    EXPECT_EQ(frame.source.at(1, 0), kSourceInvented);
  }
}

TEST(DisplayCapture, KnowsItsRangesLayersAndColours) {
  ColumnCamera camera;
  camera.fovRadians = radians(30);
  camera.topElevation = 0.4;
  camera.bottomElevation = -0.4;
  camera.columns = 3;
  camera.rows = 2;
  const HalfColour white = packColour({0.5f, 0.25f, 0.125f, 1}), glass = packColour({0.5f, 0.5f, 0.5f, 0.5f});
  const Capture capture{{{0, 2, 2, 5},
                         {0, 1, 0, 0, 1},
                         {0.5f, 0, 2, 1, 0.25f},
                         {white, white, glass, white, white},
                         {1, 2, 4, 1, 1},
                         {}},
                        camera,
                        0,
                        {},
                        {}};
  const DisplayCapture display = prepareForDisplay(capture, 2);
  EXPECT_TRUE(display.layered);
  EXPECT_TRUE(display.blended);
  EXPECT_EQ(display.columnRange[0], glm::vec2(0, 0.5f));
  EXPECT_GT(display.columnRange[1].x, display.columnRange[1].y);
  EXPECT_EQ(display.columnRange[2], glm::vec2(0.25f, 2));
  EXPECT_EQ(display.colour[0], encodeForDisplay({0.5f, 0.25f, 0.125f}, 2));
  EXPECT_EQ(display.colour[2].a, 128);
  EXPECT_NEAR(display.rowTangent[0], std::tan(0.2), 1e-6);
  EXPECT_NEAR(display.columnDirection[2].y, std::sin(radians(25)), 1e-6);
}

TEST(ViewSettings, NamesEveryRendererBothWays) {
  for (Renderer renderer : kRenderers) EXPECT_EQ(*parseRenderer(nameOf(renderer)), renderer);
  EXPECT_FALSE(parseRenderer("fast"));
}

}  // namespace
}  // namespace acentric
