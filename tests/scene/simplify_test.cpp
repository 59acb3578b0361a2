#include "engine/scene/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "engine/scene/decimate.h"
#include "engine/scene/triangle_bvh.h"

namespace acentric {
namespace {

ConvexPolygon square(double half) { return {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}}; }

/// A grid of quads over [-1, 1]^2 with a height each; uv = plan position.
Mesh sheet(int quads, const std::function<double(double, double)>& height) {
  Mesh mesh;
  for (int y = 0; y <= quads; ++y)
    for (int x = 0; x <= quads; ++x) {
      const double u = 2.0 * x / quads - 1, v = 2.0 * y / quads - 1;
      mesh.positions.emplace_back(u, v, height(u, v));
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uv[0].emplace_back(u, v);
    }
  const auto at = [&](int x, int y) { return std::uint32_t(y * (quads + 1) + x); };
  for (int y = 0; y < quads; ++y)
    for (int x = 0; x < quads; ++x) {
      mesh.triangles.emplace_back(at(x, y), at(x + 1, y), at(x + 1, y + 1));
      mesh.triangles.emplace_back(at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  return mesh;
}

Scene sceneOf(std::vector<Mesh> meshes, int materials = 1) {
  Scene scene;
  scene.materials.resize(std::size_t(materials));
  scene.textures.resize(1);
  scene.meshes = std::move(meshes);
  scene.bounds = boundsOf(scene);
  return scene;
}

double areaOf(const SimplifiedLocal& local) {
  double area = 0;
  for (const LocalTriangle& t : local.triangles) {
    const glm::dvec3 a(local.vertices[t.vertices.x].position), b(local.vertices[t.vertices.y].position),
        c(local.vertices[t.vertices.z].position);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// Edges that belong to one triangle only, as pairs of points.
std::set<std::pair<std::array<float, 3>, std::array<float, 3>>> openEdges(
    const std::vector<LocalVertex>& vertices, const std::vector<LocalTriangle>& triangles) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> count;
  for (const LocalTriangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 &p = vertices[t.vertices[k]].position, &q = vertices[t.vertices[(k + 1) % 3]].position;
      Point a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
      if (b < a) std::swap(a, b);
      ++count[{a, b}];
    }
  std::set<std::pair<Point, Point>> open;
  for (const auto& [edge, n] : count)
    if (n == 1) open.insert(edge);
  return open;
}

double bump(double x, double y) { return 0.2 * std::cos(1.5 * x) * std::cos(1.5 * y); }

TEST(Simplify, AFlatSheetComesDownToItsRim) {
  const Scene scene = sceneOf({sheet(40, [](double, double) { return 0.5; })});
  const LocalGeometry full = clipToPolygon(scene, square(3));
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = 1e-4});
  ASSERT_TRUE(simplified.has_value()) << simplified.error().describe();
  EXPECT_EQ(simplified->report.before, 3200u);
  EXPECT_LE(simplified->report.after, 200u) << "160 rim edges need 158 triangles";
  EXPECT_LT(simplified->report.maxError, 1e-6);
  EXPECT_NEAR(areaOf(*simplified), 4, 1e-5);
  EXPECT_EQ(openEdges(simplified->vertices, simplified->triangles), openEdges(full.vertices, full.triangles));
}

TEST(Simplify, KeepsToTheErrorAsMeasuredOnEveryRemovedVertex) {
  const Scene scene = sceneOf({sheet(60, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(3));
  std::size_t last = full.triangles.size();
  for (const double error : {0.001, 0.004, 0.016}) {
    const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = error});
    ASSERT_TRUE(simplified.has_value());
    EXPECT_TRUE(simplified->report.withinError);
    EXPECT_LT(simplified->report.after, last) << "more error allows fewer triangles";
    last = simplified->report.after;
    std::vector<TriangleBvh::Corners> corners;
    for (const LocalTriangle& t : simplified->triangles)
      corners.push_back({simplified->vertices[t.vertices.x].position,
                         simplified->vertices[t.vertices.y].position,
                         simplified->vertices[t.vertices.z].position});
    const TriangleBvh tree(corners);
    double worst = 0;
    for (const glm::vec3& p : scene.meshes[0].positions) worst = std::max(worst, tree.nearest(p).distance);
    EXPECT_LE(worst, error);
    EXPECT_LE(worst, simplified->report.maxError + 1e-9);
    EXPECT_GT(simplified->report.meanError, 0);
  }
}

TEST(Simplify, StopsAtTheBudget) {
  const Scene scene = sceneOf({sheet(50, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(3));
  const auto simplified = simplify(scene, full, {.mostTriangles = 1500, .maxError = 0.1});
  ASSERT_TRUE(simplified.has_value());
  EXPECT_LE(simplified->report.after, 1500u);
  EXPECT_GE(simplified->report.after, 1498u) << "no more is taken than needed";
  EXPECT_TRUE(simplified->report.withinBudget);
  const auto impossible = simplify(scene, full, {.mostTriangles = 10, .maxError = 1e-5});
  ASSERT_TRUE(impossible.has_value());
  EXPECT_FALSE(impossible->report.withinBudget) << "the error comes first, and it is said";
  EXPECT_TRUE(impossible->report.withinError);
}

TEST(Simplify, ReachesABudgetThatBordersForbidAndSaysWhatItTook) {
  // Nine sheets apart: their open edges alone hold more triangles than are allowed.
  std::vector<Mesh> sheets;
  for (int k = 0; k < 9; ++k) {
    Mesh mesh = sheet(20, bump);
    for (glm::vec3& p : mesh.positions) p = p * (0.2f + 0.01f * float(k)) + glm::vec3(3 * k, 0, 0);
    sheets.push_back(std::move(mesh));
  }
  const Scene scene = sceneOf(std::move(sheets));
  const LocalGeometry full = clipToPolygon(scene, square(40));
  const auto held = simplify(scene, full, {.mostTriangles = 120, .maxError = 10});
  ASSERT_TRUE(held.has_value());
  ASSERT_FALSE(held->report.withinBudget) << "borders stay as they are";
  EXPECT_EQ(held->report.loosenedFrom, 0u);

  const auto reached = simplify(scene, full, {.mostTriangles = 120, .maxError = 10, .reach = true});
  ASSERT_TRUE(reached.has_value());
  EXPECT_TRUE(reached->report.withinBudget);
  EXPECT_GE(reached->report.after, 110u);
  EXPECT_EQ(reached->report.loosenedFrom, held->report.after);
  EXPECT_EQ(reached->report.piecesLeftOut, 0u) << "collapses suffice";
  EXPECT_LT(reached->report.maxError, 0.2) << "open edges move last";
  ASSERT_TRUE(reached->check(scene));

  const auto fewest = simplify(scene, full, {.mostTriangles = 5, .maxError = 10, .reach = true});
  ASSERT_TRUE(fewest.has_value());
  EXPECT_TRUE(fewest->report.withinBudget);
  EXPECT_GT(fewest->report.piecesLeftOut, 3u);
  EXPECT_GE(fewest->report.trianglesLeftOut, fewest->report.piecesLeftOut);
  for (const SimplifiedMesh& mesh : fewest->meshes)
    EXPECT_GE(mesh.sceneMesh, 4u) << "the smallest are left out";
  EXPECT_FALSE(simplify(scene, full, {.mostTriangles = 0, .reach = true}));
}

TEST(Simplify, LeavesTheRegionsRimAsItWasCut) {
  const Scene scene = sceneOf({sheet(40, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(0.537));
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = 0.01});
  ASSERT_TRUE(simplified.has_value());
  EXPECT_GT(simplified->report.rim, 50u);
  EXPECT_LT(simplified->report.after, full.triangles.size() * 2 / 3);
  EXPECT_EQ(openEdges(simplified->vertices, simplified->triangles), openEdges(full.vertices, full.triangles));
  for (const LocalVertex& v : simplified->vertices) {
    EXPECT_LE(std::abs(v.position.x), 0.537f + 1e-6f);
    EXPECT_LE(std::abs(v.position.y), 0.537f + 1e-6f);
  }
}

TEST(Simplify, KeepsMaterialBordersAndTextureSeams) {
  // Two materials meet at x = -0.5 within one height field; the second has a seam in its texture at x = 0.5.
  const Mesh whole = sheet(40, bump);
  std::vector<Mesh> parts(2);
  for (int part = 0; part < 2; ++part) {
    parts[std::size_t(part)] = whole;
    parts[std::size_t(part)].material = part;
    parts[std::size_t(part)].triangles.clear();
  }
  Mesh& right = parts[1];
  const auto count = std::uint32_t(whole.positions.size());
  for (std::uint32_t v = 0; v < count; ++v) {  // copies of all vertices with other coordinates
    right.positions.push_back(whole.positions[v]);
    right.normals.push_back(whole.normals[v]);
    right.uv[0].push_back(whole.uv[0][v] + glm::vec2(10, 0));
  }
  for (const glm::uvec3& t : whole.triangles) {
    const float x = (whole.positions[t.x].x + whole.positions[t.y].x + whole.positions[t.z].x) / 3;
    parts[x < -0.5f ? 0 : 1].triangles.push_back(x < 0.5f ? t : t + count);
  }
  Scene scene = sceneOf(parts, 2);
  for (Material& material : scene.materials) material.baseColourTexture.texture = 0;
  const LocalGeometry full = clipToPolygon(scene, square(3));
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = 0.02});
  ASSERT_TRUE(simplified.has_value());
  EXPECT_LT(simplified->report.after, full.triangles.size() / 2);
  ASSERT_EQ(simplified->meshes.size(), 2u);
  const LocalGeometry own = localGeometryOf(*simplified, scene, full.polygon, nullptr);
  std::size_t onBorder = 0, onSeam = 0;
  for (const LocalTriangle& t : simplified->triangles) {
    const Mesh& mesh = own.surfaces->meshes[t.mesh];
    float low = 9, high = -9, uvOffset = 0;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& p = simplified->vertices[t.vertices[k]].position;
      low = std::min(low, p.x), high = std::max(high, p.x);
      const glm::vec2 uv = mesh.uv[0][mesh.triangles[t.triangle][k]];
      const float offset = uv.x - p.x;
      EXPECT_TRUE(std::abs(offset) < 1e-5f || std::abs(offset - 10) < 1e-5f);
      EXPECT_TRUE(k == 0 || std::abs(offset - uvOffset) < 1e-4f) << "a triangle lies on one side of the seam";
      uvOffset = offset;
    }
    EXPECT_TRUE(mesh.material == 0 ? high <= -0.5f + 1e-6f : low >= -0.5f - 1e-6f);
    EXPECT_TRUE(uvOffset > 5 ? low >= 0.5f - 1e-6f : high <= 0.5f + 1e-6f);
    onBorder += high == -0.5f || low == -0.5f ? 1 : 0;
    onSeam += high == 0.5f || low == 0.5f ? 1 : 0;
  }
  EXPECT_GT(onBorder, 20u);
  EXPECT_GT(onSeam, 20u);
  // No crack opens along them: the surface's open edges are those of the sheet.
  EXPECT_EQ(openEdges(simplified->vertices, simplified->triangles), openEdges(full.vertices, full.triangles));
}

TEST(Simplify, TexturesDoNotSlideFurtherThanTheError) {
  Mesh mesh = sheet(40, [](double, double) { return 0.0; });
  for (glm::vec2& uv : mesh.uv[0])
    uv.x += 0.15f * std::sin(4 * uv.x) * std::cos(4 * uv.y);  // flat, but painted unevenly
  Scene scene = sceneOf({mesh});
  scene.materials[0].baseColourTexture.texture = 0;
  const LocalGeometry full = clipToPolygon(scene, square(3));
  const double error = 0.01;
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = error});
  ASSERT_TRUE(simplified.has_value());
  EXPECT_LT(simplified->report.after, full.triangles.size() / 2);
  EXPECT_GT(simplified->report.after, 300u) << "it is not painted like a flat sheet";
  const LocalGeometry local = localGeometryOf(*simplified, scene, full.polygon, nullptr);
  double worst = 0;
  for (const LocalTriangle& t : simplified->triangles) {
    const Mesh& own = local.surfaces->meshes[t.mesh];
    glm::dvec2 p(0), uv(0);
    for (int k = 0; k < 3; ++k) {
      p += glm::dvec2(simplified->vertices[t.vertices[k]].position) / 3.0;
      uv += glm::dvec2(own.uv[0][own.triangles[t.triangle][k]]) / 3.0;
    }
    worst = std::max(worst, std::abs(p.x + 0.15 * std::sin(4 * p.x) * std::cos(4 * p.y) - uv.x));
  }
  EXPECT_LT(worst, 2.5 * error) << "uv and metres are about one to one here, up to 1.6 to one";
}

TEST(Simplify, LosesNoTriangleOfAMeshThatIsNotManifold) {
  // Three fans around one edge, a sheet with a wall on it, and a triangle given twice.
  Mesh mesh = sheet(20, [](double, double) { return 0.0; });
  const auto at = [](int x, int y) { return std::uint32_t(y * 21 + x); };
  for (int x = 4; x < 16; ++x) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int k = 0; k < 2; ++k) {
      mesh.positions.push_back(mesh.positions[at(x + k, 10)] + glm::vec3(0, 0, 0.3f));
      mesh.normals.emplace_back(0, 1, 0);
      mesh.uv[0].emplace_back(0, 0);
    }
    mesh.triangles.emplace_back(at(x, 10), at(x + 1, 10), first + 1);
    mesh.triangles.emplace_back(at(x, 10), first + 1, first);
  }
  mesh.triangles.push_back(mesh.triangles[100]);
  Scene scene = sceneOf({mesh});
  const LocalGeometry full = clipToPolygon(scene, square(3));
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = 1e-4});
  ASSERT_TRUE(simplified.has_value()) << simplified.error().describe();
  EXPECT_GE(simplified->report.split, 13u);
  EXPECT_LT(simplified->report.maxError, 1e-6) << "the wall and the floor are both still there";
  EXPECT_NEAR(areaOf(*simplified), 4 + 12 * 0.1 * 0.3 + 0.5 * 0.1 * 0.1, 1e-4);
}

TEST(Simplify, GivesTrianglesTheLightOfThePlaceTheyCover) {
  const Scene scene = sceneOf({sheet(40, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(3));
  SurfaceLight light;  // brightness follows x, on the front; another on the back
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    light.firstSample.push_back(std::uint32_t(light.light.size()));
    light.resolution.push_back(1);
    light.hasBack.push_back(1);
    for (const float side : {1.0f, 3.0f})
      for (const int corner : {0, 2, 1})  // weights (0,0), (0,1), (1,0)
        light.light.push_back(
            packColour(glm::vec4(side * (2 + mesh.positions[mesh.triangles[t][corner]].x), 1, 0.25f, 1)));
  }
  light.firstSample.push_back(std::uint32_t(light.light.size()));
  const auto simplified = simplify(scene, full, {.mostTriangles = 0, .maxError = 0.01, .lightTexel = 0.1});
  ASSERT_TRUE(simplified.has_value());
  ASSERT_LT(simplified->report.after, full.triangles.size() / 2);
  const LocalGeometry local = localGeometryOf(*simplified, scene, full.polygon, &light);
  ASSERT_TRUE(local.surfaces);
  const SurfaceLight& own = local.surfaces->light;
  ASSERT_EQ(own.firstSample.size(), local.triangles.size() + 1);
  ASSERT_EQ(own.firstSample.back(), own.light.size());
  std::uint32_t number = 0;
  for (const LocalTriangle& t : local.triangles) {
    ASSERT_EQ(t.triangle, number);  // one mesh
    for (const glm::vec2 weights : {glm::vec2(0.3f, 0.3f), {0.8f, 0.1f}, {0.05f, 0.9f}}) {
      glm::vec3 p(0);
      for (int k = 0; k < 3; ++k)
        p += local.vertices[t.vertices[k]].position * (k == 0   ? 1 - weights.x - weights.y
                                                       : k == 1 ? weights.x
                                                                : weights.y);
      EXPECT_NEAR(own.at(number, weights, false).x, 2 + p.x, 0.03);
      EXPECT_NEAR(own.at(number, weights, true).x, 3 * (2 + p.x), 0.09);
      EXPECT_NEAR(own.at(number, weights, true).z, 0.25, 1e-3);
    }
    ++number;
  }
  EXPECT_TRUE(localGeometryOf(*simplified, scene, full.polygon, nullptr).surfaces->light.empty())
      << "nothing baked yet";
}

TEST(Simplify, IsTheSameEachTimeAndStopsWhenAsked) {
  const Scene scene = sceneOf({sheet(30, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(0.8));
  const SimplifyOptions options{.mostTriangles = 400, .maxError = 0.05};
  const auto first = simplify(scene, full, options), second = simplify(scene, full, options);
  ASSERT_EQ(first->triangles.size(), second->triangles.size());
  for (std::size_t t = 0; t < first->triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(first->vertices[first->triangles[t].vertices[k]].position,
                second->vertices[second->triangles[t].vertices[k]].position);
  std::stop_source source;
  source.request_stop();
  const auto stopped = simplify(scene, full, options, source.get_token());
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  EXPECT_FALSE(simplify(scene, full, {.maxError = 0}).has_value());
  EXPECT_FALSE(simplify(scene, full, {.lightTexel = -1}).has_value());
  const auto nothing = simplify(scene, clipToPolygon(scene, {{{5, 5}, {6, 5}, {5, 6}}}), options);
  ASSERT_TRUE(nothing.has_value());
  EXPECT_TRUE(nothing->triangles.empty());
}

TEST(Simplify, IsCheckedAgainstItsScene) {
  const Scene scene = sceneOf({sheet(20, bump)});
  const LocalGeometry full = clipToPolygon(scene, square(0.83));
  const SimplifiedLocal sound = simplify(scene, full, {.mostTriangles = 0, .maxError = 0.01}).value();
  EXPECT_TRUE(sound.check(scene).has_value());
  const std::vector<std::function<void(SimplifiedLocal&)>> breakages{
      [](SimplifiedLocal& s) { s.meshes[0].sceneMesh = 1; },
      [](SimplifiedLocal& s) { s.meshes[0].sceneVertices[3] = 441; },
      [](SimplifiedLocal& s) { s.meshes[0].triangles[2].y = 99999; },
      [](SimplifiedLocal& s) { s.triangles[1].triangle = 99999; },
      [](SimplifiedLocal& s) { s.triangles[1].vertices.z = 99999; },
      [](SimplifiedLocal& s) { s.lightFrom.pop_back(); },
      [](SimplifiedLocal& s) { s.lightFrom[0] = 800; },
      [](SimplifiedLocal& s) { s.lightPlaces.pop_back(); },
      [](SimplifiedLocal& s) { s.lightPlaces[0].sceneTriangle = 800; },
      [](SimplifiedLocal& s) { s.lightPlaces[0].barycentric.x = std::nanf(""); },
      [](SimplifiedLocal& s) { s.vertices[0].position.x = std::nanf(""); }};
  for (std::size_t n = 0; n < breakages.size(); ++n) {
    SimplifiedLocal broken = sound;
    breakages[n](broken);
    EXPECT_FALSE(broken.check(scene).has_value()) << n;
  }
}

TEST(TriangleBvh, FindsTheNearestPointThatASearchOfAllFinds) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> place(-1, 1);
  std::vector<TriangleBvh::Corners> triangles(300);
  for (auto& triangle : triangles) {
    const glm::vec3 at(place(engine), place(engine), place(engine));
    for (glm::vec3& corner : triangle)
      corner = at + 0.2f * glm::vec3(place(engine), place(engine), place(engine));
  }
  triangles[7][1] = triangles[7][0];  // degenerate ones are edges
  const TriangleBvh tree(triangles);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 p(2 * place(engine), place(engine), place(engine));
    // The slow truth: a dense sampling bounds the distance from above, the tree's point lies on a triangle.
    double least = 1e9;
    for (const auto& t : triangles) {
      const std::array<glm::dvec3, 3> corners{t[0], t[1], t[2]};
      least = std::min(least, glm::distance(p, pointOn(corners, nearestOnTriangle(corners, p))));
    }
    const TriangleBvh::Nearest found = tree.nearest(p);
    ASSERT_TRUE(found.found());
    EXPECT_NEAR(found.distance, least, 1e-12);
    const auto& t = triangles[found.triangle];
    EXPECT_NEAR(glm::distance(p, pointOn({t[0], t[1], t[2]}, found.weights)), found.distance, 1e-12);
    EXPECT_FALSE(tree.nearest(p, 0.5 * least).found() && least > 0);
  }
  for (int n = 0; n < 200; ++n) {  // nearestOnTriangle against a dense grid of its points
    const auto& t = triangles[std::size_t(n)];
    const std::array<glm::dvec3, 3> corners{t[0], t[1], t[2]};
    const glm::dvec3 p(place(engine), place(engine), place(engine));
    const double distance = glm::distance(p, pointOn(corners, nearestOnTriangle(corners, p)));
    double sampled = 1e9;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j)
        sampled = std::min(sampled, glm::distance(p, pointOn(corners, {i / 40.0, j / 40.0})));
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GT(distance, sampled - 0.02);
  }
}

}  // namespace
}  // namespace acentric
