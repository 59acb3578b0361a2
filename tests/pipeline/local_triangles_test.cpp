#include "engine/pipeline/local_triangles.h"

#include <gtest/gtest.h>

#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

/// Of the triangles of each mesh of the scene; all of a mesh are alike.
std::vector<LightSides> sidesOf(const OpenProject& open, int workers) {
  TaskRunner runner(workers);
  const LocalTriangles local = localTrianglesOf(*open.rays, *open.drawn, *open.layout, runner);
  std::vector<LightSides> sides;
  const auto first = open.scene->firstTriangles();
  for (std::size_t m = 0; m < open.scene->meshes.size(); ++m) {
    sides.push_back(local.wanted[first[m]]);
    for (std::uint32_t t = first[m]; t < first[m + 1]; ++t)
      EXPECT_EQ(local.wanted[t], sides.back()) << "mesh " << m << ", triangle " << t - first[m];
  }
  return sides;
}

TEST(LocalTriangles, WantLightOnBacksThatAnEyeSees) {
  using enum LightSides;
  Project project = test::smallProject(1.2, 2);
  project.layout().nearBand = 1;
  glm::vec2 h(0);  // eyes are within so much of the middle
  const auto layout = buildLayout(project.layout());
  ASSERT_TRUE(layout);
  for (const Region& region : layout->regions)
    for (const glm::dvec2& corner : region.polygon.corners) h = glm::max(h, glm::vec2(glm::abs(corner)));
  test::SceneBuilder builder;
  const int paint = builder.material(test::matte());
  const auto wall = [&](float x0, float x1, float y) {  // faces -y
    builder.quad(paint, {x0, y, 0}, {x1, y, 0}, {x1, y, 2}, {x0, y, 2});
  };
  const glm::vec2 room = h + 0.7f;
  builder.box(paint, {-room, 0}, {room, 3}, true);          // seen from inside alone: six meshes
  builder.box(paint, {0.2f, 0.2f, 0}, {0.6f, 0.6f, 1.2f});  // a solid: six
  wall(-1, 1, -0.5f);
  wall(30, 31, 30);
  wall(1, -1, h.y + 0.3f);     // its back, through a gap beside the next
  wall(-1, 0.4f, h.y + 0.2f);  // nobody is behind it
  const OpenProject open = test::openWith(builder.rays(), project);
  std::vector<LightSides> expected(12, front);
  expected.insert(expected.end(), {both, none, both, front});
  EXPECT_EQ(sidesOf(open, 0), expected);
  EXPECT_EQ(sidesOf(open, 2), expected);
}

TEST(LocalTriangles, AreViewedFromTheFirstRegionThatDrawsThem) {
  test::SceneBuilder builder;
  builder.floor(builder.material(test::matte()), 4);
  const OpenProject open = test::openWith(builder.rays(), test::smallProject(1.2, 2));
  TaskRunner runner(2);
  const LocalTriangles local = localTrianglesOf(*open.rays, *open.drawn, *open.layout, runner);
  ASSERT_GT(open.layout->regions.size(), 1u);
  const glm::dvec2 first = open.layout->regions.front().polygon.centroid();
  for (const glm::vec3& viewer : local.viewer)
    EXPECT_EQ(viewer, glm::vec3(glm::dvec3(first, open.layout->eyeZ())));
}

}  // namespace
}  // namespace acentric
