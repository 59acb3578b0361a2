#include "engine/view/slant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

TEST(SlantCode, IsNearEveryTangentAndOdd) {
  for (double tangent = -60; tangent <= 60; tangent += 0.0137) {
    const double back = slantTangent(slantCode(tangent));
    // Half a step of code / (127 - |code|), and the step grows with the square.
    EXPECT_NEAR(back, tangent, 0.51 / 127 * std::pow(1 + std::max(std::abs(tangent), std::abs(back)), 2));
    EXPECT_EQ(slantCode(-tangent), -slantCode(tangent));
  }
  EXPECT_EQ(slantCode(0), 0);
  EXPECT_EQ(slantCode(1e9), kLargestSlantCode);
  EXPECT_EQ(slantCode(-std::numeric_limits<double>::infinity()), -kLargestSlantCode);
}

/// One layer: the inverse distance of each pixel, 0 = sky.
struct Grid {
  ColumnCamera camera = test::cameraAt({0, 0, 1.6}, 0, 60, 90);
  std::vector<std::uint32_t> columnStart{0};
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;

  template <class Inverse>
  explicit Grid(const Inverse& inverse) {
    for (int k = 0; k < camera.columns; ++k) {
      for (int r = 0; r < camera.rows; ++r) {
        row.push_back(static_cast<std::uint16_t>(r));
        inverseDistance.push_back(
            static_cast<float>(inverse(camera.directionAt(k + 0.5), camera.tangentAt(r + 0.5))));
      }
      columnStart.push_back(static_cast<std::uint32_t>(row.size()));
    }
  }
  std::vector<Slant> slants() const { return slantsOf(camera, columnStart, row, inverseDistance); }
};

TEST(Slants, AreThoseOfAPlane) {
  // The plane n.X = d from the camera: w = n.(c + t z) / d, so its derivatives are known.
  const glm::dvec3 normal(1, 0.7, 0.4);
  const double distance = 3;
  const Grid grid([&](const glm::dvec2& c, double t) { return glm::dot(normal, {c, t}) / distance; });
  const std::vector<Slant> slants = grid.slants();
  for (int k = 0; k < grid.camera.columns; ++k)
    for (int r = 0; r < grid.camera.rows; ++r) {
      const glm::dvec2 c = grid.camera.directionAt(k + 0.5);
      const double t = grid.camera.tangentAt(r + 0.5), w = glm::dot(normal, {c, t}) / distance;
      if (w < 0.08) continue;  // nearly along the plane
      const double across = glm::dot(normal, {-c.y, c.x, 0}) / distance / w,
                   down = -normal.z * (1 + t * t) / distance / w;
      const Slant slant = slants[static_cast<std::size_t>(k * grid.camera.rows + r)];
      // At the picture's border a steep surface passes for one that turns away.
      const bool sideBorder = k == 0 || k + 1 == grid.camera.columns;
      const bool upperBorder = r == 0 || r + 1 == grid.camera.rows;
      if (!sideBorder || std::abs(across) < 2.9) {
        EXPECT_NEAR(slantTangent(slant.across), across, 0.02 * std::pow(1 + std::abs(across), 2));
      }
      if (!upperBorder || std::abs(down) < 2.9) {
        EXPECT_NEAR(slantTangent(slant.down), down, 0.02 * std::pow(1 + std::abs(down), 2));
      }
    }
}

TEST(Slants, DoNotBridgeTheEdgeOfASurface) {
  // A wall in the left half, another one far behind in the right half, sky above: all seen nearly face on.
  const Grid grid([&](const glm::dvec2& c, double t) { return t > 0.5 ? 0 : c.y > 0 ? 1 / 2.0 : 1 / 9.0; });
  for (const Slant& slant : grid.slants()) EXPECT_EQ(slant, Slant{});
}

TEST(Slants, AreNoneWhereASurfaceTurnsAwayAtItsEdge) {
  // A round tower before the sky: its outermost samples lie nearly along the camera's rays.
  const glm::dvec2 centre(8, 0);
  const double radius = 3;
  const Grid grid([&](const glm::dvec2& c, double) {
    const double along = glm::dot(c, centre), beside = c.x * centre.y - c.y * centre.x;
    const double half = radius * radius - beside * beside;
    return half < 0 ? 0 : 1 / (along - std::sqrt(half));
  });
  const std::vector<Slant> slants = grid.slants();
  const auto at = [&](int k) { return std::size_t(k * grid.camera.rows + 45); };
  int first = 0;
  while (grid.inverseDistance[at(first)] == 0) ++first;
  EXPECT_EQ(slants[at(first)].across, 0) << "the edge";
  EXPECT_GT(std::abs(slantTangent(slants[at(first + 1)].across)), 0.5) << "beside it";
}

TEST(Slants, AreThoseOfASlowSearchThroughLayers) {
  std::mt19937 random(5);
  const ColumnCamera camera = test::cameraAt({0, 0, 1.6}, 0, 40, 50);
  const Capture capture = test::capture(test::randomBoxes(8, 60, 1.5), camera, nullptr, 4);
  const std::vector<Slant> slants =
      slantsOf(camera, capture.columnStart, capture.row, capture.inverseDistance);
  ASSERT_GT(capture.maxLayers(), 2);
  const auto columnOf = [&](std::size_t i) {
    int k = 0;
    while (capture.columnStart[static_cast<std::size_t>(k) + 1] <= i) ++k;
    return k;
  };
  const auto stepTo = [&](std::size_t i, int column, int row) {  // to the nearest in depth of that pixel
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < capture.sampleCount(); ++j)
      if (capture.row[j] == row && columnOf(j) == column)
        if (const float step = capture.inverseDistance[j] - capture.inverseDistance[i];
            std::abs(step) < std::abs(best))
          best = step;
    return best;
  };
  const auto expected = [&](std::size_t i, float before, float after, double pitch) {
    const double w = double(capture.inverseDistance[i]);
    const double a = double(-before), b = double(after);
    const double steeper = std::abs(a) > std::abs(b) ? a : b, flatter = std::abs(a) > std::abs(b) ? b : a;
    if (!(std::abs(steeper) < 0.25 * w) && !(std::abs(flatter) < 3 * w * pitch)) return 0.0;
    const double step = std::abs(steeper) < 3 * w * pitch ? steeper : flatter;
    return std::abs(step) < 0.25 * w ? step / (w * pitch) : 0;
  };
  std::uniform_int_distribution<std::size_t> any(0, capture.sampleCount() - 1);
  int leaning = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t i = any(random);
    const int k = columnOf(i), r = capture.row[i];
    if (capture.inverseDistance[i] == 0) {
      EXPECT_EQ(slants[i], Slant{});
      continue;
    }
    const double across = expected(i, stepTo(i, k - 1, r), stepTo(i, k + 1, r), camera.columnPitch()),
                 down = expected(i, stepTo(i, k, r - 1), stepTo(i, k, r + 1), camera.rowPitch());
    EXPECT_NEAR(slants[i].across, slantCode(across), 1) << i;  // float against double
    EXPECT_NEAR(slants[i].down, slantCode(down), 1) << i;
    leaning += slants[i] != Slant{};
  }
  EXPECT_GT(leaning, 50);
}

}  // namespace
}  // namespace acentric
