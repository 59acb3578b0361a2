/// Settings that keep to goals, against a search through all of them.

#include "engine/measure/goal_search.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace acentric {
namespace {

constexpr double kUsual = 8;

/// Every choice multiplies bytes and milliseconds and adds to the PSNR, by little differently wherever it is
/// made; layouts have more or fewer pixels.
struct World {
  std::map<KnobChoice, GoalFigures> effects;
  std::map<std::string, double> pixels;  ///< of a layout, times the usual one's
  double wobble = 0;

  static double resolutionOf(const SweepSetting& setting) {
    for (const KnobChoice& choice : setting)
      if (choice.knob == "resolution") return std::stod(choice.value);
    return kUsual;
  }
  double pixelsOf(const SweepSetting& setting) const {
    double factor = 1e7;
    for (const KnobChoice& choice : setting)
      if (choice.knob == "layout") factor *= pixels.at(choice.value);
    return factor * std::pow(resolutionOf(setting) / kUsual, 2);
  }
  GoalFigures of(const SweepSetting& setting) const {
    const double doublings = std::log2(resolutionOf(setting) / kUsual);
    GoalFigures figures{10 * pixelsOf(setting) * std::exp2(-0.2 * doublings), 12 * std::exp2(0.3 * doublings),
                        32 + 3 * doublings};
    for (const KnobChoice& choice : setting)
      if (const auto effect = effects.find(choice); effect != effects.end()) {
        const double other = 1 + wobble * std::sin(double(std::hash<std::string>{}(textOf(setting)) % 100));
        figures.bytes *= std::pow(effect->second.bytes, other);
        figures.frameMs *= std::pow(effect->second.frameMs, other);
        figures.psnr += effect->second.psnr * other;
      }
    return figures;
  }
};

World randomWorld(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  World world;
  for (const char* knob : {"layout", "quality", "reconstruction"})
    for (const char* value : {"1", "2", "3"})
      world.effects[{knob, value}] = {std::exp2(0.4 * normal(random)), std::exp2(0.4 * normal(random)),
                                      1.5 * normal(random)};
  for (const char* value : {"1", "2", "3"}) world.pixels[value] = std::exp2(0.7 * normal(random));
  return world;
}

GoalChoices choicesOf(const World& world) {
  GoalChoices choices{{}, "resolution", kUsual, 1, 64};
  for (const auto& [choice, effect] : world.effects) choices.choices.push_back(choice);
  return choices;
}

std::vector<SweepSetting> allOf(const World& world) {
  std::vector<SweepSetting> all{{}};
  const auto multiply = [&](const std::vector<KnobChoice>& options) {
    const std::size_t before = all.size();
    for (std::size_t i = 0; i < before; ++i)
      for (const KnobChoice& choice : options) all.push_back(all[i]), all.back().push_back(choice);
  };
  for (const char* knob : {"layout", "quality", "reconstruction"})
    multiply({{knob, "1"}, {knob, "2"}, {knob, "3"}});
  std::vector<KnobChoice> resolutions;
  for (double r = 1; r <= 64; r *= 1.05) resolutions.push_back({"resolution", fmt::format("{:.3g}", r)});
  multiply(resolutions);
  for (const SweepSetting& setting : all) (void)world.of(setting);
  return all;
}

GoalHost hostOf(const World& world, int& measured, int most) {
  GoalHost host;
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<GoalFigures>> {
    ++measured;
    return std::optional(world.of(setting));
  };
  host.inOrder = [](SweepSetting setting) {
    std::ranges::sort(setting);
    std::erase_if(setting,
                  [](const KnobChoice& each) { return each.knob == "resolution" && each.value == "8"; });
    return setting;
  };
  host.pixels = [&](const SweepSetting& setting) { return world.pixelsOf(setting); };
  host.seconds = [](const SweepSetting&) { return 1.0; };
  host.goOn = [&measured, most] { return measured < most; };
  return host;
}

double leastScore(const World& world, const Goals& goals) {
  double least = HUGE_VAL;
  for (const SweepSetting& setting : allOf(world)) least = std::min(least, scoreOf(goals, world.of(setting)));
  return least;
}

class GoalSearchOf : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Worlds, GoalSearchOf, testing::Range(1u, 25u));

TEST_P(GoalSearchOf, FindsWhatASearchThroughAllFindsOrNearlySo) {
  World world = randomWorld(GetParam());
  world.wobble = GetParam() % 2 == 0 ? 0 : 0.1;
  constexpr int kMost = 40;
  const GoalFigures now = world.of({});
  for (const Goals& goals :
       {Goals{0.5 * now.bytes, 0.8 * now.frameMs, now.psnr + 1}, Goals{0.25 * now.bytes, {}, {}},
        Goals{{}, {}, now.psnr + 4}, Goals{2 * now.bytes, now.frameMs, now.psnr - 1}}) {
    int measured = 0;
    const GoalHost host = hostOf(world, measured, kMost);
    const auto known = searchForGoals({{{}, now}}, goals, choicesOf(world), host);
    ASSERT_TRUE(known) << known.error().describe();
    double least = HUGE_VAL;
    for (const auto& [setting, figures] : *known) least = std::min(least, scoreOf(goals, figures));
    EXPECT_LE(measured, kMost);
    EXPECT_LE(least, leastScore(world, goals) + 0.1) << textOf(goals) << " after " << measured;
  }
}

TEST(GoalSearch, WhatIsRefusedIsNotAskedForAgainAtAnotherResolution) {
  const World world = randomWorld(3);
  int measured = 0;
  GoalHost host = hostOf(world, measured, 60);
  std::map<SweepSetting, int> refusals;
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<GoalFigures>> {
    ++measured;
    SweepSetting rest = setting;
    std::erase_if(rest, [](const KnobChoice& each) { return each.knob == "resolution"; });
    const bool refused = std::ranges::find(rest, KnobChoice{"layout", "2"}) != rest.end();
    if (!refused) return std::optional(world.of(setting));
    ++refusals[rest];
    return std::optional<GoalFigures>();
  };
  const Goals goals{world.of({}).bytes / 3, {}, world.of({}).psnr + 1};
  const auto known = searchForGoals({{{}, world.of({})}}, goals, choicesOf(world), host);
  ASSERT_TRUE(known);
  for (const auto& [setting, times] : refusals) EXPECT_EQ(times, 1) << textOf(setting);
}

TEST(GoalSearch, WhatIsQuicklyMeasuredComesFirstAndWhatTakesTooLongNever) {
  const World world = randomWorld(4);
  int measured = 0;
  GoalHost host = hostOf(world, measured, 60);
  const auto has = [](const SweepSetting& setting, const char* knob) {
    return std::ranges::find(setting, std::string(knob), &KnobChoice::knob) != setting.end();
  };
  host.seconds = [&](const SweepSetting& setting) {
    if (has(setting, "layout")) return HUGE_VAL;
    return has(setting, "quality") || has(setting, "resolution") ? 1000.0 : 1.0;
  };
  std::vector<SweepSetting> order;
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<GoalFigures>> {
    ++measured;
    order.push_back(setting);
    return std::optional(world.of(setting));
  };
  const Goals goals{world.of({}).bytes / 4, world.of({}).frameMs / 4, world.of({}).psnr + 3};
  ASSERT_TRUE(searchForGoals({{{}, world.of({})}}, goals, choicesOf(world), host));
  ASSERT_GT(order.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(order[i].front().knob, "reconstruction") << textOf(order[i]);
  for (const SweepSetting& setting : order) EXPECT_FALSE(has(setting, "layout")) << textOf(setting);
}

TEST(GoalSearch, EndsOnAnErrorAndWhenTheTimeIsUp) {
  const World world = randomWorld(5);
  int measured = 0;
  GoalHost host = hostOf(world, measured, 0);
  const Goals goals{world.of({}).bytes / 3, {}, {}};
  const auto none = searchForGoals({{{}, world.of({})}}, goals, choicesOf(world), host);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->size(), 1u);
  host.goOn = [] { return true; };
  host.measure = [](const SweepSetting&) -> Result<std::optional<GoalFigures>> {
    return fail(ErrorKind::cancelled, "stopped");
  };
  EXPECT_FALSE(searchForGoals({{{}, world.of({})}}, goals, choicesOf(world), host));
}

TEST(Goals, AreMissedByTheirWorst) {
  const Goals goals{60e6, 16, 35};
  EXPECT_NEAR(missOf(goals, {60e6, 16, 35}), 0, 1e-12);
  EXPECT_NEAR(missOf(goals, {120e6, 8, 40}), 1, 1e-12);
  EXPECT_NEAR(missOf(goals, {30e6, 64, 40}), 2, 1e-12);
  EXPECT_NEAR(missOf(goals, {30e6, 8, 35 - 20 * std::log10(2.0)}), 1, 1e-12);
  EXPECT_LT(missOf({{}, {}, 35}, {1e12, 1e6, 36}), 0);
  EXPECT_EQ(textOf(goals), "at most 60 MB, at most 16 ms, at least 35 dB");
}

TEST(Goals, OfThoseThatKeepThemTheSmallestIsBestAndWithoutAnErrorTheTruest) {
  const Goals all{60e6, 16, 35};
  EXPECT_LT(scoreOf(all, {20e6, 8, 38}), scoreOf(all, {50e6, 8, 40}));
  EXPECT_LT(scoreOf(all, {50e6, 8, 40}), scoreOf(all, {10e6, 8, 34}));
  const Goals bytes{60e6, {}, {}};
  EXPECT_LT(scoreOf(bytes, {50e6, 8, 40}), scoreOf(bytes, {20e6, 8, 38}));
}

TEST(Goals, AreCheckedAndGoThroughNumbers) {
  using testing::HasSubstr;
  EXPECT_THAT(Goals{}.check().error().message, HasSubstr("give a goal"));
  EXPECT_FALSE((Goals{-1, {}, {}}.check()));
  EXPECT_FALSE((Goals{{}, {}, std::nan("")}.check()));
  const Goals goals{60e6, {}, 35};
  EXPECT_TRUE(goals.check());
  EXPECT_EQ(goalsFrom(numbersOf(goals)), goals);
  EXPECT_EQ(goalsFrom({{"other", 3}}), Goals{});
}

TEST(Goals, ProposeTheBestOfWhatWasMeasured) {
  Sweep sweep;
  const auto add = [&](const SweepSetting& setting, double bytes, double ms, double psnr) {
    SweepPoint point;
    point.setting = setting;
    point[Measure::bytes].median = bytes, point[Measure::frameMs].median = ms;
    point[Measure::psnr].median = psnr;
    sweep.points.push_back(point);
  };
  const Goals goals{60e6, 16, 35};
  EXPECT_EQ(proposalOf(sweep, goals), nullptr);
  add({}, 100e6, 12, 37);
  add({{"resolution", "4"}}, 40e6, 11, 35.5);
  add({{"resolution", "3"}}, 1e6, 11, 45);
  sweep.points.back().skipped = "no time";
  ASSERT_NE(proposalOf(sweep, goals), nullptr);
  EXPECT_EQ(proposalOf(sweep, goals)->setting, sweep.points[1].setting);
}

}  // namespace
}  // namespace acentric
