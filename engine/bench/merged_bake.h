#pragma once
/// Bakes panoramas that stand together, as those of a head box, and keeps of each only what those before it
/// do not show (engine/image/merge_captures.h).

#include "engine/bench/bake_to_size.h"

namespace acentric {

/// Cameras [n * together, (n + 1) * together) stand together. A set is taken as baked when all of it is.
CaptureBake mergedBake(const Workplace& at, std::function<Result<OpenProject>(double)> open,
                       std::size_t together);

}  // namespace acentric
