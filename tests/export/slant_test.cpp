#include "engine/export/slant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "engine/geometry/conventions.h"
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
  EXPECT_EQ(slantCode(std::numeric_limits<double>::infinity()), kLargestSlantCode);
  EXPECT_EQ(slantCode(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(slantCode(-std::numeric_limits<double>::infinity()), -kLargestSlantCode);
}

/// The inverse distances of each pixel (or the only one), 0 = sky.
struct Grid {
  ColumnCamera camera;
  std::vector<std::uint32_t> columnStart{0};
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;

  template <class Inverse>
  explicit Grid(const Inverse& inverse, int columns = 60)
      : camera(test::cameraAt({0, 0, 1.6}, 0, columns, 90)) {
    for (int k = 0; k < camera.columns; ++k) {
      for (int r = 0; r < camera.rows; ++r) {
        const auto add = [&](double w) {
          row.push_back(static_cast<std::uint16_t>(r));
          inverseDistance.push_back(static_cast<float>(w));
        };
        const auto found = inverse(camera.directionAt(k + 0.5), camera.tangentAt(r + 0.5));
        if constexpr (std::is_convertible_v<decltype(found), double>)
          add(double(found));
        else
          for (const double w : found) add(w);
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

/// Fine enough that a tenth of the distance is a steep step from one sample to the next.
TEST(Slants, DoNotBridgeTheStepToASurfaceRightBehind) {
  constexpr int kColumns = 480;
  const Grid steps(
      [](const glm::dvec2& c, double) {
        return c.x / (c.y > 0.01 ? 5.0 : c.y > -0.1 ? 5.5 : 5.2);
      },
      kColumns);
  for (const Slant& slant : steps.slants()) EXPECT_LT(std::abs(slantTangent(slant.across)), 1.5);
  // As steep, but evenly so: a wall along which the camera looks.
  const Grid wall([](const glm::dvec2& c, double) { return std::max(c.y, 0.0) / 0.3; }, kColumns);
  const std::vector<Slant> slants = wall.slants();
  int steep = 0;
  for (int k = 0; k < kColumns; ++k) {
    const glm::dvec2 c = wall.camera.directionAt(k + 0.5);
    if (c.y < 8 * wall.camera.columnPitch() || k + 1 == kColumns) continue;
    const Slant slant = slants[std::size_t(k * wall.camera.rows + 45)];
    EXPECT_NEAR(slant.across, slantCode(c.x / c.y), 1) << k;
    steep += c.x / c.y > 12;
  }
  EXPECT_GT(steep, 20);
}

/// Glass before a picture: from one sample to the next it comes nearer by more than the glass is away.
TEST(Slants, AreThoseOfBothOfTwoSurfacesCloseBehindEachOther) {
  constexpr int kColumns = 240;
  const double places[] = {0.3, 0.31};
  const Grid grid(
      [&](const glm::dvec2& c, double) {
        return std::vector{std::max(c.y, 0.0) / places[0], std::max(c.y, 0.0) / places[1]};
      },
      kColumns);
  const std::vector<Slant> slants = grid.slants();
  int steep = 0;
  for (int k = 0; k + 1 < kColumns; ++k) {
    const glm::dvec2 c = grid.camera.directionAt(k + 0.5);
    if (c.y < 8 * grid.camera.columnPitch()) continue;
    for (const std::size_t side : {0u, 1u}) {
      const Slant slant = slants[grid.columnStart[std::size_t(k)] + 2 * 45 + side];
      EXPECT_NEAR(slantTangent(slant.across), c.x / c.y, 0.1 * c.x / c.y + 0.3) << k << ", side " << side;
    }
    steep += c.x / c.y > 12;
  }
  EXPECT_GT(steep, 10);
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

/// Where a ray enters and leaves a round tower: its inverse distances, none beside it.
std::vector<double> throughTower(const glm::dvec2& centre, double radius, const glm::dvec2& c) {
  const double along = glm::dot(c, centre), beside = c.x * centre.y - c.y * centre.x;
  const double half = radius * radius - beside * beside;
  if (half < 0) return {};
  return {1 / (along - std::sqrt(half)), 1 / (along + std::sqrt(half))};
}

TEST(Slants, ReachAroundTheRimOfARoundBody) {
  // Before a wall. The two outermost samples on either side are each other's neighbours, around the rim.
  const glm::dvec2 centre(8, 0);
  const Grid grid([&](const glm::dvec2& c, double) {
    std::vector<double> found = throughTower(centre, 0.6, c);
    found.push_back(c.x / 12);
    return found;
  });
  const std::vector<Slant> slants = grid.slants();
  int rims = 0;
  for (int k = 1; k + 1 < grid.camera.columns; ++k) {
    const auto towerAt = [&](int column) {
      return throughTower(centre, 0.6, grid.camera.directionAt(column + 0.5));
    };
    const std::vector<double> here = towerAt(k);
    if (here.empty()) continue;
    const bool atRim = towerAt(k - 1).empty() || towerAt(k + 1).empty();
    const std::size_t first = grid.columnStart[static_cast<std::size_t>(k)] + 3 * 45;
    for (const int side : {0, 1}) {
      const double reach = slantTangent(slants[first + std::size_t(side)].across) *
                           grid.camera.columnPitch() * here[std::size_t(side)];
      const double gap = here[0] - here[1];
      const double towards = towerAt(k - 1).empty() ? (side == 0 ? 1 : -1) : (side == 0 ? -1 : 1);
      if (atRim) {
        EXPECT_NEAR(reach * towards, gap, 0.1 * gap) << k << ", side " << side;
      } else {
        EXPECT_LT(std::abs(reach), 0.7 * gap) << k << ", side " << side;
      }
    }
    EXPECT_LT(std::abs(slantTangent(slants[first + 2].across)), 0.5) << "the wall";
    rims += atRim;
  }
  EXPECT_EQ(rims, 2);
}

TEST(Slants, DoNotReachFromAPostToTheWallBehindIt) {
  const Grid grid([&](const glm::dvec2& c, double) {
    return std::abs(c.y) < 0.1 * c.x ? std::vector{c.x / 5.0, c.x / 5.5} : std::vector{c.x / 5.5};
  });
  for (const Slant& slant : grid.slants()) EXPECT_LT(std::abs(slantTangent(slant.across)), 1.5);
}

/// Compares with a search through all samples; returns how many samples at rims were met.
int compareWithSlowSearch(const ColumnCamera& camera, const std::vector<std::uint32_t>& columnStart,
                          const std::vector<std::uint16_t>& row, const std::vector<float>& inverseDistance) {
  std::mt19937 random(5);
  const std::vector<Slant> slants = slantsOf(camera, columnStart, row, inverseDistance);
  int rims = 0;
  std::vector<int> columns;
  for (std::size_t k = 0; k + 1 < columnStart.size(); ++k) columns.resize(columnStart[k + 1], int(k));
  const auto columnOf = [&](std::size_t i) { return columns[i]; };
  const auto stepTo = [&](std::size_t i, int column,
                          int wantedRow) {  // to the nearest in depth of that pixel
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j] == wantedRow && columnOf(j) == column)
        if (const float step = inverseDistance[j] - inverseDistance[i]; std::abs(step) < std::abs(best))
          best = step;
    return best;
  };
  // Of a pixel beside i's, at (dk, dr), with the body on it, and the one opposite with the body off it.
  const auto aroundRim = [&](std::size_t i, int dk, int dr) {
    const int k = columnOf(i), r = row[i];
    const auto w = [&](std::size_t j) { return inverseDistance[j]; };
    std::size_t other = i;
    for (std::size_t j = 0; j < row.size(); ++j)
      if (j != i && columnOf(j) == k && row[j] == r &&
          (other == i || std::abs(w(j) - w(i)) < std::abs(w(other) - w(i))))
        other = j;
    const float gap = w(other) - w(i);
    if (other == i || std::abs(gap) >= 0.25f * w(i)) return 0.0f;
    for (const std::size_t j : {i, other})
      if (std::abs(stepTo(j, k - dk, r - dr)) <= std::abs(gap)) return 0.0f;
    const float inner = w(other) + stepTo(other, k + dk, r + dr) - w(i) - stepTo(i, k + dk, r + dr);
    return inner / gap > 1.2f && std::abs(inner) < 0.25f * w(i) ? gap : 0.0f;
  };
  // Of all pairs on either side the one most nearly on a line with i.
  const auto straightest = [&](std::size_t i, int dk, int dr) {
    std::pair<double, double> best{1e9, 0};
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (columnOf(j) != columnOf(i) - dk || row[j] != row[i] - dr) continue;
      for (std::size_t l = 0; l < row.size(); ++l) {
        if (columnOf(l) != columnOf(i) + dk || row[l] != row[i] + dr) continue;
        const std::pair<double, double> steps{double(inverseDistance[i]) - double(inverseDistance[j]),
                                              double(inverseDistance[l]) - double(inverseDistance[i])};
        if (std::abs(steps.first - steps.second) < std::abs(best.first - best.second)) best = steps;
      }
    }
    return best;
  };
  const auto expected = [&](std::size_t i, int dk, int dr, double pitch) {
    const float before = stepTo(i, columnOf(i) - dk, row[i] - dr),
                after = stepTo(i, columnOf(i) + dk, row[i] + dr);
    const double w = double(inverseDistance[i]);
    const float forwards = aroundRim(i, -dk, -dr), backwards = aroundRim(i, dk, dr);
    rims += forwards != 0 || backwards != 0;
    if (forwards != 0) return double(forwards) / (w * pitch);
    if (backwards != 0) return -double(backwards) / (w * pitch);
    std::pair<double, double> sides{-before, after};
    const auto even = [](const std::pair<double, double>& s, double most) {
      const double larger = std::max(std::abs(s.first), std::abs(s.second)),
                   smaller = std::min(std::abs(s.first), std::abs(s.second));
      return s.first * s.second > 0 && larger < most * smaller;
    };
    if (std::max(std::abs(sides.first), std::abs(sides.second)) >= 3 * w * pitch && !even(sides, 1.02))
      if (const auto others = straightest(i, dk, dr); even(others, 1.02)) sides = others;
    const auto [a, b] = sides;
    const double steeper = std::abs(a) > std::abs(b) ? a : b, flatter = std::abs(a) > std::abs(b) ? b : a;
    const double broken = even(sides, 1.5) ? 0.25 * w : std::min(0.25, 10 * pitch) * w;
    if (!(std::abs(steeper) < broken) && !(std::abs(flatter) < 3 * w * pitch)) return 0.0;
    const double step = std::abs(steeper) < 3 * w * pitch ? steeper : flatter;
    return std::abs(step) < broken ? step / (w * pitch) : 0;
  };
  std::uniform_int_distribution<std::size_t> any(0, row.size() - 1);
  int leaning = 0;
  for (int round = 0; round < 600; ++round) {
    const std::size_t i = any(random);
    if (inverseDistance[i] == 0) {
      EXPECT_EQ(slants[i], Slant{});
      continue;
    }
    const double across = expected(i, 1, 0, camera.columnPitch()),
                 down = expected(i, 0, 1, camera.rowPitch());
    EXPECT_NEAR(slants[i].across, slantCode(across), 1) << i;  // float against double
    EXPECT_NEAR(slants[i].down, slantCode(down), 1) << i;
    leaning += slants[i] != Slant{};
  }
  EXPECT_GT(leaning, 50);
  return rims;
}

TEST(Slants, AreThoseOfASlowSearchThroughLayers) {
  const ColumnCamera camera = test::cameraAt({0, 0, 1.6}, 0, 40, 50);
  const Capture boxes = test::capture(test::randomBoxes(8, 60, 1.5), camera, nullptr, 4);
  ASSERT_GT(boxes.maxLayers(), 2);
  compareWithSlowSearch(camera, boxes.columnStart, boxes.row, boxes.inverseDistance);

  std::mt19937 random(9);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Tower {
    glm::dvec2 centre;
    double radius, top;
  };
  std::vector<Tower> towers;
  for (int i = 0; i < 12; ++i)
    towers.push_back({uniform(3, 9) * directionOf(uniform(-0.5, 0.5)), uniform(0.1, 0.6), uniform(-0.5, 1)});
  const Grid grid([&](const glm::dvec2& c, double t) {
    std::vector<double> found;
    for (const Tower& tower : towers)
      if (t < tower.top)
        for (const double w : throughTower(tower.centre, tower.radius, c)) found.push_back(w);
    std::ranges::sort(found, std::greater());
    return found;
  });
  EXPECT_GT(compareWithSlowSearch(grid.camera, grid.columnStart, grid.row, grid.inverseDistance), 10);
}

}  // namespace
}  // namespace acentric
