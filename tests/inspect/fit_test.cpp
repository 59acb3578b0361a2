#include "engine/inspect/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

void addSpeck(Mesh& mesh, const glm::vec3& at, float size = 1e-3f) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& aside : {glm::vec3(0), glm::vec3(size, 0, 0), glm::vec3(0, size, 0)})
    mesh.positions.push_back(at + aside);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// One speck of a triangle every `step` metres over [-reach, reach]^2: counts follow areas.
ScenePtr evenScene(double reach, double step) {
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  for (double y = -reach; y <= reach; y += step)
    for (double x = -reach; x <= reach; x += step) addSpeck(scene->meshes[0], {x, y, 1});
  return scene;
}

LayoutSpec roomSpec(Configuration configuration, double half, double nearBand) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.nearBand = nearBand;
  spec.outline.loops = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  return spec;
}

/// Squares grown by 0.5 m over an even density of 25 specks per square metre: (s + 1)^2 * 25 each.
TEST(Fit, FindsTheSizeThatAnEvenDensityCallsFor) {
  const auto scene = evenScene(9, 0.2);
  const TriangleTree tree(scene);
  TaskRunner runner(1);
  FitOptions options;
  options.mostTriangles = 400;  // s = 3: (3 + 1)^2 * 25
  options.leastCell = 0.5;
  const auto fitted = fitToBudget(roomSpec(Configuration::e, 4, 0.5), tree, options, runner);
  ASSERT_TRUE(fitted.has_value()) << fitted.error().describe();
  EXPECT_TRUE(fitted->satisfied);
  EXPECT_TRUE(fitted->over.empty());
  EXPECT_NEAR(fitted->spec.cellSize, 3, 0.25) << "specks on a grid: a row more or less";
  EXPECT_LE(fitted->budgets.worst(), options.mostTriangles);
}

TEST(Fit, NoLargerSizeThatItTriedFits) {
  std::mt19937 engine(5);
  std::normal_distribution<float> place(0, 1.5f);
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  for (int n = 0; n < 20000; ++n) addSpeck(scene->meshes[0], {place(engine), place(engine), 0}, 0.05f);
  const TriangleTree tree(scene);
  TaskRunner runner(1);
  for (const Configuration configuration : {Configuration::b, Configuration::e}) {
    FitOptions options;
    options.mostTriangles = 9000;
    options.rotations = 2;
    const auto fitted = fitToBudget(roomSpec(configuration, 4, 0.5), tree, options, runner);
    ASSERT_TRUE(fitted.has_value());
    ASSERT_TRUE(fitted->satisfied);
    bool finer = false;
    for (const FitPoint& point : fitted->curve) {
      EXPECT_EQ(point.over == 0, point.worst <= options.mostTriangles);
      EXPECT_TRUE(point.cellSize <= fitted->spec.cellSize || point.over > 0) << point.cellSize;
      finer =
          finer || (point.cellSize > fitted->spec.cellSize && point.cellSize < fitted->spec.cellSize * 1.02);
    }
    EXPECT_TRUE(finer) << "a size one per cent larger was tried";
    EXPECT_TRUE(std::ranges::is_sorted(fitted->curve, std::greater{}, &FitPoint::cellSize));
    // The counts are those of clipping.
    const Layout layout = buildLayout(fitted->spec).value();
    ASSERT_EQ(fitted->budgets.triangles.size(), layout.regions.size());
    for (std::size_t r = 0; r < layout.regions.size(); r += 7)
      EXPECT_EQ(fitted->budgets.triangles[r],
                clipToPolygon(*scene, layout.regions[r].grown).triangles.size());
  }
}

TEST(Fit, SaysWhichRegionsStillExceedWhereNothingFits) {
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  for (int n = 0; n < 500; ++n)
    addSpeck(scene->meshes[0], {0.001f * float(n % 20), 0.001f * float(n / 20), 1});
  const TriangleTree tree(scene);
  TaskRunner runner(0);
  FitOptions options;
  options.mostTriangles = 100;
  const auto fitted = fitToBudget(roomSpec(Configuration::e, 3, 0.4), tree, options, runner);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_FALSE(fitted->satisfied);
  ASSERT_FALSE(fitted->over.empty());
  EXPECT_EQ(fitted->budgets.worst(), std::ranges::min_element(fitted->curve, {}, &FitPoint::worst)->worst);
  for (const int r : fitted->over)
    EXPECT_GT(fitted->budgets.triangles[std::size_t(r)], options.mostTriangles);
  EXPECT_EQ(fitted->curve.size(), std::size_t(options.sizes));
  EXPECT_DOUBLE_EQ(fitted->curve.back().cellSize, options.leastCell);
}

TEST(Fit, MorePlacementsNeverMakeASizeWorse) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<float> along(-4, 4), across(-0.2f, 0.2f);
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  for (int n = 0; n < 5000; ++n) {  // a wall at 20 degrees to the axes
    const float a = along(engine), c = across(engine);
    addSpeck(scene->meshes[0], {0.94f * a - 0.34f * c, 0.34f * a + 0.94f * c, 1});
  }
  const TriangleTree tree(scene);
  TaskRunner runner(1);
  FitOptions options;
  options.mostTriangles = 1;
  options.sizes = 6;
  options.leastCell = 0.5;
  const auto plain = fitToBudget(roomSpec(Configuration::e, 3, 0.3), tree, options, runner).value();
  options.rotations = 4, options.origins = 2;
  const auto placed = fitToBudget(roomSpec(Configuration::e, 3, 0.3), tree, options, runner).value();
  ASSERT_EQ(plain.curve.size(), placed.curve.size());
  bool better = false;
  for (std::size_t n = 0; n < plain.curve.size(); ++n) {
    EXPECT_LE(placed.curve[n].worst, plain.curve[n].worst);
    better = better || placed.curve[n].worst < plain.curve[n].worst;
  }
  EXPECT_TRUE(better);
}

TEST(Fit, StopsWhenAskedAndRefusesWhatCannotBe) {
  const TriangleTree tree(evenScene(2, 0.5));
  TaskRunner runner(0);
  const LayoutSpec spec = roomSpec(Configuration::b, 2, 0.5);
  std::stop_source source;
  double last = 0;
  const auto stopped = fitToBudget(
      spec, tree, {}, runner,
      [&](const ProgressState& state) {
        EXPECT_GT(state.done, last);
        last = state.done;
        if (state.done > 3) source.request_stop();
      },
      source.get_token());
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);

  LayoutSpec nowhere = spec;
  nowhere.outline.loops.clear();
  EXPECT_FALSE(fitToBudget(nowhere, tree, {}, runner).has_value());
  for (const auto& spoil : std::vector<void (*)(FitOptions&)>{
           [](FitOptions& o) { o.mostTriangles = 0; }, [](FitOptions& o) { o.leastCell = 0; },
           [](FitOptions& o) { o.largestCell = 0.1; }, [](FitOptions& o) { o.sizes = 1; },
           [](FitOptions& o) { o.rotations = 0; }, [](FitOptions& o) { o.origins = 99; }}) {
    FitOptions options;
    spoil(options);
    const auto refused = fitToBudget(spec, tree, options, runner);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
  }
}

TEST(Fit, EndsTheLadderWhereCellsBecomeTooMany) {
  const TriangleTree tree(evenScene(2, 0.5));
  TaskRunner runner(0);
  FitOptions options;
  options.mostTriangles = 1;
  options.leastCell = 0.05;
  options.sizes = 8;
  const auto fitted = fitToBudget(roomSpec(Configuration::e, 40, 0.3), tree, options, runner);
  ASSERT_TRUE(fitted.has_value()) << fitted.error().describe();
  EXPECT_GT(fitted->leastTried, options.leastCell);
  EXPECT_LT(fitted->curve.size(), 8u);
}

TEST(Fit, LeavesOutCellsChosenOneByOne) {
  const TriangleTree tree(evenScene(2, 0.5));
  TaskRunner runner(0);
  LayoutSpec spec = roomSpec(Configuration::e, 2, 0.3);
  spec.cellSize = 1;
  spec.added = {{5, 5, 0}};
  spec.removed = {{0, 0, 0}, {1, 0, 0}};
  const auto fitted = fitToBudget(spec, tree, {}, runner);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_EQ(fitted->droppedEdits, 3u);
  EXPECT_TRUE(fitted->spec.added.empty() && fitted->spec.removed.empty());
}

TEST(Fit, TriesCellsOfAnySizeThatALayoutMayHave) {
  // The same room drawn a thousand times smaller: the same answer, a thousand times smaller.
  TaskRunner runner(0);
  std::vector<double> found;
  for (const double scale : {1.0, 1e-3}) {
    auto scene = std::make_shared<Scene>();
    scene->meshes.resize(1);
    for (int y = -40; y <= 40; ++y)
      for (int x = -40; x <= 40; ++x)
        addSpeck(scene->meshes[0], glm::vec3(0.1 * scale * glm::dvec3(x, y, 10)), float(1e-3 * scale));
    const TriangleTree tree{scene};
    FitOptions options;
    options.mostTriangles = 400;
    options.leastCell = 0.5 * scale;
    const auto fitted =
        fitToBudget(roomSpec(Configuration::e, 2 * scale, 0.2 * scale), tree, options, runner);
    ASSERT_TRUE(fitted.has_value()) << fitted.error().describe();
    ASSERT_TRUE(fitted->satisfied);
    found.push_back(fitted->spec.cellSize / scale);
  }
  EXPECT_NEAR(found[1], found[0], 0.01 * found[0]);
}

}  // namespace
}  // namespace acentric
