/// Charts of surfaces, against what has to hold of them, looked for in all pairs and places.

#include "engine/export/surface_charts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace acentric {
namespace {

using Corners = std::array<glm::dvec2, 3>;

void addQuad(std::vector<SurfaceTriangle>& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
             const glm::vec3& d, std::uint32_t kind = 0) {
  out.push_back({{a, b, c}, kind});
  out.push_back({{a, c, d}, kind});
}

/// A surface over [0, cells]^2, `at` of whole numbers.
template <class At>
std::vector<SurfaceTriangle> grid(int across, int down, const At& at) {
  std::vector<SurfaceTriangle> out;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < down; ++j) addQuad(out, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return out;
}

glm::dvec3 normalOf(const SurfaceTriangle& t) {
  return glm::normalize(
      glm::cross(glm::dvec3(t.corners[1] - t.corners[0]), glm::dvec3(t.corners[2] - t.corners[0])));
}

Corners placesOf(const SurfaceChart& chart, const SurfaceTriangle& t) {
  Corners out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = chart.place(t.corners[i]);
  return out;
}

/// Metres inside; negative outside.
double depthIn(const Corners& t, const glm::dvec2& p) {
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  const double turn = cross(t[1] - t[0], t[2] - t[0]) > 0 ? 1 : -1;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 side = t[(i + 1) % 3] - t[i];
    least = std::min(least, turn * cross(side, p - t[i]) / glm::length(side));
  }
  return least;
}

/// Of some places in `a`, how deep in both at most.
double sharedDepth(const Corners& a, const Corners& b) {
  constexpr int kSteps = 24;
  double deepest = -HUGE_VAL;
  for (int i = 1; i < kSteps; ++i)
    for (int j = 1; i + j < kSteps; ++j) {
      const glm::dvec2 p = a[0] + (double(i) * (a[1] - a[0]) + double(j) * (a[2] - a[0])) / double(kSteps);
      deepest = std::max(deepest, std::min(depthIn(a, p), depthIn(b, p)));
    }
  return deepest;
}

void expectSound(const std::vector<SurfaceTriangle>& all, const std::vector<SurfaceChart>& charts) {
  std::multiset<std::uint32_t> taken;
  for (const SurfaceChart& chart : charts) {
    ASSERT_FALSE(chart.triangles.empty());
    EXPECT_NEAR(glm::length(chart.across), 1, 1e-9);
    EXPECT_NEAR(glm::length(chart.down), 1, 1e-9);
    EXPECT_NEAR(glm::dot(chart.across, chart.down), 0, 1e-9);
    EXPECT_GE(chart.size.x, chart.size.y);
    const SurfaceTriangle& seed = all[chart.triangles.front()];
    const double facing = glm::dot(normalOf(seed), glm::cross(chart.across, chart.down)) < 0 ? -1 : 1;
    for (const std::uint32_t t : chart.triangles) {
      taken.insert(t);
      EXPECT_EQ(all[t].kind, seed.kind);
      EXPECT_GE(glm::dot(normalOf(all[t]), glm::cross(chart.across, chart.down)) * facing,
                std::cos(kMostBend) - 1e-6);
      for (const glm::dvec2& p : placesOf(chart, all[t])) {
        EXPECT_GE(std::min(p.x, p.y), -1e-6);
        EXPECT_TRUE(p.x <= chart.size.x + 1e-6 && p.y <= chart.size.y + 1e-6);
      }
    }
    for (const std::uint32_t a : chart.triangles)
      for (const std::uint32_t b : chart.triangles)
        if (a != b) {
          ASSERT_LT(sharedDepth(placesOf(chart, all[a]), placesOf(chart, all[b])), 3 * kWeld);
        }
  }
  EXPECT_EQ(taken.size(), all.size());
  EXPECT_EQ(std::set<std::uint32_t>(taken.begin(), taken.end()).size(), all.size()) << "each is in one";
}

TEST(SurfaceCharts, SidesOfABoxAreOneEachHoweverFineTheyAre) {
  std::vector<SurfaceTriangle> box;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {0.0F, 1.0F}) {
      auto part = grid(5, 3, [&](int i, int j) {
        glm::vec3 p;
        p[axis] = side, p[(axis + 1) % 3] = float(side > 0 ? i : 5 - i) / 5, p[(axis + 2) % 3] = float(j) / 3;
        return p;
      });
      box.insert(box.end(), part.begin(), part.end());
    }
  const auto charts = chartsOf(box);
  EXPECT_EQ(charts.size(), 6U);
  expectSound(box, charts);
  for (std::size_t t = 0; t < box.size(); ++t) box[t].kind = t % 2;
  EXPECT_EQ(chartsOf(box).size(), box.size()) << "neighbours are of another kind";
}

TEST(SurfaceCharts, ARectangleThatLiesAskewHasNoRoomAround) {
  const glm::dvec3 across = glm::normalize(glm::dvec3(2, 1, 0.5)),
                   down = glm::normalize(glm::cross(across, glm::dvec3(0.2, -1, 1)));
  const auto charts =
      chartsOf(grid(4, 7, [&](int i, int j) { return glm::vec3(3.0 + 0.5 * i * across + 0.5 * j * down); }));
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_NEAR(charts[0].size.x, 3.5, 1e-5);
  EXPECT_NEAR(charts[0].size.y, 2, 1e-5);
}

TEST(SurfaceCharts, AFrameIsCutIntoItsSides) {
  std::vector<SurfaceTriangle> frame;
  for (int side = 0; side < 4; ++side) {
    const auto turned = [&](float x, float y) {
      for (int k = 0; k < side; ++k) x = -std::exchange(y, x);
      return glm::vec3(x, y, 1);
    };
    addQuad(frame, turned(-1, -1), turned(1, -1), turned(0.9F, -0.9F), turned(-0.9F, -0.9F));
  }
  const auto charts = chartsOf(frame);
  expectSound(frame, charts);
  EXPECT_LE(charts.size(), 6U);
  double rectangles = 0;
  for (const SurfaceChart& chart : charts) rectangles += chart.size.x * chart.size.y;
  EXPECT_LT(rectangles, 1.2) << "of 4 square metres around it; it has 0.8 itself";
}

TEST(SurfaceCharts, BentSurfacesAreCutBeforeTheyFold) {
  const auto onSphere = [](int i, int j) {
    const double round = 0.3 * i, up = 0.15 * j - 1.4;
    return glm::vec3(std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up));
  };
  const auto ball = grid(20, 18, onSphere);
  const auto charts = chartsOf(ball);
  expectSound(ball, charts);
  EXPECT_LT(charts.size(), ball.size() / 4) << "more than one triangle each";
  EXPECT_GT(charts.size(), 12U);

  // A flat spiral stair without steps: its windings lie above each other.
  const auto ramp = grid(90, 2, [](int i, int j) {
    const double round = 0.2 * i, radius = 2 + 0.5 * j;
    return glm::vec3(radius * std::cos(round), radius * std::sin(round), 0.02 * i);
  });
  const auto windings = chartsOf(ramp);
  expectSound(ramp, windings);
  EXPECT_GE(windings.size(), 2U);
  EXPECT_LE(windings.size(), 12U);
}

TEST(SurfaceCharts, WhatIsThereTwiceOrHasNoAreaIsApart) {
  std::vector<SurfaceTriangle> twice;
  for (int k = 0; k < 2; ++k) addQuad(twice, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_EQ(chartsOf(twice).size(), 2U);
  twice.push_back({{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0.5F, 0, 0)}, 0});
  twice.push_back({{glm::vec3(2), glm::vec3(2), glm::vec3(2)}, 0});
  const auto charts = chartsOf(twice);
  EXPECT_EQ(charts.size(), 4U);
  for (const SurfaceChart& chart : charts)
    EXPECT_TRUE(std::isfinite(chart.size.x) && std::isfinite(chart.origin.x) &&
                std::isfinite(chart.across.x));
  EXPECT_TRUE(chartsOf({}).empty());
}

TEST(SurfaceCharts, TrianglesOverlapWhereTheyShareMoreThanABorder) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(0, 1);
  int overlapping = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto any = [&] {
      Corners t{glm::dvec2(at(random), at(random)), {at(random), at(random)}, {at(random), at(random)}};
      const glm::dvec2 a = t[1] - t[0], b = t[2] - t[0];
      if (a.x * b.y < a.y * b.x) std::swap(t[1], t[2]);
      return t;
    };
    const Corners a = any(), b = any();
    EXPECT_EQ(overlap(a, b), overlap(b, a));
    const double shared = std::max(sharedDepth(a, b), sharedDepth(b, a));
    if (shared > 3 * kWeld) {
      EXPECT_TRUE(overlap(a, b));
    }
    if (overlap(a, b)) {
      ++overlapping;
      EXPECT_GT(shared, -0.05);
    }
    Corners beside{a[0], a[2], a[0] + a[2] - a[1]};  // across an edge
    EXPECT_FALSE(overlap(a, beside));
  }
  EXPECT_GT(overlapping, 500);
  EXPECT_LT(overlapping, 2500);
}

}  // namespace
}  // namespace acentric
