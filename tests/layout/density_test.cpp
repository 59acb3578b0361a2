/// How densely regions are sampled, and the cameras that serve several of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/layout/lattice.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::kAllConfigurations;
using testing::HasSubstr;

LayoutSpec denseSpec(Configuration configuration) { return test::makeLayout(configuration).spec; }

class DensityOf : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, DensityOf, testing::ValuesIn(kAllConfigurations),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

/// By its definition: the most of what the placed regions ask for that the camera has a role of.
double mostAround(const Layout& layout, const LayoutCamera& camera) {
  double most = 0;
  for (const Role& role : camera.roles)
    if (layout.findRegion(role.region)) most = std::max(most, densityOf(layout.spec, role.region));
  return most;
}

TEST_P(DensityOf, ACameraHasTheMostOfTheRegionsThatItServes) {
  LayoutSpec spec = denseSpec(GetParam());
  const auto usual = buildLayout(spec);
  for (const LayoutCamera& camera : usual->cameras) EXPECT_EQ(camera.density, 1);
  const CellId denser = cellAt(spec, {0.1, 0.1}).id;
  for (const Region& region : usual->regions)
    if (region.id != denser) spec.density[region.id] = 0.5;
  spec.density[denser] = 2;
  const auto layout = buildLayout(spec);
  ASSERT_TRUE(layout) << layout.error().describe();
  std::size_t fine = 0, coarse = 0;
  for (const LayoutCamera& camera : layout->cameras) {
    EXPECT_EQ(camera.density, mostAround(*layout, camera));
    fine += camera.density == 2 ? 1 : 0;
    coarse += camera.density == 0.5 ? 1 : 0;
  }
  EXPECT_EQ(fine + coarse, layout->cameras.size());
  EXPECT_GT(fine, 2u);
  EXPECT_GT(coarse, 2u);
}

TEST_P(DensityOf, ARegionThatIsNotPlacedAsksForNothing) {
  LayoutSpec spec = denseSpec(GetParam());
  const CellId middle = cellAt(spec, {0.1, 0.1}).id;
  spec.removed = {middle};
  spec.density[middle] = 4;
  const auto layout = buildLayout(spec);
  ASSERT_TRUE(layout) << layout.error().describe();
  for (const LayoutCamera& camera : layout->cameras) EXPECT_EQ(camera.density, 1);
}

TEST(Density, PartsHaveThatOfTheWholeUnlessTheyAreNamed) {
  LayoutSpec spec = denseSpec(Configuration::e);
  const CellId whole = cellAt(spec, {0.1, 0.1}).id;
  const auto parts = partsOf(spec, whole);
  spec.split = {whole};
  spec.density = {{whole, 2}, {parts[1], 1}, {parts[2], 0.25}};
  EXPECT_EQ(densityOf(spec, whole), 2);
  EXPECT_EQ(densityOf(spec, parts[0]), 2);
  EXPECT_EQ(densityOf(spec, parts[1]), 1);
  EXPECT_EQ(densityOf(spec, parts[2]), 0.25);
  EXPECT_EQ(densityOf(spec, partsOf(spec, parts[0])[3]), 2);
}

TEST(Density, FreeApvsHaveTheirOwn) {
  LayoutSpec spec = denseSpec(Configuration::b);
  spec.freeApvs = {{4, {{0.5, 0.5}, {0.4, 0}, 60, Hand::counterClockwise}}};
  spec.density[{4, 0, kFreeSlot}] = 2;
  const auto layout = buildLayout(spec);
  ASSERT_TRUE(layout) << layout.error().describe();
  for (const LayoutCamera& camera : layout->cameras)
    EXPECT_EQ(camera.density, camera.id.corner == kFreeCorner ? 2 : 1);
}

TEST(Density, AnotherLatticeForgetsIt) {
  LayoutSpec spec = denseSpec(Configuration::e);
  spec.freeApvs = {{4, {{0.5, 0.5}, {0.4, 0}, 60, Hand::counterClockwise}}};
  const CellId cell = cellAt(spec, {0.1, 0.1}).id, apv{4, 0, kFreeSlot};
  spec.added = {{30, 30, 0}}, spec.removed = {{1, 1, 0}}, spec.split = {cell};
  spec.density = {{cell, 2}, {apv, 3}};
  spec.forgetCells();
  EXPECT_TRUE(spec.added.empty() && spec.removed.empty() && spec.split.empty());
  EXPECT_EQ(spec.density, (std::map<CellId, double>{{apv, 3}}));
}

TEST(Density, IsPartOfTheHashAndIsChecked) {
  LayoutSpec spec = denseSpec(Configuration::b);
  const auto hashOf = [](const LayoutSpec& of) {
    Hasher hasher;
    of.addTo(hasher);
    return hasher.finish();
  };
  LayoutSpec other = spec;
  other.density[cellAt(spec, {0, 0}).id] = 2;
  EXPECT_NE(hashOf(spec), hashOf(other));
  EXPECT_TRUE(other.check());
  struct Case {
    CellId cell;
    double density;
    const char* said;
  };
  const CellId cell = cellAt(spec, {0, 0}).id;
  for (const Case& c : {Case{cell, 0.2, "density"}, Case{cell, 4.1, "density"},
                        Case{cell, std::numeric_limits<double>::quiet_NaN(), "density"},
                        Case{{0, 0, 99}, 2, "does not exist"}, Case{{0, 0, 0, 1}, 2, "does not exist"},
                        Case{{3, 0, kFreeSlot}, 2, "free APV 3"}}) {
    other.density = {{c.cell, c.density}};
    const Status status = other.check();
    ASSERT_FALSE(status) << c.density;
    EXPECT_THAT(status.error().message, HasSubstr(c.said));
  }
}

}  // namespace
}  // namespace acentric
