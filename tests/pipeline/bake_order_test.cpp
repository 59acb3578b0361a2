#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/pipeline/pipeline.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

TEST(BakingOrder, BeginsWithAllThatTheFirstViewIsPaintedFromAndGoesOutwards) {
  test::SceneBuilder builder;
  builder.box(builder.material(test::matte()), {-8, -8, 0}, {8, 8, 3}, true);
  const OpenProject open = test::openWith(builder.rays(), test::smallProject(1.5, 2));
  const Layout& layout = *open.layout;
  for (const Region& home : layout.regions) {
    const glm::dvec2 from = home.polygon.centroid();
    const std::vector<int> order = bakingOrder(open, from);
    ASSERT_EQ(std::set<int>(order.begin(), order.end()).size(), layout.cameras.size()) << "each once";
    std::set<int> needed;
    for (const Cover& cover : home.covers)
      for (const Piece& piece : cover.pieces) needed.insert(piece.camera);
    const auto begin = order.begin() + std::ptrdiff_t(needed.size());
    EXPECT_EQ(std::set<int>(order.begin(), begin), needed);
    const auto away = [&](int camera) {
      return glm::distance(layout.cameras[std::size_t(camera)].position, from);
    };
    EXPECT_TRUE(std::is_sorted(order.begin(), begin, [&](int a, int b) { return away(a) < away(b); }));
    EXPECT_TRUE(std::is_sorted(begin, order.end(), [&](int a, int b) { return away(a) < away(b); }));
  }
  EXPECT_EQ(bakingOrder(open), bakingOrder(open, open.project.spawn().position));
  EXPECT_EQ(bakingOrder(open, {1e4, 0}).size(), layout.cameras.size()) << "from outside too";
}

}  // namespace
}  // namespace acentric
