#include "engine/inspect/budgets.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/inspect/triangle_grid.h"

namespace acentric {
namespace {

Layout layoutOver(double low, double high, Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 1;
  spec.nearBand = 0.4;
  spec.outline.loops = {{{low, low}, {high, low}, {high, high}, {low, high}}};
  return buildLayout(spec).value();
}

Scene randomScene(int triangles, double reach, double size) {
  std::mt19937 engine(3);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  Scene scene;
  scene.meshes.resize(2);
  for (int t = 0; t < triangles; ++t) {
    Mesh& mesh = scene.meshes[std::size_t(t % 2)];
    const glm::dvec3 at{random(-reach, reach), random(-reach, reach), random(0, 2)};
    const double s = t % 50 == 0 ? 4 * reach : size;  // some span the whole layout
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k)
      mesh.positions.emplace_back(at + glm::dvec3(random(-s, s), random(-s, s), random(-s, s)));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return scene;
}

TEST(Budgets, CountWhatClippingEachRegionGives) {
  const Scene scene = randomScene(4000, 8, 0.5);
  for (const Configuration configuration : {Configuration::b, Configuration::e}) {
    const Layout layout = layoutOver(-3, 3, configuration);
    const std::vector<std::size_t> counts = countLocalTriangles(scene, layout);
    ASSERT_EQ(counts.size(), layout.regions.size());
    for (std::size_t r = 0; r < counts.size(); ++r) {
      EXPECT_EQ(counts[r], clipToPolygon(scene, layout.regions[r].grown).triangles.size());
      EXPECT_GT(counts[r], 0u);
    }
  }
}

TEST(Budgets, AreZeroWhereThereIsNothing) {
  EXPECT_TRUE(countLocalTriangles(randomScene(10, 1, 1), Layout{}).empty());
  for (const std::size_t count : countLocalTriangles(Scene{}, layoutOver(-2, 2, Configuration::b)))
    EXPECT_EQ(count, 0u);
}

TEST(TriangleGrid, FindsExactlyTheTrianglesWhoseBoxesTouch) {
  const Scene scene = randomScene(3000, 6, 0.3);
  PlanBounds area;
  area.add({-4, -4}), area.add({4, 4});
  TriangleGrid grid(scene, area, 0.5);
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> place(-4, 4), width(0, 2);
  for (int n = 0; n < 200; ++n) {
    PlanBounds box;
    const glm::dvec2 low{place(engine), place(engine)};
    box.add(low), box.add(glm::min(low + glm::dvec2(width(engine), width(engine)), glm::dvec2(4)));
    std::size_t expected = 0;
    for (const Mesh& mesh : scene.meshes)
      for (const glm::uvec3& t : mesh.triangles) {
        PlanBounds bounds;
        for (int k = 0; k < 3; ++k) bounds.add(glm::dvec2(mesh.positions[t[k]]));
        expected += bounds.touches(box) ? 1 : 0;
      }
    EXPECT_EQ(grid.near(box).size(), expected);
  }
}

}  // namespace
}  // namespace acentric
