#pragma once
/// Looks for combinations of choices that are worth having, the most promising first. What each costs is
/// found by measuring; what a combination will cost is foretold from what is known: every choice is taken to
/// change each objective by the same factor whatever the others are.

#include <functional>
#include <map>
#include <optional>
#include <span>

#include "engine/measure/sweep.h"

namespace acentric {

struct SearchHost {
  /// Nothing: it cannot be measured, or not in the time left.
  std::function<Result<std::optional<Objectives>>(const SweepSetting&)> measure;
  /// The setting in its canonical order.
  std::function<SweepSetting(SweepSetting)> inOrder;
  /// Is there time for another one?
  std::function<bool()> goOn;
};

/// `known`: what is measured already, the empty setting among it; choices alone, and combinations of an
/// earlier search. Neighbours of the front (one choice more, another, or one less) that no known setting is
/// foretold to dominate are measured, the one farthest from that first, until none is left or goOn says no.
/// Gives all that is known then.
Result<std::map<SweepSetting, Objectives>> searchCombinations(std::map<SweepSetting, Objectives> known,
                                                              const SearchHost& host);

/// By how much it would have to be worse before something known dominated it: the least, over `others`, of
/// the largest logarithm of the ratio in any objective. At most 0: dominated or equal.
double lead(const Objectives& objectives, std::span<const Objectives> others);

}  // namespace acentric
