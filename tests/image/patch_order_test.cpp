#include "engine/image/patch_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace acentric {
namespace {

/// By place in the order.
std::vector<std::size_t> placesIn(const PatchOrder& order) {
  std::vector<std::size_t> places(order.patches.size(), order.patches.size());
  for (std::size_t i = 0; i < order.patches.size(); ++i) places[order.patches[i]] = i;
  return places;
}

TEST(PatchOrder, KeepsAllPairsWhereThereIsNoRing) {
  std::mt19937 random(3);
  constexpr std::uint32_t kCount = 500;
  std::vector<std::uint32_t> hidden(kCount);
  std::iota(hidden.begin(), hidden.end(), 0u);
  std::ranges::shuffle(hidden, random);
  std::vector<PatchPair> pairs;
  for (int n = 0; n < 5000; ++n) {
    const std::uint32_t a = random() % kCount, b = random() % kCount;
    if (a != b) pairs.push_back({hidden[std::min(a, b)], hidden[std::max(a, b)], 1});
  }
  const PatchOrder order = orderPatches(pairs, std::vector<float>(kCount, 1), false);
  EXPECT_EQ(order.broken, 0u);
  const auto places = placesIn(order);
  for (const PatchPair& pair : pairs) EXPECT_LT(places[pair.first], places[pair.second]);
}

TEST(PatchOrder, IsByHowNearTheyAreWhereNoPairTells) {
  const PatchOrder order = orderPatches({{0, 3, 1}}, {0.1f, 0.5f, 0.3f, 0.9f}, false);
  EXPECT_EQ(order.patches, (std::vector<std::uint32_t>{1, 2, 0, 3}));
}

TEST(PatchOrder, WhatARingHidesComesAfterItHoweverMuchItHides) {
  // Three leaves hide each other in a ring, and a wall; the wall hides all that is behind it.
  std::vector<PatchPair> pairs{{0, 1, 4}, {1, 2, 4}, {2, 0, 1}, {0, 3, 1}};
  for (std::uint32_t behind = 4; behind < 40; ++behind) pairs.push_back({3, behind, 100});
  const PatchOrder order = orderPatches(pairs, std::vector<float>(40, 1), false);
  EXPECT_EQ(order.patches[3], 3u);
  EXPECT_EQ(order.broken, 1u);
  const auto places = placesIn(order);
  EXPECT_LT(places[0], places[1]);  // the pair that costs least is broken
  EXPECT_LT(places[1], places[2]);
}

TEST(PatchOrder, OfALargeRingHoldsEachOnceAndBreaksFewPairs) {
  std::mt19937 random(8);
  constexpr std::uint32_t kCount = 2000;
  std::vector<PatchPair> pairs;
  for (std::uint32_t i = 0; i + 1 < kCount; ++i) pairs.push_back({i, i + 1, 5});
  pairs.push_back({kCount - 1, 0, 1});
  for (int n = 0; n < 20000; ++n) {
    const std::uint32_t a = random() % kCount, b = random() % kCount;
    if (a != b) pairs.push_back({std::min(a, b), std::max(a, b), 5});
    if (n % 100 == 0 && a != b) pairs.push_back({std::max(a, b), std::min(a, b), 1});
  }
  for (const bool nearestFirst : {false, true}) {
    const PatchOrder order = orderPatches(pairs, std::vector<float>(kCount, 1), nearestFirst);
    std::vector<std::uint32_t> sorted = order.patches;
    std::ranges::sort(sorted);
    std::vector<std::uint32_t> all(kCount);
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
    if (!nearestFirst) {
      EXPECT_LT(order.broken, pairs.size() / 20);
    }
  }
}

}  // namespace
}  // namespace acentric
