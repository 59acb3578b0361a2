#include "editor/commands/density_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/layout/density.h"
#include "ui/translate.h"

namespace acentric::editor {

double densityAfter(double density, int steps) {
  constexpr double kSameRung = 1e-3;
  const double rung = 2 * std::log2(density);
  const double from = steps > 0 ? std::floor(rung + kSameRung) : std::ceil(rung - kSameRung);
  return std::clamp(std::exp2((from + steps) / 2), kLeastRegionDensity, kMostRegionDensity);
}

std::string densityText(double density) { return fmt::format("{:.3g}", density); }

Edit setDensity(const Project& project, const std::set<CellId>& cells, double density) {
  Edit edit{project, density == 1 ? trfMany("Usual sampling in {} cell", "Usual sampling in {} cells",
                                            cells.size(), cells.size())
                                  : trfMany("{} times the samples per degree in {} cell",
                                            "{} times the samples per degree in {} cells", cells.size(),
                                            densityText(density), cells.size())};
  for (const CellId& cell : cells) giveDensity(edit.project.layout(), cell, density);
  return edit;
}

Edit stepDensity(const Project& project, const std::set<CellId>& cells, int steps) {
  const std::size_t count = cells.size();
  Edit edit{project, steps > 0
                         ? trfMany("More samples in {} cell", "More samples in {} cells", count, count)
                         : trfMany("Fewer samples in {} cell", "Fewer samples in {} cells", count, count)};
  for (const CellId& cell : cells)
    giveDensity(edit.project.layout(), cell, densityAfter(densityOf(project.layout(), cell), steps));
  return edit;
}

}  // namespace acentric::editor
