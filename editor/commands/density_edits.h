#pragma once
/// Edits of how densely regions are sampled (LayoutSpec::density): twice the samples per degree are four
/// times the bytes, and about four times the bake. Pure: project in, edit out.

#include <set>

#include "editor/commands/edit.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

/// `steps` rungs up or down from a density, of which each doubles or halves the samples: ... 0.71, 1, 1.41
/// ... One between two rungs goes to the next of them. Within kLeastRegionDensity..kMostRegionDensity.
double densityAfter(double density, int steps);
/// "1.41", as it is shown and typed.
std::string densityText(double density);

/// 1 takes the regions' own density back.
Edit setDensity(const Project& project, const std::set<CellId>& cells, double density);
/// Each from its own, so that differences stay.
Edit stepDensity(const Project& project, const std::set<CellId>& cells, int steps);

}  // namespace acentric::editor
