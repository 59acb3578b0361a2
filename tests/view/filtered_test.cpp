// Reconstruction::filtered as a whole: where samples lie, how large they are, and how near it comes to the
// truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/view/slant.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticScene;
using test::cameraAt;
using test::OneCapture;
using test::oneCapture;
using test::paint;
using test::plainSettings;

ViewSettings settingsOf(Reconstruction reconstruction) {
  ViewSettings settings = plainSettings();
  settings.reconstruction = reconstruction;
  return settings;
}

/// Image position of a world point.
glm::dvec2 projected(const PerspectiveView& view, const glm::dvec3& point) {
  const glm::dvec3 q = view.viewFromWorld() * (point - view.eye);
  return glm::dvec2(view.width, view.height) * 0.5 + view.focalPixels() * glm::dvec2(q) / q.z;
}

/// One sample of a plane with these slants.
OneCapture oneSample(const ColumnCamera& camera, float w, Slant slant, const PerspectiveView& view) {
  Capture capture{{{0, 1}, {0}, {w}, {packColour({1, 1, 1, 1})}, {1}, {}}, camera, 0, {}, {}};
  auto display = std::make_shared<DisplayCapture>(prepareForDisplay(capture, 1));
  display->samples[0].slant = slant;
  OneCapture one;
  one.scene.captures.push_back(display);
  PieceDraw piece;
  piece.baseline = glm::vec3(camera.centreOfProjection - view.eye);
  piece.maxInverseDistance = {std::numeric_limits<float>::infinity()};
  piece.runs = {{0, 1, true}};
  one.plan.pieces.push_back(piece);
  return one;
}

TEST(Filtered, PaintsWhatTheSampleStandsForAndKeepsWhereItLies) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto colourAndSlot = [](CanvasPixel pixel) { return static_cast<std::uint32_t>(pixel); };
  int seen = 0, large = 0;
  for (int round = 0; round < 1500; ++round) {
    ColumnCamera camera =
        cameraAt({unit(random), unit(random), 1.6 + unit(random)}, 180 * unit(random), 1, 1);
    camera.fovRadians = radians(0.4), camera.lowAzimuth += radians(29.8);
    const double middle = radians(20 * unit(random));
    camera.topElevation = middle + radians(0.2), camera.bottomElevation = middle - radians(0.2);
    const float w = static_cast<float>(0.2 + 0.15 * unit(random));
    const Slant slant{slantCode(3 * unit(random)), slantCode(3 * unit(random))};
    PerspectiveView view;
    view.eye = camera.centreOfProjection + 0.7 * glm::dvec3(unit(random), unit(random), unit(random));
    view.yawRadians = camera.azimuthAt(0.5) + 0.3 * unit(random);
    view.pitchRadians = middle + 0.1 * unit(random);
    view.width = 320, view.height = 240;
    const OneCapture one = oneSample(camera, w, slant, view);
    const Canvas canvas = paint(one.scene, view, settingsOf(Reconstruction::filtered), one.plan);

    const Canvas plain = paint(one.scene, view, settingsOf(Reconstruction::surface), one.plan);
    ASSERT_TRUE(std::ranges::equal(plain.pixels, canvas.pixels, {}, colourAndSlot, colourAndSlot)) << round;

    // The surface's points at the ends of the sample's share along a row and along a column.
    const auto at = [&](double column, double row) {
      const double inverse =
          double(w) * (1 + slantTangent(slant.across) * camera.columnPitch() * (column - 0.5) +
                       slantTangent(slant.down) * camera.rowPitch() * (row - 0.5));
      return projected(view, camera.centreOfProjection +
                                 glm::dvec3(camera.directionAt(column), camera.tangentAt(row)) / inverse);
    };
    const glm::dvec2 place = at(0.5, 0.5);
    const glm::dvec2 half = glm::clamp(
        0.5 * kOverlap * (glm::abs(at(1, 0.5) - at(0, 0.5)) + glm::abs(at(0.5, 1) - at(0.5, 0))), 0.5, 8.0);
    if (place.x < 20 || place.y < 20 || place.x > view.width - 20 || place.y > view.height - 20) continue;
    ++seen;
    large += half.x > 2 || half.y > 2;
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y) {
        const glm::dvec2 away = glm::dvec2(x + 0.5, y + 0.5) - place;
        const glm::dvec2 beyond = glm::abs(away) - half;
        const CanvasPixel pixel = canvas.column(x)[y];
        constexpr double kSlack = 0.06;
        if (std::max(beyond.x, beyond.y) > kSlack) {
          EXPECT_EQ(slotOf(pixel), 0u) << round;
        } else if (std::max(beyond.x, beyond.y) < -kSlack) {
          EXPECT_NE(slotOf(pixel), 0u) << round;
        }
        if (slotOf(pixel) == 0) continue;
        const auto held = [&](int shift) {
          const int code = static_cast<int>((pixel >> shift) & 15);
          return (code < 8 ? code : code - 16) / 8.0;
        };
        EXPECT_NEAR(held(32), std::clamp(-away.x, -1.0, 0.875), 0.08) << round;
        EXPECT_NEAR(held(36), std::clamp(-away.y, -1.0, 0.875), 0.08) << round;
        const double apart = 2 * std::min(half.x, half.y) / kOverlap;
        EXPECT_NEAR(static_cast<double>((pixel >> 40) & 7), std::clamp(8 - 8 / apart, 0.0, 7.0), 0.6)
            << round;
      }
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(large, 30);
}

/// Mean of 16 rays a pixel, in linear light.
ColourImage truthOf(const AnalyticScene& analytic, const PerspectiveView& view) {
  ColourImage truth(view.width, view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      glm::vec3 sum(0);
      for (int i = 0; i < 16; ++i) {
        const glm::dvec3 ray = view.rayThrough(x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4);
        const auto along = analytic.along(view.eye, ray, 0);
        sum += glm::vec3(along.empty() ? analytic.skyColour : along.front().colour);
      }
      truth.at(x, y) = encodeForDisplay(sum / 16.0f, 1);
    }
  return truth;
}

TEST(Filtered, ComesNearerToTheTruthThanSplats) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  AnalyticScene analytic = test::randomBoxes(6, 40, 3.4);
  analytic.floor = false;  // near the eye it would be local geometry
  const WalkScene scene = test::walkScene(analytic, layout, region, 3, 3);
  test::RandomViews views(17);
  for (int i = 0; i < 3; ++i) {
    PerspectiveView view = views.next(*layout, region, 60);
    view.width = 160, view.height = 100;
    const ColourImage truth = truthOf(analytic, view);
    const Frame splats = test::frameOf(scene, view, settingsOf(Reconstruction::splat)),
                filtered = test::frameOf(scene, view, settingsOf(Reconstruction::filtered));
    double ofSplats = 0, ofFiltered = 0;
    std::size_t compared = 0;
    for (std::size_t p = 0; p < truth.pixels.size(); ++p) {
      if (splats.source.pixels[p] == kSourceHole || filtered.source.pixels[p] == kSourceHole) continue;
      const auto square = [&](const Frame& frame) {
        const glm::vec3 off = glm::vec3(frame.colour.pixels[p]) - glm::vec3(truth.pixels[p]);
        return double(glm::dot(off, off));
      };
      ofSplats += square(splats), ofFiltered += square(filtered), ++compared;
    }
    EXPECT_GT(compared, truth.pixels.size() / 3);
    EXPECT_LT(ofFiltered, 0.75 * ofSplats) << i;
  }
}

TEST(Filtered, LeavesFewCracksInAWallThatTheCameraSawAtASlant) {
  // A wall half a metre beside the camera, 79 degrees off its face and beyond; the eye stands away from it.
  AnalyticScene analytic;
  analytic.floor = false;
  analytic.boxes.push_back({{-1, 0.5, -4}, {30, 0.7, 6}, {0.5f, 0.4f, 0.3f, 1}});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 30);
  PerspectiveView view;
  view.eye = {-0.5, -1.5, 1.7};
  view.yawRadians = radians(55);
  view.fovRadians = radians(40);
  view.width = 320, view.height = 200;
  OneCapture one = oneCapture(analytic, camera, view);
  const auto openPixels = [&](Reconstruction reconstruction) {
    const Canvas canvas = paint(one.scene, view, settingsOf(reconstruction), one.plan);
    std::size_t open = 0, all = 0;
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y) {
        const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
        const glm::dvec3 at = view.eye + (0.5 - view.eye.y) / ray.y * ray;
        const glm::dvec2 flat = glm::dvec2(at) - glm::dvec2(camera.centreOfProjection);
        const double elevation = std::atan((at.z - 1.6) / glm::length(flat));
        if (at.x < 0.4 || at.x > 2.5 || std::abs(elevation) > radians(55)) continue;  // what the camera saw
        ++all;
        open += slotOf(canvas.column(x)[y]) == 0;
      }
    EXPECT_GT(all, 5000u);
    return static_cast<double>(open) / static_cast<double>(all);
  };
  const double splat = openPixels(Reconstruction::splat), filtered = openPixels(Reconstruction::filtered);
  EXPECT_GT(splat, 0.05);
  EXPECT_LT(filtered, 0.002);
}

}  // namespace
}  // namespace acentric
