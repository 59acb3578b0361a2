#include "editor/session/region_table.h"

#include <gtest/gtest.h>

#include <numeric>

#include "editor/session/configuration_facts.h"
#include "engine/geometry/conventions.h"

namespace acentric::editor {
namespace {

std::shared_ptr<const Layout> smallLayout() {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  return std::make_shared<const Layout>(*buildLayout(spec));
}

CapturesOnDisk nothingOnDisk(const Layout& layout) {
  const std::size_t n = layout.cameras.size();
  return {std::vector<bool>(n, false), std::vector<bool>(n, false), std::vector<std::uint64_t>(n, 0)};
}

TEST(RegionTable, RowsHoldWhatIsKnownAndNothingElse) {
  const auto layout = smallLayout();
  CapturesOnDisk there = nothingOnDisk(*layout);
  const std::vector<int> cameras = camerasOf(layout->regions[1]);
  for (const int c : cameras) there.baked[std::size_t(c)] = true, there.bytes[std::size_t(c)] = 100;
  const CaptureStatus status = captureStatus(*layout, there);
  const auto rows = regionRows(*layout, &status, status.regions, nullptr, nullptr);
  ASSERT_EQ(rows.size(), layout->regions.size());
  EXPECT_EQ(rows[1].bytes, 100 * cameras.size());
  EXPECT_EQ(rows[1].state, BakeState::baked);
  EXPECT_EQ(std::size_t(rows[1].cameras), cameras.size());
  EXPECT_FALSE(rows[1].triangles);
  EXPECT_FALSE(rows[1].holes);
  Inspection inspection;
  inspection.layout = layout;
  inspection.budgets.triangles.resize(layout->regions.size());
  std::iota(inspection.budgets.triangles.begin(), inspection.budgets.triangles.end(), 100);
  EXPECT_EQ(regionRows(*layout, &status, status.regions, &inspection, nullptr)[4].triangles, 104U);
  inspection.layout = smallLayout();
  EXPECT_FALSE(regionRows(*layout, &status, status.regions, &inspection, nullptr)[4].triangles)
      << "of another layout";
}

TEST(RegionTable, SortsByAnyColumnBothWaysAndKeepsTheOrderOfEquals) {
  const auto layout = smallLayout();
  auto rows = regionRows(*layout, nullptr, {}, nullptr, nullptr);
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r].triangles = 10 + r % 3, rows[r].bytes = 1000 - r;
  sortRows(rows, RegionColumn::triangles, true);
  EXPECT_TRUE(
      std::ranges::is_sorted(rows, std::greater<>(), [](const RegionRow& row) { return *row.triangles; }));
  EXPECT_LT(rows[0].region, rows[1].region);
  sortRows(rows, RegionColumn::bytes, false);
  EXPECT_TRUE(std::ranges::is_sorted(rows, {}, &RegionRow::bytes));
  rows[0].triangles.reset();
  sortRows(rows, RegionColumn::triangles, true);
  EXPECT_FALSE(rows.back().triangles) << "what is not known is not the worst";
}

TEST(RegionTable, LightsSayHowARegionStandsToTheBudget) {
  RegionRow row;
  EXPECT_EQ(lightOf(row, 100), BudgetLight::unknown);
  row.triangles = 80;
  EXPECT_EQ(lightOf(row, 0), BudgetLight::unknown);
  EXPECT_EQ(lightOf(row, 100), BudgetLight::within);
  row.triangles = 100;
  EXPECT_EQ(lightOf(row, 100), BudgetLight::near);
  row.triangles = 101;
  EXPECT_EQ(lightOf(row, 100), BudgetLight::over);
}

TEST(BakeStates, TheWorstOfItsCamerasDecidesForARegion) {
  const auto layout = smallLayout();
  const std::vector<int> cameras = camerasOf(layout->regions[0]);
  CapturesOnDisk there = nothingOnDisk(*layout);
  const auto stateNow = [&](const BakeMarks& marks = {}) {
    return regionStates(*layout, captureStatus(*layout, there), marks)[0];
  };
  EXPECT_EQ(stateNow(), BakeState::missing);
  there.baked[std::size_t(cameras[0])] = true;
  EXPECT_EQ(stateNow(), BakeState::partial);
  there.stale[std::size_t(cameras[1])] = true;
  EXPECT_EQ(stateNow(), BakeState::stale);
  EXPECT_EQ(stateNow({{cameras[1]}, {}}), BakeState::baking);
  EXPECT_EQ(stateNow({{cameras[1]}, {cameras[2]}}), BakeState::failed);
  there = nothingOnDisk(*layout);
  for (const int c : cameras) there.baked[std::size_t(c)] = true;
  EXPECT_EQ(stateNow(), BakeState::baked);
}

TEST(BakeStates, MarksAreOfTheLayoutThatIsShown) {
  BakeQueue queue;
  const auto queued = [](int storey, int camera, std::uint64_t key) {
    return QueuedCamera{.storey = storey, .camera = camera, .pixels = 1, .key = {0, key}};
  };
  queue.begin({queued(0, 5, 15), queued(0, 2, 12), queued(1, 3, 23), queued(0, 7, 17)});
  CameraNews news;
  for (const auto& [storey, camera, stage] : {std::tuple(0, 5, CameraStage::tracing),
                                              {0, 2, CameraStage::writing},
                                              {1, 3, CameraStage::tracing},
                                              {0, 7, CameraStage::failed}}) {
    news.camera = camera;
    news.stage = stage;
    queue.tell(1, storey, news);
  }
  const auto keys = [](std::uint64_t first, int count) {
    std::vector<ContentKey> all;
    for (int i = 0; i < count; ++i) all.push_back({0, first + std::uint64_t(i)});
    return all;
  };
  EXPECT_EQ(bakeMarks(queue, keys(10, 9)), (BakeMarks{{2, 5}, {7}}));
  EXPECT_EQ(bakeMarks(queue, keys(20, 5)), (BakeMarks{{3}, {}})) << "another storey";
  EXPECT_EQ(bakeMarks(queue, keys(14, 2)), (BakeMarks{{1}, {}})) << "edited since";
}

TEST(ConfigurationFacts, DensitiesAreThoseOfALargeFloor) {
  const Bounds scene{{-50, -50, 0}, {50, 50, 3}};
  for (int c = 0; c <= int(Configuration::g); ++c) {
    LayoutSpec spec;
    spec.configuration = Configuration(c);
    spec.cellSize = 1.5;
    spec.latticeOrigin = {3.1, -2};
    spec.rotationRadians = 0.3;
    const ConfigurationFacts facts = factsOf(patchOf(spec, Configuration(c)), scene, {});
    const auto laidIn = [&](double half) {
      spec.outline.loops = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
      return laidCounts(spec, Configuration(c), facts, 1e6).value_or(LaidCounts{});
    };
    // What grows with the border drops out.
    const LaidCounts large = laidIn(40), small = laidIn(20);
    const double area = 80 * 80 - 2 * 40 * 40;
    EXPECT_NEAR((double(large.regions) - 2 * double(small.regions)) / area / facts.regions, 1, 0.03)
        << nameOf(Configuration(c));
    EXPECT_NEAR((double(large.cameras) - 2 * double(small.cameras)) / area / facts.cameras, 1, 0.03)
        << nameOf(Configuration(c));
    EXPECT_GT(facts.pixels, 0);
    EXPECT_FALSE(laidCounts(spec, Configuration(c), facts, 10)) << "too many to count at once";
    EXPECT_NE(std::string(adviceOn(Configuration(c))), "");
  }
}

TEST(ConfigurationFacts, BytesPerPixelAreOfWhatIsBaked) {
  const auto layout = smallLayout();
  const Bounds scene{{-5, -5, 0}, {5, 5, 3}};
  const std::size_t n = layout->cameras.size();
  std::vector<bool> baked(n, false);
  std::vector<std::uint64_t> bytes(n, 0);
  EXPECT_FALSE(bytesPerPixel(*layout, baked, bytes, scene, {}));
  baked[2] = true, bytes[2] = 1'000'000;
  const auto one = bytesPerPixel(*layout, baked, bytes, scene, {});
  ASSERT_TRUE(one);
  bytes[2] = 3'000'000;
  EXPECT_NEAR(*bytesPerPixel(*layout, baked, bytes, scene, {}), 3 * *one, 1e-9);
}

}  // namespace
}  // namespace acentric::editor
