#pragma once
/// What pruning loses, by how many of a region's eyes see it: what hardly any eye sees is lost most often.

#include <array>
#include <stop_token>

#include "engine/bake/pruning_loss.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

/// What fewer than a share of a region's eyes see, and does not belong to the class before it.
struct PruningClass {
  double seenByFewerThan = 1;  ///< of the last class: by whichever more
  PruningLoss loss = {};
};

/// As the project bakes: of what random eyes of all regions see in random directions, what no test eye does.
/// Classes by random eyes, kClassEyes of each region. Meaningless when stopped.
inline constexpr std::size_t kClassEyes = 200;
using PruningClasses = std::array<PruningClass, 4>;
PruningClasses pruningClassesOf(const OpenProject& open, TaskRunner& runner,
                                const std::stop_token& stop = {});

}  // namespace acentric
