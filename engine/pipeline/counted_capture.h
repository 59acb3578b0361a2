#pragma once
/// What captures that are ready to be drawn take, counted for as long as anybody uses them.

#include <memory>

#include "engine/base/memory_budget.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// The same capture; `budget` counts it until the last of its users lets it go.
std::shared_ptr<const DisplayCapture> counted(std::shared_ptr<const DisplayCapture> capture,
                                              std::shared_ptr<MemoryBudget> budget);

}  // namespace acentric
