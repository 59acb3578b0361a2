/// What regions draw of instances stands where the instance does, and rays are told of the same places.

#include "engine/scene/drawn_scene.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/placed_mesh.h"

namespace acentric {
namespace {

/// A fan of crooked triangles round a middle, with attributes; the last vertices are no triangle's.
Mesh fan() {
  Mesh mesh;
  mesh.name = "fan";
  for (int k = 0; k < 12; ++k) {
    const float turn = 0.5f * float(k);
    mesh.positions.emplace_back(std::cos(turn) * (1 + 0.1f * float(k)), std::sin(turn), 0.2f * float(k % 3));
    mesh.normals.push_back(glm::normalize(glm::vec3(0.1f * float(k), 0.3f, 1)));
    mesh.tangents.emplace_back(glm::normalize(glm::vec3(1, 0.1f * float(k), 0)), k % 2 == 0 ? 1 : -1);
    mesh.uv[0].emplace_back(0.1f * float(k), 1 - 0.05f * float(k));
    mesh.colours.emplace_back(10 * k, 255 - k, k, 255);
  }
  for (std::uint32_t k = 1; k + 1 < 10; ++k) mesh.triangles.emplace_back(0, k, k + 1);
  return mesh;
}

/// One mesh that stands as it is, and three instances: as it is, turned and stretched, mirrored.
ScenePtr tracedScene() {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {fan()};
  scene->prototypes = {fan()};
  scene->instances = {{0, glm::mat4x3(1)},
                      {0, {{0.3f, 1.1f, 0.2f}, {-0.9f, 0.4f, 0}, {0.1f, 0.2f, 0.8f}, {3, 1, 0.5f}}},
                      {0, {{-1, 0, 0}, {0, 1, 0.3f}, {0, 0, 1}, {-4, 2, 0}}}};
  return scene;
}

std::shared_ptr<const InstanceExcerpts> excerpts() {
  return std::make_shared<const InstanceExcerpts>(InstanceExcerpts{{1, {0, 3, 4, 7}}, {2, {1, 2, 6}}});
}

glm::vec3 at(const std::array<glm::vec3, 3>& c, const glm::vec2& b) {
  return c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y;
}

TEST(DrawnScene, OfNoInstanceIsTheSceneItself) {
  const ScenePtr scene = tracedScene();
  const DrawnScene drawn(scene);
  EXPECT_EQ(drawn.sharedScene(), scene);
  const auto place = drawn.traced(0, 3, {0.2f, 0.5f});
  EXPECT_EQ(place.placed, 0u);
  EXPECT_EQ(place.triangle, 3u);
  EXPECT_EQ(place.barycentric, glm::vec2(0.2f, 0.5f));
  EXPECT_EQ(drawn.numberOf(0, 3), 3u);
  EXPECT_FALSE(drawn.numberOf(1, 3));
}

TEST(DrawnScene, HasExcerptsAsThoseTrianglesOfTheWholeInstance) {
  const ScenePtr scene = tracedScene();
  const auto some = excerpts();
  const DrawnScene drawn(scene, some);
  ASSERT_EQ(drawn.scene().meshes.size(), 3u);
  EXPECT_TRUE(drawn.scene().instances.empty());
  EXPECT_TRUE(drawn.scene().prototypes.empty());
  for (std::size_t e = 0; e < some->size(); ++e) {
    const InstanceExcerpt& excerpt = (*some)[e];
    const Mesh whole = placedAsMesh(*scene, scene->instances[excerpt.instance]);
    const Mesh& part = drawn.scene().meshes[1 + e];
    ASSERT_EQ(part.triangles.size(), excerpt.triangles.size());
    EXPECT_LT(part.positions.size(), whole.positions.size()) << "only vertices that are used";
    EXPECT_EQ(part.material, whole.material);
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = part.triangles[t][k], b = whole.triangles[excerpt.triangles[t]][k];
        EXPECT_EQ(part.positions[a], whole.positions[b]);
        EXPECT_EQ(part.normals[a], whole.normals[b]);
        EXPECT_EQ(part.tangents[a], whole.tangents[b]);
        EXPECT_EQ(part.uv[0][a], whole.uv[0][b]);
        EXPECT_EQ(part.colours[a], whole.colours[b]);
      }
    EXPECT_TRUE(part.uv[1].empty());
    EXPECT_EQ(drawn.boxes()[1 + e].min, boundsOf({part})[0].min);
    EXPECT_EQ(drawn.boxes()[1 + e].max, boundsOf({part})[0].max);
  }
}

TEST(DrawnScene, TellsWhereRaysMeetATriangle) {
  const ScenePtr scene = tracedScene();
  const DrawnScene drawn(scene, excerpts());
  const auto first = drawn.scene().firstTriangles();
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> random(0, 0.5f);
  for (std::uint32_t m = 0; m < drawn.scene().meshes.size(); ++m) {
    const PlacedMesh mesh(drawn.scene(), m);
    for (std::uint32_t t = 0; t < mesh.mesh().triangles.size(); ++t) {
      const glm::vec2 b(random(engine), random(engine));
      const DrawnScene::Place place = drawn.traced(m, t, b);
      const PlacedMesh placed(*scene, place.placed);
      EXPECT_LT(glm::distance(at(mesh.corners(t), b), at(placed.corners(place.triangle), place.barycentric)),
                1e-5f);
      EXPECT_LT(
          glm::distance(at({mesh.normal(mesh.mesh().triangles[t].x), mesh.normal(mesh.mesh().triangles[t].y),
                            mesh.normal(mesh.mesh().triangles[t].z)},
                           b),
                        at({placed.normal(placed.mesh().triangles[place.triangle].x),
                            placed.normal(placed.mesh().triangles[place.triangle].y),
                            placed.normal(placed.mesh().triangles[place.triangle].z)},
                           place.barycentric)),
          1e-5f);
      EXPECT_EQ(drawn.numberOf(place.placed, place.triangle), first[m] + t);
    }
  }
  EXPECT_FALSE(drawn.numberOf(1, 0)) << "nothing of the first instance is drawn";
  EXPECT_FALSE(drawn.numberOf(2, 1));
  EXPECT_FALSE(drawn.numberOf(3, 0));
}

TEST(DrawnScene, IsClippedAsAllOfItsMeshesAre) {
  const ScenePtr scene = tracedScene();
  const DrawnScene drawn(scene, excerpts());
  for (const double x : {-5.0, -1.0, 0.3, 2.5, 30.0}) {
    const ConvexPolygon polygon{{{x, -0.5}, {x + 1.5, -0.2}, {x + 1, 2.5}}};
    const LocalGeometry a = clipToPolygon(drawn, polygon), b = clipToPolygon(drawn.scene(), polygon);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
      EXPECT_EQ(a.triangles[t].mesh, b.triangles[t].mesh);
      EXPECT_EQ(a.triangles[t].triangle, b.triangles[t].triangle);
    }
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
      EXPECT_EQ(a.vertices[v].position, b.vertices[v].position);
  }
}

}  // namespace
}  // namespace acentric
