#pragma once
/// Adaptive refinement: keeps a layout's cells, origin, rotation and hand edits, and splits exactly those
/// regions that have more local triangles than the budget, again and again, until none has or the smallest
/// cells allowed are reached. Every part has the near band around it too, so counts do not fall to a quarter;
/// where all splits below a region hardly lower its worst part, they are taken back. Each region is counted
/// once, however many rounds there are.

#include <stop_token>
#include <vector>

#include "engine/inspect/budgets.h"

namespace acentric {

struct RefineOptions {
  std::size_t mostTriangles = 200'000;  ///< per region
  double leastCell = 0.3;               ///< metres; nothing is split into smaller cells
  /// A split must lower its worst region by this share, or bring it within the budget; 0..1.
  double leastGain = 0.05;
  /// Undo splits that the spec has, where the whole keeps to the budget and no part of it was added or
  /// removed by hand.
  bool merge = false;

  Status check() const;
};

enum class WhyOver : std::uint8_t {
  smallest,      ///< its parts would be smaller than allowed
  splitsNoHelp,  ///< down to the smallest allowed, some part would have about as many
  freeApv,       ///< has no parts
  tooMany,       ///< the layout would have more regions than there can be
};
const char* describe(WhyOver why);

struct RefineResult {
  LayoutSpec spec;        ///< the one given, with other splits
  RegionBudgets budgets;  ///< of buildLayout(spec); `counted` = all that were counted on the way
  struct Over {
    int region = 0;
    WhyOver why = WhyOver::smallest;
  };
  std::vector<Over> over;  ///< regions still above the budget, most first
  std::size_t regionsBefore = 0, worstBefore = 0, overBefore = 0;
  std::size_t split = 0, merged = 0;         ///< regions that gave way to parts, and parts' wholes restored
  std::vector<std::size_t> regionsPerLevel;  ///< [0]: of the full cell size, [1]: of half of it ...
  bool satisfied() const { return over.empty(); }
};

/// Refuses configurations whose cells cannot be split, naming those that can.
Result<RefineResult> refineToBudget(const LayoutSpec& spec, const TriangleTree& tree,
                                    const RefineOptions& options, TaskRunner& runner,
                                    const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
