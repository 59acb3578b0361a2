#include "engine/inspect/refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "engine/layout/lattice.h"
#include "engine/scene/local_geometry.h"
#include "tests/layout/layout_fixtures.h"
#include "tests/support/print_configuration.h"

namespace acentric {
namespace {
using test::Random;
using testing::HasSubstr;

void addSpeck(Mesh& mesh, const glm::dvec2& at) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::vec3 corner(at, 1);
  for (const glm::vec3& aside : {glm::vec3(0), glm::vec3(1e-3f, 0, 0), glm::vec3(0, 1e-3f, 0)})
    mesh.positions.push_back(corner + aside);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Specks everywhere, with three crowds of different widths.
ScenePtr crowdedScene() {
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  Random random(61);
  for (int n = 0; n < 4000; ++n) addSpeck(scene->meshes[0], {random(-6, 6), random(-6, 6)});
  const glm::dvec2 middles[] = {{0.3, 0.4}, {-2.6, 1.7}, {3.1, -2.2}};
  const double widths[] = {0.05, 0.5, 1.5};
  for (int crowd = 0; crowd < 3; ++crowd)
    for (int n = 0; n < 1500; ++n)
      addSpeck(scene->meshes[0], middles[crowd] + widths[crowd] * glm::dvec2(random(-1, 1), random(-1, 1)));
  return scene;
}

LayoutSpec roomSpec(Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 2;
  spec.nearBand = 0.2;
  spec.latticeOrigin = {0.3, -0.7};
  spec.rotationRadians = 0.37;
  spec.outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  return spec;
}

/// The slow obvious way: recounts each part by clipping, and looks at every depth before it decides.
class SlowRefiner {
 public:
  SlowRefiner(const LayoutSpec& spec, const Scene& scene, const RefineOptions& options)
      : spec_(spec), lattice_(*Lattice::of(spec)), scene_(scene), options_(options) {}

  LayoutSpec refined() {
    LayoutSpec spec = spec_;
    const Layout layout = buildLayout(spec_).value();
    for (const Region& region : layout.regions)
      if (region.id.slot != kFreeSlot) refine(region.id, spec.split);
    return spec;
  }
  std::size_t count(const CellId& id) const {
    return clipToPolygon(scene_, lattice_.polygonOf(id).grown(spec_.nearBand)).triangles.size();
  }

 private:
  /// Adds the splits of `id` that help; returns the worst region below it.
  std::size_t refine(const CellId& id, std::set<CellId>& splits) {
    const std::size_t whole = count(id);
    const double part = spec_.cellSize / double(2 << id.level);
    if (whole <= options_.mostTriangles || id.level == kMaxLevel || part < options_.leastCell) return whole;
    LayoutSpec alone = spec_;  // which parts would be placed
    for (CellId up = id;; up = lattice_.parentOf(up)) {
      alone.split.insert(up);
      if (up.level == 0) break;
    }
    std::set<CellId> below{id};
    std::size_t worst = 0;
    const Layout parts = buildLayout(alone).value();
    for (const Region& region : parts.regions)
      if (region.id.level == id.level + 1 && lattice_.parentOf(region.id) == id)
        worst = std::max(worst, refine(region.id, below));
    if (worst > options_.mostTriangles && double(worst) >= double(whole) * (1 - options_.leastGain))
      return whole;
    splits.insert(below.begin(), below.end());
    return worst;
  }

  LayoutSpec spec_;
  Lattice lattice_;
  const Scene& scene_;
  const RefineOptions& options_;
};

class RefineOf : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, RefineOf, testing::Values(Configuration::e, Configuration::g),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

TEST_P(RefineOf, SplitsWhatTheSlowObviousWaySplits) {
  const ScenePtr scene = crowdedScene();
  const TriangleTree tree(scene);
  TaskRunner runner(1);
  for (const std::size_t most : {40u, 120u, 400u, 900u, 1200u, 1400u, 1510u, 100'000u}) {
    LayoutSpec spec = roomSpec(GetParam());
    const CellId removed = cellAt(spec, {-3, -3}).id, added = cellAt(spec, {5, 5}).id;
    spec.removed = {removed};
    spec.added = {added};
    spec.split = {cellAt(spec, {2, 2}).id};
    RefineOptions options;
    options.mostTriangles = most;
    const RefineResult refined = refineToBudget(spec, tree, options, runner).value();
    LayoutSpec expected = spec;
    expected.split = SlowRefiner(spec, *scene, options).refined().split;
    EXPECT_EQ(refined.spec, expected) << most;
    EXPECT_EQ(refined.split, refined.spec.split.size() - spec.split.size());

    const Layout before = buildLayout(spec).value(), after = buildLayout(refined.spec).value();
    EXPECT_EQ(refined.regionsBefore, before.regions.size());
    EXPECT_EQ(refined.budgets.triangles, countLocalTriangles(*scene, after));
    EXPECT_FALSE(after.findRegion(removed));
    RegionBudgets counts;
    counts.triangles = countLocalTriangles(*scene, before);
    EXPECT_EQ(refined.worstBefore, counts.worst());
    EXPECT_EQ(refined.overBefore, counts.over(most).size());
    std::vector<int> over;
    for (const auto& entry : refined.over) over.push_back(entry.region);
    EXPECT_EQ(over, refined.budgets.over(most));
    std::vector<std::size_t> perLevel(refined.regionsPerLevel.size());
    for (const Region& region : after.regions) ++perLevel.at(std::size_t(region.id.level));
    EXPECT_EQ(refined.regionsPerLevel, perLevel);
    EXPECT_EQ(most == 100'000u, refined.split == 0);
  }
}

TEST_P(RefineOf, CountsEachRegionOnce) {
  const TriangleTree tree(crowdedScene());
  TaskRunner runner(0);
  RefineOptions options;
  options.mostTriangles = 400;
  const LayoutSpec spec = roomSpec(GetParam());
  const RefineResult refined = refineToBudget(spec, tree, options, runner).value();
  // Parts are four to a split, those that were taken back too: never as many as recounting rounds would take.
  EXPECT_GE(refined.budgets.counted, refined.regionsBefore + refined.split);
  RefineOptions nothing = options;
  nothing.leastCell = 2;
  EXPECT_EQ(refineToBudget(spec, tree, nothing, runner)->budgets.counted, refined.regionsBefore);
  const RefineResult again = refineToBudget(refined.spec, tree, nothing, runner).value();
  EXPECT_EQ(again.budgets.counted, buildLayout(refined.spec)->regions.size());
  EXPECT_EQ(again.spec, refined.spec) << "nothing is left to do";
}

TEST_P(RefineOf, KeepsCoversAndOrderExact) {
  const TriangleTree tree(crowdedScene());
  TaskRunner runner(0);
  RefineOptions options;
  options.mostTriangles = 350;
  const Layout layout =
      buildLayout(refineToBudget(roomSpec(GetParam()), tree, options, runner)->spec).value();
  std::set<int> levels;
  for (const Region& region : layout.regions) levels.insert(region.id.level);
  ASSERT_GE(levels.size(), 3u);
  Random random(62);
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec2 p(random(-3.9, 3.9), random(-3.9, 3.9));
    const auto region = layout.regionAt(p);
    ASSERT_TRUE(region);
    ASSERT_TRUE(layout.regions[std::size_t(*region)].polygon.contains(p));
    ASSERT_EQ(std::ranges::count_if(layout.regions, [&](const Region& r) { return r.polygon.contains(p); }),
              1);
  }
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    for (const Cover& cover : region.covers)
      for (int n = 0; n < 20; ++n) {
        const glm::dvec2 p(random(-30, 30), random(-30, 30));
        if (!region.polygon.containsClosed(p)) {
          ASSERT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& q) { return q.holds(p); }), 1);
        }
        const ViewSector sector{random.within(region.polygon), {random(0, kTwoPi), random(0.1, 3.1)}};
        std::vector<int> painted;
        for (const OrderedPiece& piece : visiblePieces(layout, static_cast<int>(r), cover, sector))
          painted.push_back(piece.camera);
        const double azimuth = sector.azimuths.low + sector.azimuths.width * random(1e-6, 1 - 1e-6);
        auto expected = test::crossedAlongRay(region, cover, sector.eye, directionOf(azimuth), 1e-9);
        std::ranges::reverse(expected);
        std::erase_if(painted, [&](int c) { return std::ranges::find(expected, c) == expected.end(); });
        ASSERT_EQ(painted, expected);
      }
  }
}

TEST_P(RefineOf, MergesWhatTheBudgetDoesNotCallForAndNothingSetByHand) {
  const TriangleTree tree(crowdedScene());
  TaskRunner runner(0);
  const LayoutSpec spec = roomSpec(GetParam());
  const Lattice lattice = *Lattice::of(spec);
  RefineOptions options;
  options.mostTriangles = 350;
  options.merge = true;
  const RefineResult plain = refineToBudget(spec, tree, options, runner).value();
  EXPECT_EQ(plain.merged, 0u);

  LayoutSpec finer = plain.spec;  // split what keeps to the budget, two levels deep
  const CellId sparse = cellAt(spec, {-3, -3}).id, byHand = cellAt(spec, {3, 3}).id;
  ASSERT_FALSE(finer.split.contains(sparse) || finer.split.contains(byHand));
  finer.split.insert({sparse, lattice.childrenOf(sparse)[1], byHand});
  finer.removed.insert(lattice.childrenOf(byHand)[0]);
  const RefineResult merged = refineToBudget(finer, tree, options, runner).value();
  EXPECT_EQ(merged.merged, 2u);
  LayoutSpec expected = plain.spec;
  expected.split.insert(byHand);
  expected.removed = finer.removed;
  EXPECT_EQ(merged.spec, expected);
  options.merge = false;
  EXPECT_EQ(refineToBudget(finer, tree, options, runner)->spec, finer);
}

TEST_P(RefineOf, TakesSplitsBackThatDoNotHelpAndSaysSo) {
  // All within a thousandth of a metre: whoever stands nearest has them all.
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  Random random(63);
  for (int n = 0; n < 500; ++n) addSpeck(scene->meshes[0], {random(0, 1e-3), random(0, 1e-3)});
  const TriangleTree tree{scene};
  TaskRunner runner(0);
  RefineOptions options;
  options.mostTriangles = 100;
  LayoutSpec spec = roomSpec(GetParam());
  spec.freeApvs[3] = {{0, 0}, {0.8, 0}, 60, Hand::counterClockwise};
  const RefineResult refined = refineToBudget(spec, tree, options, runner).value();
  EXPECT_EQ(refined.spec, spec);
  EXPECT_FALSE(refined.satisfied());
  const Layout layout = buildLayout(spec).value();
  for (const auto& over : refined.over)
    EXPECT_EQ(over.why, layout.regions[std::size_t(over.region)].id.slot == kFreeSlot
                            ? WhyOver::freeApv
                            : WhyOver::splitsNoHelp);
  EXPECT_GE(refined.over.size(), 2u);
}

TEST(Refine, StopsAtTheSmallestCellsAllowed) {
  auto scene = std::make_shared<Scene>();
  scene->meshes.resize(1);
  Random random(64);
  for (int n = 0; n < 20000; ++n) addSpeck(scene->meshes[0], {random(-6, 6), random(-6, 6)});
  const TriangleTree tree{scene};
  TaskRunner runner(0);
  RefineOptions options;
  options.mostTriangles = 1;
  options.leastCell = 0.5;
  const RefineResult refined = refineToBudget(roomSpec(Configuration::e), tree, options, runner).value();
  EXPECT_EQ(refined.regionsPerLevel.size(), 3u);
  EXPECT_EQ(refined.regionsPerLevel[0] + refined.regionsPerLevel[1], 0u);
  EXPECT_EQ(refined.over.size(), refined.regionsPerLevel[2]);
  for (const auto& over : refined.over) EXPECT_EQ(over.why, WhyOver::smallest);
}

TEST(Refine, RefusesWhatCannotBeSplitAndStopsWhenAsked) {
  const TriangleTree tree(crowdedScene());
  TaskRunner runner(0);
  for (const Configuration configuration : test::kAllConfigurations) {
    const auto refined = refineToBudget(roomSpec(configuration), tree, {}, runner);
    EXPECT_EQ(refined.has_value(), canSplit(configuration));
    if (!refined) {
      EXPECT_THAT(refined.error().message, HasSubstr("only those of e (squares) and g (triangles)"));
    }
  }
  const LayoutSpec spec = roomSpec(Configuration::e);
  for (const auto& spoil : std::vector<void (*)(RefineOptions&)>{
           [](RefineOptions& o) { o.mostTriangles = 0; }, [](RefineOptions& o) { o.leastCell = 0; },
           [](RefineOptions& o) { o.leastCell = 2 * kLargestCellSize; },
           [](RefineOptions& o) { o.leastGain = std::nan(""); }}) {
    RefineOptions options;
    spoil(options);
    const auto refused = refineToBudget(spec, tree, options, runner);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
  }
  std::stop_source source;
  source.request_stop();
  const auto stopped = refineToBudget(spec, tree, {}, runner, {}, source.get_token());
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace acentric
