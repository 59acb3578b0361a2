#pragma once
/// The plan with its regions coloured by their triangles, those over the budget marked.

#include <optional>

#include "engine/inspect/budgets.h"
#include "engine/picture/plan_picture.h"

namespace acentric {

PlanPicture pictureOf(const Layout& layout, const RegionBudgets& budgets, std::optional<std::size_t> limit,
                      std::string title);

}  // namespace acentric
