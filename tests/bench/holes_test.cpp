#include "engine/bench/holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

/// Columns around the middle of a room, with things behind them. Nothing is lit: colours are exact.
RayScenePtr columns() {
  test::SceneBuilder builder;
  const auto unlit = [&](glm::vec3 colour) {
    Material m = test::matte(colour);
    m.unlit = true;
    return builder.material(m);
  };
  builder.box(unlit({0.4f, 0.35f, 0.3f}), {-8, -8, 0}, {8, 8, 3}, true);
  const int red = unlit({0.6f, 0.2f, 0.1f}), blue = unlit({0.1f, 0.3f, 0.6f});
  for (int i = 0; i < 24; ++i) {  // one ring behind the other
    const float radius = i % 2 == 0 ? 2.6f : 4.2f, angle = 0.2618f * float(i);
    const float x = radius * std::cos(angle), y = radius * std::sin(angle);
    builder.box(i % 3 == 0 ? red : blue, {x - 0.25f, y - 0.25f, 0}, {x + 0.25f, y + 0.25f, 3});
  }
  return builder.rays();
}

double worstHoles(const HoleBench& bench, const char* name) {
  for (const HoleBenchMethod& method : bench.methods)
    if (method.name == name) {
      double worst = 0;
      for (const Comparison& c : method.comparisons) worst = std::max(worst, c.holeShare);
      return worst;
    }
  ADD_FAILURE() << "no method " << name;
  return 0;
}

TEST(BenchHoles, FindsWhatThePaperFindsAndThatLayersCloseWhatTheRingLeavesOpen) {
  const OpenProject open = test::openWith(columns(), test::smallProject(0.4, 2));
  HoleBenchOptions options;
  options.frames = 3;
  options.width = 192, options.height = 108;
  TaskRunner runner(0);
  std::vector<BakeForecast> told;
  options.tell = [&](const BakeForecast& forecast) { told.push_back(forecast); };
  const auto bench = benchHoles(open, options, runner);
  ASSERT_TRUE(bench) << bench.error().describe();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].bakes, 2);
  EXPECT_EQ(told[0].lights, 1);
  EXPECT_EQ(told[0].bytes(), 0) << "nothing is written";
  EXPECT_GT(told[0].memoryBytes, MemoryBudget::kUsual) << "all of it is kept";
  ASSERT_EQ(bench->views.size(), 3u);
  ASSERT_EQ(bench->methods.size(), 6u);
  int filled = 0;
  for (const HoleBenchMethod& method : bench->methods) {
    ASSERT_EQ(method.comparisons.size(), 3u);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_GE(method.openShares[v], method.comparisons[v].holeShare);
    EXPECT_GT(method.samples, 1000u);
    for (std::size_t v = 0; v < 3; ++v) {
      const ColourImage& picture = method.pictures[v];
      std::size_t unpainted = 0;
      double squares = 0, pixels = 0;
      for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
        const glm::dvec4 shown(picture.pixels[p]), truth(bench->truth[v].pixels[p]);
        unpainted += shown.a == 0;
        for (int c = 0; c < 3; ++c) squares += std::pow((shown.a == 0 ? 0 : shown[c]) - truth[c], 2);
        pixels += 3;
      }
      EXPECT_NEAR(double(unpainted) / double(picture.pixels.size()), method.openShares[v], 1e-12)
          << method.name << ": pictures show what is open";
      if (method.openShares[v] < 0.01) continue;
      EXPECT_GT(method.comparisons[v].psnr, 10 * std::log10(255 * 255 * pixels / squares))
          << method.name << ": figures are of filled frames";
      ++filled;
    }
  }
  EXPECT_GT(filled, 2);
  // The walk goes to the left, within one region.
  const glm::dvec2 way(bench->views.back().eye - bench->views.front().eye);
  const double yaw = bench->views.front().yawRadians;
  EXPECT_GT(glm::dot(way, directionOf(yaw + kPi / 2)), 0.5);
  EXPECT_NEAR(glm::dot(way, directionOf(yaw)), 0, 1e-9);
  EXPECT_EQ(*open.layout->regionAt(glm::dvec2(bench->views.front().eye)),
            *open.layout->regionAt(glm::dvec2(bench->views.back().eye)));

  EXPECT_LT(bench->methods[0].comparisons[0].holeShare, 0.002)
      << "the panorama sees from its own place all that there is";
  const double tpv = worstHoles(*bench, "TPV"), oneHand = worstHoles(*bench, "APV, one hand"),
               apv = worstHoles(*bench, "APV"), both = worstHoles(*bench, "TPV + APV"),
               layered = worstHoles(*bench, "layered");
  EXPECT_GT(tpv, 0.02) << "behind the columns it sees nothing";
  EXPECT_GE(oneHand, apv);
  EXPECT_LE(both, tpv);
  EXPECT_LE(both, apv);
  EXPECT_LT(layered, 0.005);
  EXPECT_LT(layered, apv) << "the same cameras, with what lies behind";
}

TEST(BenchHoles, SaysWhatIsWrong) {
  const RayScenePtr scene = columns();
  TaskRunner runner(0);
  HoleBenchOptions options;
  options.frames = 0;
  EXPECT_FALSE(benchHoles(test::openWith(scene, test::smallProject(1.2, 2)), options, runner));
  Project none = test::smallProject(1.2, 2);
  none.layout().outline = {};
  const auto refused = benchHoles(test::openWith(scene, none), HoleBenchOptions{}, runner);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("place a cell"), std::string::npos);
}

}  // namespace
}  // namespace acentric
