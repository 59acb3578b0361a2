#include "editor/commands/density_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acentric::editor {
namespace {

std::string labelOf(const std::set<CellId>& cells, const std::string& what) {
  return cells.size() == 1 ? fmt::format("{} in a cell", what)
                           : fmt::format("{} in {} cells", what, cells.size());
}

}  // namespace

void giveDensity(LayoutSpec& spec, const CellId& cell, double density) {
  spec.density.erase(cell);
  // What surrounds a part may have a density of its own.
  if (densityOf(spec, cell) != density) spec.density[cell] = density;
}

double densityAfter(double density, int steps) {
  constexpr double kSameRung = 1e-3;
  const double rung = 2 * std::log2(density);
  const double from = steps > 0 ? std::floor(rung + kSameRung) : std::ceil(rung - kSameRung);
  return std::clamp(std::exp2((from + steps) / 2), kLeastRegionDensity, kMostRegionDensity);
}

std::string densityText(double density) { return fmt::format("{:.3g}", density); }

Edit setDensity(const Project& project, const std::set<CellId>& cells, double density) {
  Edit edit{project, labelOf(cells, density == 1 ? std::string("Usual sampling")
                                                 : densityText(density) + " times the samples per degree")};
  for (const CellId& cell : cells) giveDensity(edit.project.layout(), cell, density);
  return edit;
}

Edit stepDensity(const Project& project, const std::set<CellId>& cells, int steps) {
  Edit edit{project, labelOf(cells, steps > 0 ? "More samples" : "Fewer samples")};
  for (const CellId& cell : cells)
    giveDensity(edit.project.layout(), cell, densityAfter(densityOf(project.layout(), cell), steps));
  return edit;
}

}  // namespace acentric::editor
