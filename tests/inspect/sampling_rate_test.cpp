#include "engine/inspect/sampling_rate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

ColumnCamera cameraAt(const glm::dvec3& place, double samplesPerDegree) {
  ColumnCamera camera;
  camera.centreOfProjection = place;
  camera.lowAzimuth = radians(-30);
  camera.fovRadians = radians(60);
  camera.topElevation = radians(60);
  camera.bottomElevation = radians(-60);
  camera.columns = int(60 * samplesPerDegree), camera.rows = int(120 * samplesPerDegree);
  return camera;
}

class RandomPlaces {
 public:
  explicit RandomPlaces(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  glm::dvec3 unit() {
    const double z = (*this)(-1, 1), flat = std::sqrt(1 - z * z);
    return glm::dvec3(flat * directionOf((*this)(0, kTwoPi)), z);
  }

 private:
  std::mt19937 engine_;
};

TEST(SamplingRate, OfAWallSeenFaceOnIsTheSamplesPerRadianOverTheDistance) {
  const ColumnCamera camera = cameraAt({1, 2, 3}, 8);
  const SurfaceAxes axes = axesOf({-1, 0, 0});
  const glm::dmat2 samples = samplesPerMetre(camera, {6, 2, 3}, axes);
  const double expected = degrees(1) * 8 / 5;
  for (const glm::dvec2& step : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(0.6, -0.8)})
    EXPECT_NEAR(glm::length(samples * step), expected, 1e-9);
}

TEST(SamplingRate, IsTheChangeOfColumnAndRowWithThePoint) {
  RandomPlaces random(1);
  for (int n = 0; n < 500; ++n) {
    const ColumnCamera camera = cameraAt({random(-3, 3), random(-3, 3), random(0, 2)}, 5);
    const glm::dvec3 point =
        camera.centreOfProjection + glm::dvec3(random(1, 9) * directionOf(random(-0.5, 0.5)), random(-4, 4));
    const SurfaceAxes axes = axesOf(random.unit());
    const auto pixelOf = [&](const glm::dvec3& p) {
      const glm::dvec3 d = p - camera.centreOfProjection;
      return glm::dvec2(std::atan2(d.y, d.x) / camera.columnPitch(),
                        std::atan2(d.z, std::hypot(d.x, d.y)) / camera.rowPitch());
    };
    constexpr double kStep = 1e-6;
    const glm::dmat2 samples = samplesPerMetre(camera, point, axes);
    const glm::dvec2 first = (pixelOf(point + kStep * axes.first) - pixelOf(point)) / kStep;
    const glm::dvec2 second = (pixelOf(point + kStep * axes.second) - pixelOf(point)) / kStep;
    EXPECT_LT(glm::length(samples[0] - first) + glm::length(samples[1] - second), 1e-2);
  }
}

TEST(SamplingRate, AtASlantFallsWithTheCosineInThatDirectionAlone) {
  const double slant = radians(60);
  const glm::dvec3 normal(-std::cos(slant), std::sin(slant), 0);
  const SurfaceAxes axes = axesOf(normal);
  const glm::dvec3 point(4, 0, 0), eye(4 - 10 * std::cos(slant), 10 * std::sin(slant), 0);
  const glm::dmat2 samples = samplesPerMetre(cameraAt({0, 0, 0}, 10), point, axes);
  const glm::dmat2 pixels = pixelsPerMetre(eye, 500, point, axes);  // sees it face on
  const RateAndNeed found = compareRates(samples, pixels);
  EXPECT_NEAR(found.rate, degrees(1) * 10 / 4 * std::cos(slant), 1e-6);
  EXPECT_NEAR(found.need, 50, 1e-9);
  EXPECT_NEAR(found.ratio(), found.rate / 50, 1e-12);
}

TEST(SamplingRate, TakesTheDirectionWithFewestSamplesPerPixel) {
  RandomPlaces random(2);
  for (int n = 0; n < 1000; ++n) {
    const auto matrix = [&] {
      return glm::dmat2(random(-2, 2), random(-2, 2), random(-2, 2), random(-2, 2));
    };
    const glm::dmat2 samples = matrix(), pixels = matrix();
    if (std::abs(glm::determinant(pixels)) < 0.05) continue;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2000; ++k) {
      const glm::dvec2 along = directionOf(kPi * k / 2000);
      least = std::min(least, glm::length(samples * along) / glm::length(pixels * along));
    }
    const double found = compareRates(samples, pixels).ratio();
    EXPECT_LE(found, least * (1 + 1e-9));
    EXPECT_NEAR(found, least, 0.02 + 0.01 * least);
  }
  EXPECT_EQ(compareRates(glm::dmat2(2), glm::dmat2(2)).ratio(), 1);
}

}  // namespace
}  // namespace acentric
