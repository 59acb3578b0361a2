#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/density_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::set<CellId> cellsOfEye(const ActionContext& c) {
  const auto cell = cellOfEye(c);
  return cell ? std::set<CellId>{*cell} : std::set<CellId>{};
}

/// Those that are selected, where the plan or the 3D view shows them; else the one that the eye stands in.
std::set<CellId> cellsMeant(const ActionContext& c) {
  const bool walkAlone = c.state.fullScreen || c.state.whole == WholeView::walk;
  return walkAlone || c.state.selection.empty() ? cellsOfEye(c) : c.state.selection;
}

void tell(ActionContext& c, const std::set<CellId>& cells) {
  const Project& project = c.session.project();
  double least = kMostRegionDensity, most = kLeastRegionDensity;
  for (const CellId& cell : cells) {
    const double density = densityOf(project.layout(), cell);
    least = std::min(least, density), most = std::max(most, density);
  }
  const std::string times =
      least == most ? densityText(most) : fmt::format("{}–{}", densityText(least), densityText(most));
  const double perDegree =
      std::clamp(most * project.bake.samplesPerDegree, kLeastSamplesPerDegree, kMostSamplesPerDegree);
  c.session.messages().add(MessageLevel::info,
                           trfMany("{} cell: {} times the samples per degree ({:.3g} /°). Bake to see it",
                                   "{} cells: {} times the samples per degree ({:.3g} /°). Bake to see it",
                                   cells.size(), cells.size(), times, perDegree));
}

}  // namespace

void addDensityActions(std::vector<Action>& table) {
  const auto density = [&table](const char* id, const char* label, const Shortcut& shortcut, const char* help,
                                bool first, auto meant, auto edit) {
    table.push_back({id,
                     "Edit",
                     label,
                     shortcut,
                     {},
                     help,
                     first,
                     [meant](const ActionContext& c) { return !meant(c).empty(); },
                     [meant, edit](ActionContext& c) {
                       const std::set<CellId> cells = meant(c);
                       if (c.session.apply(edit(c.session.project(), cells))) tell(c, cells);
                     },
                     {},
                     trLater("a selected cell, or that the walk's eye stands in one")});
  };
  const auto step = [](int steps) {
    return [steps](const Project& p, const std::set<CellId>& cells) { return stepDensity(p, cells, steps); };
  };
  density(
      "density.more", trLater("More samples in selected cells"), {key::rightBracket, 0},
      trLater(
          "1.41 times the samples per degree, twice the bytes. Where no cell is selected, in the one that "
          "the walk's eye stands in"),
      true, cellsMeant, step(1));
  density("density.fewer", trLater("Fewer samples in selected cells"), {key::leftBracket, 0},
          trLater("Half the bytes. Where no cell is selected, in the one that the walk's eye stands in"),
          false, cellsMeant, step(-1));
  density("density.usual", trLater("The project's samples in selected cells"), {}, "", false, cellsMeant,
          [](const Project& p, const std::set<CellId>& cells) { return setDensity(p, cells, 1); });
  density("density.moreHere", trLater("More resolution here"), {key::rightBracket, ui::modifier::shift},
          trLater("Twice the samples, and bytes, for the cell that the walk's eye stands in"), false,
          cellsOfEye, step(1));
  density("density.fewerHere", trLater("Fewer bytes here"), {key::leftBracket, ui::modifier::shift},
          trLater("Half the samples, and bytes, for the cell that the walk's eye stands in"), false,
          cellsOfEye, step(-1));
}

}  // namespace acentric::editor
