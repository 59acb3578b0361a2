/// Geometry that breaks programs: needles, triangles without area, numbers that are none, walls exactly on a
/// region's border, edges with many triangles. Each case is checked on the real thing and on a deliberately
/// naive variant that must fail.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "engine/scene/decimate.h"
#include "engine/scene/finish_scene.h"
#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float operator()(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }

 private:
  std::mt19937 engine_;
};

template <class Vector>
Vector normalOf(const Vector& a, const Vector& b, const Vector& c) {
  return glm::normalize(glm::cross(b - a, c - a));
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x + v.y + v.z); }

SourceScene sourceOf(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> triangles) {
  SourceScene source;
  source.metresPerUnit = 1;
  source.up = UpAxis::z;
  source.materials.emplace_back();
  SourceMesh& mesh = source.meshes.emplace_back();
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return source;
}

TEST(HardCases, TrianglesWithoutAreaAndBrokenNumbersAreDroppedAndNotMadeIntoNormals) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> positions{{0, 0, 0},   {1, 0, 0},        {0, 1, 0},       {2, 0, 0},
                                          {nan, 0, 0}, {0, infinity, 0}, {0.5, 1e-12, 0}, {0.5, 1e-4, 0}};
  // Sound, one line, one corner twice, not a number, infinite, of a picometre, no such corner, a sound
  // needle.
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 1, 3}, {0, 1, 1},  {0, 1, 4},
                                          {0, 1, 5}, {0, 1, 6}, {0, 1, 99}, {0, 1, 7}};
  const Scene scene = finishScene(sourceOf(positions, triangles), "hard", {}, {}).value();
  EXPECT_EQ(scene.triangleCount(), 2u);
  EXPECT_EQ(scene.report.dropped.size(), 3u) << "each reason is told";
  EXPECT_TRUE(finite(scene.bounds.min) && finite(scene.bounds.max));
  for (const glm::vec3& normal : scene.meshes[0].normals) EXPECT_NEAR(normal.z, 1, 1e-6);

  int notNumbers = 0;
  Bounds bounds;
  for (const glm::uvec3& t : triangles) {
    if (t.z >= positions.size()) continue;
    const glm::vec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    notNumbers += !finite(normalOf(a, b, c));
    bounds.add(b), bounds.add(c);
  }
  EXPECT_GE(notNumbers, 4);
  EXPECT_FALSE(finite(bounds.max));
}

TEST(HardCases, NeedlesHaveTheNormalOfTheirCornersAndNotOfRoundedProducts) {
  Random random(71);
  int naiveWrong = 0;
  constexpr int kNeedles = 500;
  for (int n = 0; n < kNeedles; ++n) {
    const glm::vec3 a(random(-9, 9), random(-9, 9), random(-9, 9));
    const glm::vec3 along(random(-1, 1), random(-1, 1), random(-1, 1));
    const glm::vec3 b = a + along;
    const glm::vec3 c = a + 0.4f * along + 1e-5f * glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1));
    const glm::dvec3 truth = normalOf(glm::dvec3(a), glm::dvec3(b), glm::dvec3(c));
    if (!std::isfinite(truth.x)) continue;
    const auto scene = finishScene(sourceOf({a, b, c}, {{0, 1, 2}}), "needle", {}, {});
    if (!scene) continue;  // too thin for any normal: dropped, and said
    EXPECT_LT(glm::distance(glm::dvec3(scene->meshes[0].normals[0]), truth), 1e-6);
    // In floats, and corners by the products themselves.
    const glm::vec3 rounded = glm::cross(a, b) + glm::cross(b, c) + glm::cross(c, a);
    naiveWrong += !(glm::distance(glm::dvec3(glm::normalize(rounded)), truth) < 0.1);
  }
  EXPECT_GT(naiveWrong, kNeedles / 4);
}

// ---- Walls on a region's border --------------------------------------------------------------------------

double areaOf(const LocalGeometry& local) {
  double area = 0;
  for (const LocalTriangle& t : local.triangles) {
    const glm::dvec3 a(local.vertices[t.vertices.x].position), b(local.vertices[t.vertices.y].position),
        c(local.vertices[t.vertices.z].position);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// How many of a wall's four corners a region keeps that measures distances to its edges in floats.
int keptByDistances(const ConvexPolygon& polygon, const std::array<glm::vec3, 4>& wall) {
  int kept = 0;
  for (const glm::vec3& p : wall) {
    bool inside = true;
    for (std::size_t e = 0; e < polygon.size(); ++e) {
      const glm::vec2 a(polygon.corners[e]), b(polygon.corners[(e + 1) % polygon.size()]);
      const glm::vec2 normal = glm::normalize(glm::vec2(a.y - b.y, b.x - a.x));
      inside = inside && glm::dot(normal, glm::vec2(p)) - glm::dot(normal, a) >= 0;
    }
    kept += inside;
  }
  return kept;
}

TEST(HardCases, AWallOnABorderIsWholeAndOnceOnEitherSideAndNotHalfLostToRounding) {
  Random random(72);
  int naiveLost = 0;
  constexpr int kWalls = 300;
  for (int n = 0; n < kWalls; ++n) {
    // From a to b along the border, some way along it to either side of its corners.
    const glm::vec2 a(random(-500, 500), random(-500, 500)), b = a + glm::vec2(random(1, 3), random(1, 3));
    const glm::dvec2 p(a), q(b), aside(q.y - p.y, p.x - q.x);
    const ConvexPolygon left{{p, q, 0.5 * (p + q) - aside}}, right{{q, p, 0.5 * (p + q) + aside}};
    const std::array<glm::vec3, 4> wall{glm::vec3(a, 0), glm::vec3(b, 0), glm::vec3(b, 3), glm::vec3(a, 3)};
    Scene scene;
    scene.materials.emplace_back();
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions.assign(wall.begin(), wall.end());
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (const ConvexPolygon* region : {&left, &right}) {
      const LocalGeometry local = clipToPolygon(scene, *region);
      EXPECT_EQ(local.triangles.size(), 2u);
      EXPECT_NEAR(areaOf(local), 3 * glm::distance(p, q), 1e-5);
      naiveLost += keptByDistances(*region, wall) < 4;
    }
  }
  EXPECT_GT(naiveLost, kWalls / 4) << "of two sides of each wall";
}

TEST(HardCases, AWallOnAnUprightBorderOrBesideItByOneDigitIsWholeOrNothing) {
  const auto areaIn = [](float x, double low, double high) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{x, -1, 0}, {x, 1, 0}, {x, 1, 3}, {x, -1, 3}};
    mesh.normals.assign(4, glm::vec3(1, 0, 0));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return areaOf(clipToPolygon(scene, {{{low, -5}, {high, -5}, {high, 5}, {low, 5}}}));
  };
  EXPECT_NEAR(areaIn(1, 0, 1), 6, 1e-6);
  EXPECT_NEAR(areaIn(1, 1, 2), 6, 1e-6);
  const float beside = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(areaIn(beside, 0, 1), 0);
  EXPECT_NEAR(areaIn(beside, 1, 2), 6, 1e-6);
  // Naively, with a tolerance, which is to clip to polygons that are larger by it: the wall is on both sides
  // and drawn twice by whoever stands on the border.
  const double tolerance = 1e-6;
  EXPECT_NEAR(areaIn(beside, 0 - tolerance, 1 + tolerance), 6, 1e-6);
  EXPECT_NEAR(areaIn(beside, 1 - tolerance, 2 + tolerance), 6, 1e-6);
}

// ---- Meshes that are not manifold ------------------------------------------------------------------------

TEST(HardCases, EdgesOfManyTrianglesAndDuplicatesLoseNoSurfaceWhenSimplified) {
  // A floor of 8 x 8 quads, a wall standing on its middle line, and a triangle given twice.
  constexpr int kQuads = 8;
  DecimationMesh mesh;
  const auto at = [](int x, int y) { return std::uint32_t(y * (kQuads + 1) + x); };
  for (int y = 0; y <= kQuads; ++y)
    for (int x = 0; x <= kQuads; ++x) mesh.positions.emplace_back(x, y, 0);
  const auto top = std::uint32_t(mesh.positions.size());
  for (int x = 0; x <= kQuads; ++x) mesh.positions.emplace_back(x, kQuads / 2, 1);
  const auto addQuad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  for (int y = 0; y < kQuads; ++y)
    for (int x = 0; x < kQuads; ++x) addQuad(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
  for (std::uint32_t x = 0; x < kQuads; ++x)
    addQuad(at(int(x), kQuads / 2), at(int(x) + 1, kQuads / 2), top + x + 1, top + x);
  mesh.triangles.push_back(mesh.triangles[5]);
  const auto areaWhere = [&](const auto& triangles, const auto& cornersOf, bool upright) {
    double area = 0;
    for (const auto& t : triangles) {
      const glm::uvec3 c = cornersOf(t);
      const glm::dvec3 a(mesh.positions[c.x]),
          across = glm::cross(glm::dvec3(mesh.positions[c.y]) - a, glm::dvec3(mesh.positions[c.z]) - a);
      if ((across.z == 0) == upright) area += 0.5 * glm::length(across);
    }
    return area;
  };
  const auto simplified = decimate(mesh, {.mostTriangles = 0, .tolerance = 1e-6}).value();
  EXPECT_LT(simplified.triangles.size(), mesh.triangles.size());
  EXPECT_GE(simplified.split, std::size_t(kQuads));
  const auto own = [](const DecimatedTriangle& t) { return t.vertices; };
  EXPECT_NEAR(areaWhere(simplified.triangles, own, false), kQuads * kQuads + 0.5, 1e-9);
  EXPECT_NEAR(areaWhere(simplified.triangles, own, true), kQuads, 1e-9);

  // Naively: a half-edge mesh, in which each directed edge has one triangle and an edge two.
  std::set<std::pair<std::uint32_t, std::uint32_t>> used;
  std::vector<glm::uvec3> joined;
  for (const glm::uvec3& t : mesh.triangles) {
    const std::pair<std::uint32_t, std::uint32_t> edges[]{{t.x, t.y}, {t.y, t.z}, {t.z, t.x}};
    if (std::ranges::any_of(edges, [&](const auto& edge) { return used.contains(edge); })) continue;
    used.insert(std::begin(edges), std::end(edges));
    joined.push_back(t);
  }
  const auto given = [](const glm::uvec3& t) { return t; };
  EXPECT_LT(areaWhere(joined, given, true), kQuads - 1);
}

}  // namespace
}  // namespace acentric
