#include "engine/measure/pareto.h"

#include <gtest/gtest.h>

#include <random>

namespace acentric {
namespace {

bool dominatedByAny(const std::vector<Objectives>& points, std::size_t i) {
  for (const Objectives& other : points) {
    bool nowhereWorse = true, somewhereBetter = false;
    for (std::size_t k = 0; k < other.size(); ++k) {
      nowhereWorse = nowhereWorse && other[k] <= points[i][k];
      somewhereBetter = somewhereBetter || other[k] < points[i][k];
    }
    if (nowhereWorse && somewhereBetter) return true;
  }
  return false;
}

TEST(ParetoFront, IsWhatNoPointDominatesAlsoWhereManyAreEqual) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t dimensions = 1 + trial % 4, count = random() % 60;
    const int levels = trial % 3 == 0 ? 1000000 : 4;  // few levels: many ties
    std::uniform_int_distribution<int> level(0, levels);
    std::vector<Objectives> points(count, Objectives(dimensions));
    for (Objectives& point : points)
      for (double& value : point) value = level(random);
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < count; ++i)
      if (!dominatedByAny(points, i)) expected.push_back(i);
    EXPECT_EQ(paretoFront(points), expected) << "trial " << trial;
  }
}

TEST(ParetoFront, OfNothingIsEmptyAndOfOneThatOne) {
  EXPECT_TRUE(paretoFront({}).empty());
  const std::vector<Objectives> one{{3, 4}};
  EXPECT_EQ(paretoFront(one), std::vector<std::size_t>{0});
}

TEST(ParetoFront, EqualPointsDoNotDominateEachOther) {
  EXPECT_FALSE(dominates({1, 2}, {1, 2}));
  EXPECT_TRUE(dominates({1, 1}, {1, 2}));
  EXPECT_FALSE(dominates({0, 3}, {1, 2}));
}

}  // namespace
}  // namespace acentric
