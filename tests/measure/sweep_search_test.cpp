#include "engine/measure/sweep_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace acentric {
namespace {

/// Every choice multiplies error, milliseconds and bytes by factors of its own.
struct Model {
  std::map<KnobChoice, Objectives> factors;
  Objectives of(const SweepSetting& setting) const {
    Objectives objectives{0.03, 8, 1e9};
    for (const KnobChoice& choice : setting)
      for (std::size_t k = 0; k < objectives.size(); ++k) objectives[k] *= factors.at(choice)[k];
    return objectives;
  }
  std::vector<SweepSetting> all() const {
    std::map<std::string, std::vector<KnobChoice>> byKnob;
    for (const auto& [choice, ignored] : factors) byKnob[choice.knob].push_back(choice);
    std::vector<SweepSetting> settings{{}};
    for (const auto& [knob, choices] : byKnob) {
      const std::size_t before = settings.size();
      for (std::size_t i = 0; i < before; ++i)
        for (const KnobChoice& choice : choices) {
          settings.push_back(settings[i]);
          settings.back().push_back(choice);
        }
    }
    return settings;
  }
  std::set<SweepSetting> front() const {
    const std::vector<SweepSetting> settings = all();
    std::vector<Objectives> points;
    for (const SweepSetting& setting : settings) points.push_back(of(setting));
    std::set<SweepSetting> best;
    for (const std::size_t i : paretoFront(points)) best.insert(settings[i]);
    return best;
  }
  std::map<SweepSetting, Objectives> singles() const {
    std::map<SweepSetting, Objectives> known{{{}, of({})}};
    for (const auto& [choice, ignored] : factors) known[{choice}] = of({choice});
    return known;
  }
};

Model randomModel(unsigned seed) {
  std::mt19937 random(seed);
  std::lognormal_distribution<double> factor(0, 0.5);
  Model model;
  for (const char* knob : {"a", "b", "c", "d"})
    for (const char* value : {"1", "2"})
      model.factors[{knob, value}] = {factor(random), factor(random), factor(random)};
  return model;
}

SearchHost hostOf(const Model& model, int& measured) {
  SearchHost host;
  host.goOn = [] { return true; };
  host.inOrder = [](SweepSetting setting) {
    std::ranges::sort(setting);
    return setting;
  };
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<Objectives>> {
    ++measured;
    return std::optional(model.of(setting));
  };
  return host;
}

std::set<SweepSetting> frontOf(const std::map<SweepSetting, Objectives>& known) {
  std::vector<SweepSetting> settings;
  std::vector<Objectives> points;
  for (const auto& [setting, objectives] : known) settings.push_back(setting), points.push_back(objectives);
  std::set<SweepSetting> front;
  for (const std::size_t i : paretoFront(points)) front.insert(settings[i]);
  return front;
}

TEST(SweepSearch, FindsTheFrontOfAModelWithoutMeasuringAllOfIt) {
  int measured = 0, possible = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Model model = randomModel(seed);
    const auto found = searchCombinations(model.singles(), hostOf(model, measured));
    ASSERT_TRUE(found) << found.error().describe();
    EXPECT_EQ(frontOf(*found), model.front()) << "seed " << seed;
    possible += int(model.all().size()) - int(model.singles().size());
  }
  EXPECT_LT(measured, possible / 2);
}

TEST(SweepSearch, MeasuresTheMostPromisingFirst) {
  Model model;
  model.factors[{"a", "1"}] = {0.5, 0.9, 1};
  model.factors[{"b", "1"}] = {0.9, 0.5, 1};
  model.factors[{"c", "1"}] = {0.99, 0.99, 1.01};
  std::vector<SweepSetting> order;
  int measured = 0;
  SearchHost host = hostOf(model, measured);
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<Objectives>> {
    order.push_back(setting);
    return std::optional(model.of(setting));
  };
  ASSERT_TRUE(searchCombinations(model.singles(), host));
  ASSERT_FALSE(order.empty());
  EXPECT_EQ(order.front(), (SweepSetting{{"a", "1"}, {"b", "1"}}));
}

TEST(SweepSearch, AsksForNothingTwiceAndStopsWhenTold) {
  const Model model = randomModel(3);
  int measured = 0;
  SearchHost host = hostOf(model, measured);
  std::set<SweepSetting> asked;
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<Objectives>> {
    EXPECT_TRUE(asked.insert(setting).second) << textOf(setting);
    return std::optional<Objectives>();
  };
  const auto none = searchCombinations(model.singles(), host);
  ASSERT_TRUE(none);
  EXPECT_EQ(*none, model.singles()) << "what cannot be measured is not known";
  EXPECT_FALSE(asked.empty());

  SearchHost brief = hostOf(model, measured);
  brief.goOn = [&] { return measured < 2; };
  const auto two = searchCombinations(model.singles(), brief);
  ASSERT_TRUE(two);
  EXPECT_EQ(two->size(), model.singles().size() + 2);
}

TEST(SweepSearch, LeadIsHowMuchWorseAPointMayBecome) {
  const std::vector<Objectives> others{{1, 10}, {10, 1}};
  EXPECT_NEAR(lead({1, 5}, others), std::log(2.0), 1e-12);
  EXPECT_EQ(lead({1, 10}, others), 0);
  EXPECT_LT(lead({2, 20}, others), 0);
}

}  // namespace
}  // namespace acentric
