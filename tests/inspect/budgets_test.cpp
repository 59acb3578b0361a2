#include "engine/inspect/budgets.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"

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

TEST(Budgets, CountInstancesAsIfTheyWereMeshes) {
  Scene scene = randomScene(300, 8, 0.5);
  scene.prototypes = randomScene(400, 1, 0.2).meshes;
  std::mt19937 engine(11);
  const auto random = [&](float reach) {
    return std::uniform_real_distribution<float>(-reach, reach)(engine);
  };
  for (std::uint32_t n = 0; n < 60; ++n) {
    glm::mat4x3 place;
    for (int column = 0; column < 3; ++column)
      place[column] = glm::vec3(random(1), random(1), random(1)), place[column][column] += 1.5f;
    if (n % 5 == 0) place[0] = -place[0];
    place[3] = {random(7), random(7), random(1)};
    scene.instances.push_back({n % 2, place});
  }
  const Scene flat = flattened(scene);
  ASSERT_EQ(flat.triangleCount(), scene.shownTriangleCount());
  const Layout layout = layoutOver(-3, 3, Configuration::b);
  const std::vector<std::size_t> counts = countLocalTriangles(scene, layout);
  for (std::size_t r = 0; r < counts.size(); ++r)
    EXPECT_EQ(counts[r], clipToPolygon(flat, layout.regions[r].grown).triangles.size());
}

TEST(Budgets, AreZeroWhereThereIsNothing) {
  EXPECT_TRUE(countLocalTriangles(randomScene(10, 1, 1), Layout{}).empty());
  for (const std::size_t count : countLocalTriangles(Scene{}, layoutOver(-2, 2, Configuration::b)))
    EXPECT_EQ(count, 0u);
}

/// Triangles with corners on a coarse grid and polygons with corners on the same: borders are met exactly.
TEST(TriangleTree, CountsWhatClippingGivesWhereCornersLieOnBorders) {
  std::mt19937 engine(9);
  std::uniform_int_distribution<int> place(-4, 4), height(0, 1);
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  Mesh& mesh = scene->meshes.front();
  for (std::uint32_t n = 0; n < 3 * 700; ++n)
    mesh.positions.emplace_back(place(engine), place(engine), height(engine));
  for (std::uint32_t t = 0; t < 700; ++t) mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  const TriangleTree tree(scene);
  std::size_t positive = 0;
  for (int n = 0; n < 300; ++n) {
    const glm::dvec2 low(place(engine), place(engine));
    const double w = 1 + height(engine), h = 1 + height(engine);
    ConvexPolygon polygon{{low, low + glm::dvec2(w, 0), low + glm::dvec2(w, h), low + glm::dvec2(0, h)}};
    if (n % 3 == 0) polygon = {{low, low + glm::dvec2(2, 1), low + glm::dvec2(1, 3)}};
    const std::size_t expected = clipToPolygon(*scene, polygon).triangles.size();
    EXPECT_EQ(tree.countClipped(polygon), expected);
    positive += expected;
  }
  EXPECT_GT(positive, 1000u);
}

TEST(TriangleTree, CountsNothingInAPolygonWithoutArea) {
  const auto scene = std::make_shared<const Scene>(randomScene(50, 1, 1));
  EXPECT_EQ(TriangleTree(scene).countClipped({}), 0u);
  EXPECT_EQ(TriangleTree(std::make_shared<const Scene>()).countClipped({{{0, 0}, {1, 0}, {0, 1}}}), 0u);
}

TEST(BudgetCounter, CountsOnlyWhatAnEditChanged) {
  const auto scene = std::make_shared<const Scene>(randomScene(2000, 6, 0.4));
  TaskRunner runner(2);
  BudgetCounter counter(scene);
  Layout layout = layoutOver(-3, 3, Configuration::b);
  const RegionBudgets first = counter.count(layout, runner).value();
  EXPECT_EQ(first.counted, layout.regions.size());
  EXPECT_EQ(first.triangles, countLocalTriangles(*scene, layout));
  EXPECT_EQ(counter.count(layout, runner).value().counted, 0u);

  LayoutSpec moved = layout.spec;
  moved.removed.insert(layout.regions.front().id);
  moved.added.insert(cellAt(layout.spec, {6, 0}).id);
  const Layout after = buildLayout(moved).value();
  const RegionBudgets second = counter.count(after, runner).value();
  EXPECT_GE(second.counted, 1u);
  EXPECT_LE(second.counted, 8u);
  EXPECT_EQ(second.triangles, countLocalTriangles(*scene, after));
  EXPECT_EQ(counter.count(layout, runner).value().counted, 0u) << "undoing the edit is free";
}

TEST(BudgetCounter, ForgetsPolygonsThatManyLayoutsAgoWereTheLast) {
  const auto scene = std::make_shared<const Scene>(randomScene(50, 6, 0.4));
  TaskRunner runner(0);
  BudgetCounter counter(scene);
  const Layout layout = layoutOver(-1, 1, Configuration::e);
  const std::size_t all = counter.count(layout, runner).value().counted;
  LayoutSpec spec = layoutOver(-20, 20, Configuration::e).spec;
  for (int step = 0; step < 8; ++step) {
    spec.latticeOrigin.x += 0.01;
    ASSERT_TRUE(counter.count(buildLayout(spec).value(), runner).has_value());
  }
  EXPECT_EQ(counter.count(layout, runner).value().counted, all);
}

TEST(BudgetCounter, StopsWhenAskedAndGoesOnFromThere) {
  const auto scene = std::make_shared<const Scene>(randomScene(500, 6, 0.4));
  const Layout layout = layoutOver(-3, 3, Configuration::b);
  TaskRunner runner(0);
  BudgetCounter counter(scene);
  std::stop_source source;
  double reported = 0;
  const auto cancelled = counter.count(
      layout, runner,
      [&](const ProgressState& state) {
        reported = state.done;
        EXPECT_EQ(state.total, double(layout.regions.size()));
        if (state.done >= 3) source.request_stop();
      },
      source.get_token());
  ASSERT_FALSE(cancelled.has_value());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(reported, 3);
  const RegionBudgets rest = counter.count(layout, runner).value();
  EXPECT_EQ(rest.counted, layout.regions.size() - 3);
  EXPECT_EQ(rest.triangles, countLocalTriangles(*scene, layout));
}

TEST(RegionBudgets, NameTheWorstFirst) {
  const RegionBudgets budgets{{5, 9, 1, 7}, 4};
  EXPECT_EQ(budgets.worst(), 9u);
  EXPECT_EQ(budgets.median(), 5u);
  EXPECT_EQ(budgets.over(4), (std::vector<int>{1, 3, 0}));
  EXPECT_TRUE(budgets.over(9).empty());
  EXPECT_EQ(RegionBudgets{}.worst(), 0u);
  EXPECT_EQ(RegionBudgets{}.median(), 0u);
}

}  // namespace
}  // namespace acentric
