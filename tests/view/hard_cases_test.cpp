/// Where a frame's numbers go wrong: epipoles, depths, fields of view, eyes on borders, places far out. Each
/// case is checked on the real thing and on a deliberately naive variant that must fail.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/view/hole_fill.h"
#include "tests/support/print_configuration.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticScene;
using test::cameraAt;
using test::frameOf;
using test::OneCapture;
using test::oneCapture;
using test::paint;
using test::plainSettings;
using test::RandomViews;
using test::shareOfDifferentPixels;

// ---- Naive painters --------------------------------------------------------------------------------------

/// Share of the pixels that show another sample than the nearest when a capture is painted column by column,
/// each from the top row down.
double shareOutOfOrder(const AnalyticScene& scene, const ColumnCamera& camera, const PerspectiveView& view) {
  const Capture capture = test::capture(scene, camera, nullptr);
  const std::size_t size = std::size_t(view.width) * std::size_t(view.height);
  std::vector<int> last(size, -1), nearest(size, -1);
  std::vector<double> inverse(size, -1);
  const glm::dmat3 m = view.viewFromWorld();
  for (int k = 0; k < camera.columns; ++k)
    for (std::uint32_t i = capture.columnStart[std::size_t(k)]; i < capture.columnStart[std::size_t(k) + 1];
         ++i) {
      const double w = capture.inverseDistance[i];
      const glm::dvec3 q =
          m * (glm::dvec3(camera.directionAt(k + 0.5), camera.tangentAt(capture.row[i] + 0.5)) +
               w * (camera.centreOfProjection - view.eye));
      if (!(q.z > 0)) continue;
      const double x = 0.5 * view.width + view.focalPixels() * q.x / q.z;
      const double y = 0.5 * view.height + view.focalPixels() * q.y / q.z;
      if (!(x >= 0 && y >= 0 && x < view.width && y < view.height)) continue;
      const std::size_t pixel = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
      last[pixel] = int(i);
      if (w / q.z > inverse[pixel]) inverse[pixel] = w / q.z, nearest[pixel] = int(i);
    }
  std::size_t wrong = 0, painted = 0;
  for (std::size_t p = 0; p < size; ++p) {
    if (last[p] < 0) continue;
    ++painted;
    wrong += capture.colour[std::size_t(last[p])] != capture.colour[std::size_t(nearest[p])];
  }
  return double(wrong) / double(painted);
}

// ---- Epipole ---------------------------------------------------------------------------------------------

TEST(HardCases, AnEyeAtTheCentreOfProjectionSeesThePictureItselfWhereAUnitVectorToItIsNotANumber) {
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
  EXPECT_EQ(columnOrder(camera, glm::dvec2(0)).runs.size(), 1u) << "any order is right";
  // Naively: the angle of each column from the unit vector towards the eye.
  const glm::dvec2 towards = glm::normalize(glm::dvec2(view.eye) - glm::dvec2(camera.centreOfProjection));
  int ordered = 0;
  for (int k = 0; k < camera.columns; ++k)
    ordered += std::acos(glm::dot(towards, camera.directionAt(k + 0.5))) <= kPi;
  EXPECT_EQ(ordered, 0);
}

TEST(HardCases, AnEyeStraightAboveOrBelowHasNoAzimuthAndRowsStillComeInTheRightOrder) {
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
    // Naively: rows as they are stored, from the top, is right for eyes below the camera only.
    const double naive = shareOutOfOrder(analytic, camera, view);
    if (height > 1.6) {
      EXPECT_GT(naive, 0.01) << height;
    }
  }
}

TEST(HardCases, TheEpipoleOnTheEdgeOfAColumnInItsMiddleOrBesideAllOfThemNeedsTwoRuns) {
  const AnalyticScene analytic = test::randomBoxes(10, 60, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  double worstNaive = 0;
  int naiveFailures = 0;
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
      // Naively: from one end to the other, wherever the epipole is.
      OneCapture naive = one;
      naive.plan.pieces[0].runs = {{0, camera.columns, true}};
      const double share = shareOfDifferentPixels(paint(naive.scene, view, plainSettings(), naive.plan),
                                                  paint(one.scene, view, plainSettings(), one.plan, true));
      naiveFailures += share > 0.006;
      worstNaive = std::max(worstNaive, share);
    }
  EXPECT_GE(naiveFailures, 6) << "of 16";
  EXPECT_GT(worstNaive, 0.03);
}

TEST(HardCases, SurfacesBetweenTheCameraAndTheEyeComeInTheOrderOfTheEyeAndNotOfTheCamera) {
  // The eye looks back at the camera. Both walls stand before the foot of its perpendicular: of one pixel's
  // samples the one farther from the camera is nearer to the eye.
  AnalyticScene analytic;
  analytic.floor = false;
  const glm::vec4 red(0.7f, 0.05f, 0.05f, 1), blue(0.05f, 0.05f, 0.7f, 1);
  analytic.boxes.push_back({{1, -1, 0.6}, {1.01, 1, 2.6}, red});
  analytic.boxes.push_back({{2, -1, 0.6}, {2.01, 1, 2.6}, blue});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {4, 0, 1.6};
  view.yawRadians = kPi;
  view.fovRadians = radians(10);
  view.width = 161, view.height = 121;
  const OneCapture one = oneCapture(analytic, camera, view, 2);
  const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan);
  const auto colourAt = [&](int x, int y) {
    return colourOf(static_cast<std::uint32_t>(canvas.column(x)[y]) | 0xff000000u);
  };
  const Rgba8 near = encodeForDisplay(glm::vec3(unpackColour(packColour(blue))), 1);
  for (int x = 79; x <= 81; ++x)
    for (int y = 59; y <= 61; ++y) EXPECT_EQ(colourAt(x, y), near) << x << " " << y;
  // Naively, the farther from the camera, the farther from the eye: right only beyond the foot.
  EXPECT_LT(rowOrder({1, 0}, view.eye - camera.centreOfProjection).footInverse, 1.0 / 2);
}

// ---- Depth -----------------------------------------------------------------------------------------------

TEST(HardCases, SkyAtInfinityStaysWhereItIsAndSkyAtAFarPlaneDoesNot) {
  AnalyticScene analytic;
  analytic.floor = false;
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {0.9, -0.7, 2.2};
  view.width = 200, view.height = 120;
  view.fovRadians = radians(45);
  const OneCapture one = oneCapture(analytic, camera, view);
  const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan);
  const Rgba8 sky = encodeForDisplay(glm::vec3(analytic.skyColour), 1);
  for (CanvasPixel pixel : canvas.pixels) {
    ASSERT_EQ(colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u), sky);
    ASSERT_EQ(inverseZDepthOf(pixel), 0.0f);
  }
  // A cloud's edge, the eye 1 m aside: sky of w = 0 does not move, sky on a sphere of 100 m moves by pixels.
  const auto moved = [&](double w) {
    const glm::dvec3 direction(camera.directionAt(100.5), 0.1);
    const auto across = [&](const glm::dvec3& q) { return view.focalPixels() * q.x / q.z; };
    const glm::dvec3 from = view.viewFromWorld() * direction,
                     to = view.viewFromWorld() * (direction - w * glm::dvec3(0, 1, 0));
    return std::abs(across(to) - across(from));
  };
  EXPECT_EQ(moved(0), 0);
  EXPECT_GT(moved(1.0 / 100), 2);
}

TEST(HardCases, OneMillimetreAndTenKilometresShareAnImageByInverseDistanceAndNotByEvenSteps) {
  // The stored w has 16 bits, relative: moving the eye by b shifts a sample's pixel by f b w at most, known
  // to f b w 2^-16. Even steps of distance or of w over the same range are off by pixels at one end of it.
  const double focal = 800, nearest = 1e-3, farthest = 1e4;
  const auto sixteenBits = [](double value, double most) {
    return std::round(value / most * 65535) * most / 65535;
  };
  double worst = 0, worstEvenDistance = 0, worstEvenInverse = 0;
  for (double distance = nearest; distance <= farthest; distance *= 1.37) {
    const double b = 0.4 * distance, w = 1 / distance;
    const auto pixel = [&](double inverseDistance) {
      const glm::dvec2 q = glm::dvec2(1, 0.2) + inverseDistance * b * glm::dvec2(0.3, 0.9);
      return focal * q.y / q.x;
    };
    const double stored = storedInverseDistance(w, 0);
    EXPECT_LE(std::abs(pixel(stored) - pixel(w)), focal * b * w * 0x1p-16) << distance;
    worst = std::max(worst, std::abs(pixel(stored) - pixel(w)));
    const double even = sixteenBits(distance, farthest);
    worstEvenDistance = std::max(worstEvenDistance, even > 0 ? std::abs(pixel(1 / even) - pixel(w)) : focal);
    worstEvenInverse = std::max(worstEvenInverse, std::abs(pixel(sixteenBits(w, 1 / nearest)) - pixel(w)));
  }
  EXPECT_LT(worst, 5e-3);
  EXPECT_GT(worst, 1e-4) << "or captures keep more than the document says";
  EXPECT_GT(worstEvenDistance, 10);
  EXPECT_GT(worstEvenInverse, 10);
}

TEST(HardCases, OneMillimetreAndTenKilometresArePaintedInOneFrame) {
  AnalyticScene analytic;
  analytic.floor = false;
  const glm::vec4 red(0.7f, 0.05f, 0.05f, 1), blue(0.05f, 0.05f, 0.7f, 1);
  analytic.boxes.push_back({{1e-3, -2e-4, 1.6 - 2e-4}, {1.2e-3, 2e-4, 1.6 + 2e-4}, red});
  analytic.boxes.push_back({{1e4, -3e3, -2e3}, {1.1e4, 3e3, 2e3}, blue});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = camera.centreOfProjection + glm::dvec3(1e-4, 3e-4, 1e-4);
  view.width = 320, view.height = 240;
  view.fovRadians = radians(50);
  const OneCapture one = oneCapture(analytic, camera, view);
  const Canvas list = paint(one.scene, view, plainSettings(), one.plan);
  EXPECT_LT(shareOfDifferentPixels(list, paint(one.scene, view, plainSettings(), one.plan, true)), 0.01);
  // The rod's middle, 0.9 mm ahead and 0.3 mm aside, and the far wall's.
  const auto colourAt = [&](const glm::dvec3& point) {
    const glm::dvec3 q = view.viewFromWorld() * (point - view.eye);
    const int x = int(0.5 * view.width + view.focalPixels() * q.x / q.z);
    const int y = int(0.5 * view.height + view.focalPixels() * q.y / q.z);
    return colourOf(static_cast<std::uint32_t>(list.column(x)[y]) | 0xff000000u);
  };
  const auto shown = [](const glm::vec4& c) {
    return encodeForDisplay(glm::vec3(unpackColour(packColour(c))), 1);
  };
  EXPECT_EQ(colourAt({1e-3, 0, 1.6}), shown(red));
  EXPECT_EQ(colourAt({1e4, 2e3, 1e3}), shown(blue));
}

// ---- Views -----------------------------------------------------------------------------------------------

class HardViews : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, HardViews, testing::Values(Configuration::b, Configuration::e),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

TEST_P(HardViews, OfAnyWidthArePaintedBackToFront) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(5, 60, 3.4), layout, region, 3);
  RandomViews views(12);
  int wide = 0;
  double ours = 0, naive = 0;
  for (double fov : {1.0, 30.0, 59.999, 60.0, 90.0, 120.0, 150.0, 179.0}) {
    const PerspectiveView view = views.next(*layout, region, fov);
    const Frame list = frameOf(scene, view, plainSettings(Renderer::list));
    const Frame nearest = frameOf(scene, view, plainSettings(Renderer::zbuffer));
    const double share = test::differingShare(list.colour, nearest.colour);
    EXPECT_LT(share, 0.02) << fov;
    // Naively: the pieces the other way round, as the other hand's ring would need them.
    ViewPlan plan = planView(scene, view, plainSettings()).value();
    if (plan.pieces.size() < 3) continue;
    std::ranges::reverse(plan.pieces);
    ours += share;
    naive += shareOfDifferentPixels(paint(scene, view, plainSettings(), plan),
                                    paint(scene, view, plainSettings(), plan, true));
    ++wide;
  }
  EXPECT_GE(wide, 3);
  EXPECT_GT(naive, 5 * ours);
  EXPECT_GT(naive, 0.01 * wide);
}

/// Polygons that own none of their borders.
bool openHolds(const ConvexPolygon& polygon, const glm::dvec2& p) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.size()];
    if (!(cross(b - a, p - a) > 0)) return false;
  }
  return true;
}

/// Captures of all surfaces, for any region.
WalkScene walkOfAllRegions(const AnalyticScene& analytic, const std::shared_ptr<const Layout>& layout) {
  WalkScene walk;
  walk.layout = layout;
  for (std::size_t c = 0; c < layout->cameras.size(); ++c)
    walk.captures.push_back(std::make_shared<const DisplayCapture>(
        prepareForDisplay(test::capture(analytic, test::columnCamera(*layout, int(c), 2), nullptr, 3), 1)));
  return walk;
}

TEST_P(HardViews, FromOnTheBorderOfTwoRegionsAgreeWhicheverOfThemHoldsTheEye) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  AnalyticScene analytic = test::randomBoxes(16, 60, 3.4);
  analytic.floor = false;
  const WalkScene walk = walkOfAllRegions(analytic, layout);
  const Region& home = layout->regions[std::size_t(*layout->regionAt({0.1, 0.05}))];
  double popping = 0, step = 0, apart = 0;
  int borders = 0, heldByNone = 0, heldByTwo = 0;
  for (std::size_t k = 0; k < home.polygon.size(); ++k) {
    const glm::dvec2 a = home.polygon.corners[k], b = home.polygon.corners[(k + 1) % home.polygon.size()];
    const glm::dvec2 along = glm::normalize(b - a), outwards(along.y, -along.x), middle = 0.5 * (a + b);
    const auto inside = layout->regionAt(middle - 1e-9 * outwards),
               outside = layout->regionAt(middle + 1e-9 * outwards);
    if (!inside || !outside) continue;
    ASSERT_NE(*inside, *outside);
    // Exactly on it: one region, where open polygons have none and closed ones two at every corner.
    ASSERT_TRUE(layout->regionAt(a).has_value());
    const auto count = [&](const auto& holds) { return std::ranges::count_if(layout->regions, holds); };
    ASSERT_EQ(count([&](const Region& r) { return r.polygon.contains(a); }), 1);
    heldByTwo += count([&](const Region& r) { return r.polygon.containsClosed(a); }) > 1;
    heldByNone += count([&](const Region& r) { return openHolds(r.polygon, a); }) == 0;
    const double yaw = std::atan2(along.y, along.x);
    for (const double turn : {0.0, kPi / 2}) {
      const auto pictureFrom = [&](const glm::dvec2& eye) {
        PerspectiveView view;
        view.eye = glm::dvec3(eye, layout->eyeZ());
        view.yawRadians = yaw + turn;
        view.width = 320, view.height = 200;
        return frameOf(walk, view, plainSettings()).colour;
      };
      const ColourImage here = pictureFrom(middle - 1e-9 * outwards),
                        there = pictureFrom(middle + 1e-9 * outwards);
      popping += test::differingShare(here, there, 24);
      step += test::differingShare(here, pictureFrom(middle - 0.1 * outwards), 24);
      apart += test::differingShare(here, pictureFrom(middle + 0.5 * outwards), 24);
      ++borders;
    }
  }
  ASSERT_GE(borders, 8);
  popping /= borders, step /= borders, apart /= borders;
  RecordProperty("poppingPercent", std::to_string(100 * popping));
  RecordProperty("stepOfTenCentimetresPercent", std::to_string(100 * step));
  EXPECT_LT(popping, step) << "crossing the border changes less than a step of 10 cm does";
  EXPECT_LT(popping, 0.2 * apart);
  EXPECT_GT(heldByTwo, 0);
  EXPECT_GT(heldByNone, 0);
}

// ---- Hole fill -------------------------------------------------------------------------------------------

TEST(HardCases, HolesContinueTheFartherSideInAnyUnitAndNotByAnAbsoluteStepOfDepth) {
  // Left of the hole something near and red, right of it a blue wall ten times as far.
  int naiveMixes = 0;
  for (const float perMetre : {1e3f, 1.0f, 1e-4f, 1e-6f}) {
    Frame frame;
    frame.colour = ColourImage(20, 5, Rgba8(0));
    frame.source = Image<PixelSource>(20, 5, kSourceHole);
    FloatImage inverseZDepth(20, 5, 0.0f);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 20; ++x) {
        if (x == 8) continue;
        frame.colour.at(x, y) = x < 8 ? Rgba8(255, 0, 0, 255) : Rgba8(0, 0, 255, 255);
        frame.source.at(x, y) = PixelSource(x < 8 ? 1 : 2);
        inverseZDepth.at(x, y) = (x < 8 ? 1.0f : 0.1f) * perMetre;
      }
    TaskRunner runner(2);
    fillHoles(frame, inverseZDepth, 100, runner);
    for (int y = 0; y < 5; ++y) {
      EXPECT_EQ(frame.colour.at(8, y), Rgba8(0, 0, 255, 255)) << perMetre;
      EXPECT_EQ(frame.source.at(8, y), kSourceInvented);
    }
    const float near = perMetre, far = 0.1f * perMetre;
    naiveMixes += near <= 1.3f * far + 1e-6f;  // taken for the same surface
  }
  EXPECT_GT(naiveMixes, 0);
}

// ---- Scale and place -------------------------------------------------------------------------------------

/// How far from its place, in pixels, each sample of a capture lands when positions are kept in world-space
/// floats.
std::vector<double> errorsOfWorldSpaceFloats(const Capture& capture, const PerspectiveView& view) {
  std::vector<double> errors;
  const ColumnCamera& camera = capture.camera;
  const glm::dmat3 m = view.viewFromWorld();
  const auto pixel = [&](const glm::dvec3& fromEye) {
    const glm::dvec3 q = m * fromEye;
    return q.z > 0 ? view.focalPixels() * glm::dvec2(q) / q.z : glm::dvec2(1e9);
  };
  for (int k = 0; k < camera.columns; ++k)
    for (std::uint32_t i = capture.columnStart[std::size_t(k)]; i < capture.columnStart[std::size_t(k) + 1];
         ++i) {
      const float w = capture.inverseDistance[i];
      if (!(w > 0)) continue;
      const glm::dvec3 way(camera.directionAt(k + 0.5), camera.tangentAt(capture.row[i] + 0.5));
      const glm::dvec2 truth = pixel(camera.centreOfProjection - view.eye + way / double(w));
      if (std::abs(truth.x) > 0.5 * view.width || std::abs(truth.y) > 0.5 * view.height) continue;
      const glm::vec3 world = glm::vec3(camera.centreOfProjection) + glm::vec3(way) / w;
      errors.push_back(glm::distance(pixel(glm::dvec3(world - glm::vec3(view.eye))), truth));
    }
  return errors;
}

TEST(HardCases, ACaptureFiveThousandKilometresOutIsWarpedAsNearZeroAndNotInWorldSpaceFloats) {
  const glm::dvec3 far(5e6, -5e6, 0);
  const AnalyticScene near = test::randomBoxes(17, 60, 1.5);
  AnalyticScene moved = near;
  for (test::AnalyticBox& box : moved.boxes) box.min += far, box.max += far;
  const auto canvasAt = [&](const AnalyticScene& analytic, const glm::dvec3& move) {
    const ColumnCamera camera = cameraAt(move + glm::dvec3(0.3, -0.2, 1.6), 20);
    PerspectiveView view;
    view.eye = move + glm::dvec3(0.9, 0.4, 1.9);
    view.yawRadians = radians(25);
    view.width = 320, view.height = 240;
    const OneCapture one = oneCapture(analytic, camera, view);
    return paint(one.scene, view, plainSettings(), one.plan);
  };
  EXPECT_LT(shareOfDifferentPixels(canvasAt(near, glm::dvec3(0)), canvasAt(moved, far)), 1e-3);

  const ColumnCamera camera = cameraAt(far + glm::dvec3(0.3, -0.2, 1.6), 20);
  PerspectiveView view;
  view.eye = far + glm::dvec3(0.9, 0.4, 1.9);
  view.yawRadians = radians(25);
  const std::vector<double> errors = errorsOfWorldSpaceFloats(test::capture(moved, camera, nullptr), view);
  ASSERT_GT(errors.size(), 5000u);
  const auto lost = std::ranges::count_if(errors, [](double pixels) { return pixels > 1; });
  EXPECT_GT(double(lost), 0.9 * double(errors.size())) << "almost every sample is a pixel or more off";
}

}  // namespace
}  // namespace acentric
