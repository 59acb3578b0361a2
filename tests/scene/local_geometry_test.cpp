#include "engine/scene/local_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <tuple>

#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

ConvexPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

Scene sceneOf(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles) {
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

double sumOfAreas(const LocalGeometry& local) {
  double area = 0;
  for (const LocalTriangle& t : local.triangles) {
    const glm::dvec3 a(local.vertices[t.vertices.x].position), b(local.vertices[t.vertices.y].position),
        c(local.vertices[t.vertices.z].position);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// Floor of 20 x 20 m at z = 0, two triangles.
Scene floorScene() {
  return sceneOf({{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(LocalGeometry, AFloorIsCutToThePolygonsArea) {
  EXPECT_NEAR(sumOfAreas(clipToPolygon(floorScene(), rectangle(-1, -2, 3, 4))), 24, 1e-5);
  ConvexPolygon hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.corners.push_back(2.0 * glm::dvec2(std::cos(i * M_PI / 3), std::sin(i * M_PI / 3)));
  EXPECT_NEAR(sumOfAreas(clipToPolygon(floorScene(), hexagon)), 1.5 * std::sqrt(3.0) * 4, 1e-5);
}

TEST(LocalGeometry, ATriangleInsideIsKeptAsItIsAndOneOutsideIsDropped) {
  const Scene scene =
      sceneOf({{0, 0, 5}, {1, 0, 6}, {0, 1, 7}, {20, 0, 0}, {21, 0, 0}, {20, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  const LocalGeometry local = clipToPolygon(scene, rectangle(-2, -2, 2, 2));
  ASSERT_EQ(local.triangles.size(), 1u);
  EXPECT_EQ(local.triangles[0].triangle, 0u);
  ASSERT_EQ(local.vertices.size(), 3u);
  EXPECT_EQ(local.vertices[1].position, glm::vec3(1, 0, 6));
  EXPECT_EQ(local.vertices[1].barycentric, glm::vec2(1, 0));
  EXPECT_EQ(local.vertices[2].barycentric, glm::vec2(0, 1));
}

TEST(LocalGeometry, ATouchingEdgeAddsNothing) {
  const Scene scene = sceneOf({{1, 0, 0}, {1, 1, 0}, {2, 0, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(clipToPolygon(scene, rectangle(0, -5, 1, 5)).triangles.empty());
  EXPECT_TRUE(clipToPolygon(scene, rectangle(0, -5, 1, 5)).vertices.empty());
}

TEST(LocalGeometry, PositionsFollowFromTheBarycentricWeightsAndStayInside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-4, 4);
  const ConvexPolygon polygon{{{-1.5, -1}, {1.7, -1.2}, {2.1, 0.9}, {0.2, 2.2}, {-1.9, 1.1}}};
  for (int round = 0; round < 300; ++round) {
    std::vector<glm::vec3> p(3);
    for (glm::vec3& corner : p) corner = {coordinate(random), coordinate(random), coordinate(random)};
    const LocalGeometry local = clipToPolygon(sceneOf(p, {{0, 1, 2}}), polygon);
    for (const LocalVertex& v : local.vertices) {
      const glm::vec3 expected = p[0] + v.barycentric.x * (p[1] - p[0]) + v.barycentric.y * (p[2] - p[0]);
      EXPECT_NEAR(glm::distance(v.position, expected), 0, 2e-5);
      for (std::size_t e = 0; e < polygon.size(); ++e) {
        const glm::dvec2 edge = polygon.corners[(e + 1) % polygon.size()] - polygon.corners[e];
        const glm::dvec2 offset = glm::dvec2(v.position) - polygon.corners[e];
        EXPECT_GT((edge.x * offset.y - edge.y * offset.x) / glm::length(edge), -1e-6);
      }
    }
  }
}

TEST(LocalGeometry, TrianglesThatShareAnEdgeAreCutAtTheVerySamePoint) {
  // Else there is a crack along the border, as wide as rounding, which a frame shows as a dotted line.
  std::mt19937 random(8);
  std::uniform_real_distribution<float> place(-5, 5);
  const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
  const ConvexPolygon polygon{{{-1.03, -0.97}, {1.01, -1.1}, {0.9, 1.2}, {-0.8, 0.93}}};
  int cut = 0;
  for (int round = 0; round < 2000; ++round) {
    const glm::vec3 a = point(), b = point(), left = point(), right = point();
    // One goes along the edge from a to b, the other from b to a.
    const auto cornersOn = [&](const std::array<glm::vec3, 3>& triangle, int third) {
      PolygonClipper clipper(polygon);
      std::vector<glm::dvec3> on;
      for (const PolygonClipper::Corner& corner : clipper.clip(triangle)) {
        const glm::dvec3 weights(1 - corner.barycentric.x - corner.barycentric.y, corner.barycentric);
        if (std::abs(weights[third]) < 1e-12) on.push_back(corner.position);
      }
      std::ranges::sort(on, {}, [](const glm::dvec3& p) { return std::tuple(p.x, p.y, p.z); });
      return on;
    };
    const auto one = cornersOn({a, b, left}, 2), other = cornersOn({b, a, right}, 2);
    EXPECT_EQ(one, other) << round;
    cut += one.size() == 2;
  }
  EXPECT_GT(cut, 100);
}

TEST(LocalGeometry, PiecesOfATilingAddUpToTheWhole) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-2.9f, 2.9f);
  for (int round = 0; round < 60; ++round) {
    std::vector<glm::vec3> p(3);
    for (glm::vec3& corner : p) corner = {coordinate(random), coordinate(random), coordinate(random)};
    const Scene scene = sceneOf(p, {{0, 1, 2}});
    double sum = 0;
    for (int x = -3; x < 3; ++x)
      for (int y = -3; y < 3; ++y) sum += sumOfAreas(clipToPolygon(scene, rectangle(x, y, x + 1, y + 1)));
    const double whole = 0.5 * glm::length(glm::cross(glm::dvec3(p[1] - p[0]), glm::dvec3(p[2] - p[0])));
    EXPECT_NEAR(sum, whole, 1e-4 * (1 + whole));
  }
}

}  // namespace
}  // namespace acentric
