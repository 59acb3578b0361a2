#pragma once
/// What can be selected in one go. Pure: layouts and figures in, cells out.

#include <functional>
#include <set>
#include <vector>

#include "engine/inspect/budgets.h"
#include "engine/inspect/placement_checks.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

enum class Combine { replace, add, toggle };

std::set<CellId> combined(const std::set<CellId>& before, const std::vector<CellId>& cells, Combine how);

/// Does a convex polygon share a point with the box? (plan, metres)
bool touches(const ConvexPolygon& polygon, const glm::dvec2& low, const glm::dvec2& high);
/// Regions that share a point with a box of the plan.
std::vector<CellId> cellsTouching(const Layout& layout, const glm::dvec2& low, const glm::dvec2& high);

/// `holds` is asked by the region's number.
std::set<CellId> cellsWhere(const Layout& layout, const std::function<bool(std::size_t region)>& holds);
std::set<CellId> inverted(const Layout& layout, const std::set<CellId>& selection);
std::set<CellId> overBudget(const Layout& layout, const RegionBudgets& budgets, std::size_t limit);
/// Of which a warning or an error is about the region itself or about a camera that one of its covers names.
std::set<CellId> withWarnings(const Layout& layout, const PlacementReport& report);

}  // namespace acentric::editor
