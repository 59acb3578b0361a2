#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/layout_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

glm::dvec2 eyePlace(const ActionContext& c) { return glm::dvec2(c.state.walker.pose().eye); }

bool pointed(const ActionContext& c) { return withBuilt(c) && c.state.pointedFloor.has_value(); }

void tell(ActionContext& c, std::string text) {
  c.session.messages().add(MessageLevel::info, std::move(text));
}

/// The cell of the lattice that holds the place; told where there is one.
void addCellAt(ActionContext& c, const glm::dvec2& place) {
  const Project& project = c.session.project();
  const CellId cell = cellAt(project.layout(), place).id;
  if (isPlaced(project.layout(), cell)) {
    c.state.selection = {cell};
    const bool split = canSplitCell(project.layout(), cell);
    return tell(
        c,
        split ? trf("Cell ({}, {}) covers this place already, and is selected now. It can be split (X), or a "
                    "single APV be added here.",
                    cell.i, cell.j)
              : trf("Cell ({}, {}) covers this place already, and is selected now. A single APV can be added "
                    "here too.",
                    cell.i, cell.j));
  }
  if (c.session.apply(addCell(project, cell))) c.state.selection = {cell};
}

/// With its cameras as far out as the plan's tool puts them.
void addApvAt(ActionContext& c, const glm::dvec2& place) {
  const Project& project = c.session.project();
  const LayoutSpec& spec = project.layout();
  const double taken = 0.01 * spec.cellSize;
  for (const auto& [number, apv] : spec.freeApvs)
    if (glm::distance(apv.centre, place) <= taken) {
      c.state.selection = {{number, 0, kFreeSlot}};
      return tell(c, trf("Panorama {} stands here already, and is selected now.", number));
    }
  if (spec.freeApvs.size() >= std::size_t(kMaxFreeApvs))
    return tell(
        c, trf("There are {} single APVs, the most that a storey takes. Remove one first.", kMaxFreeApvs));
  const int number = nextFreeNumber(spec);
  if (c.session.apply(addFreeApv(project, Apv{place, {spec.cellSize, 0}})))
    c.state.selection = {{number, 0, kFreeSlot}};
}

void selectCellHere(ActionContext& c) {
  const auto cell = cellOfEye(c);
  if (!cell) return tell(c, tr("No cell covers the place where the eye is. Add one there (Insert)."));
  c.state.selection = {*cell};
}

}  // namespace

std::optional<CellId> cellOfEye(const ActionContext& c) {
  if (!withBuilt(c)) return std::nullopt;
  const Layout& layout = *c.session.built()->layout;
  const auto region = layout.regionAt(eyePlace(c));
  return region ? std::optional(layout.regions[std::size_t(*region)].id) : std::nullopt;
}

void addHereActions(std::vector<Action>& table) {
  const auto here = [&table](const char* id, const char* label, const Shortcut& shortcut, const char* help,
                             bool first, void (*run)(ActionContext&)) {
    table.push_back({id, "Walk", label, shortcut, {}, help, first, withBuilt, run, {}, trLater("a layout")});
  };
  here("walk.addCell", trLater("Add a cell here"), {key::insert, 0},
       trLater("The place of the lattice that the eye stands in"), true,
       [](ActionContext& c) { addCellAt(c, eyePlace(c)); });
  here("walk.addApv", trLater("Add a single APV here"), {key::insert, ui::modifier::shift},
       trLater("Beside the lattice, its middle at the eye"), false,
       [](ActionContext& c) { addApvAt(c, eyePlace(c)); });
  here("walk.selectCell", trLater("Select the cell I stand in"), {key::a, kCtrlShift}, "", false,
       selectCellHere);
  const auto there = [&table](const char* id, const char* label, const char* help,
                              void (*run)(ActionContext&)) {
    table.push_back({id,
                     "",
                     label,
                     {},
                     {},
                     help,
                     false,
                     pointed,
                     run,
                     {},
                     trLater("a right click on the floor of the walk")});
  };
  there("walk.addCellThere", trLater("Add a cell where I pointed"),
        trLater("The place of the lattice that the floor under the pointer belongs to"),
        [](ActionContext& c) { addCellAt(c, *c.state.pointedFloor); });
  there("walk.addApvThere", trLater("Add a single APV where I pointed"), trLater("Beside the lattice"),
        [](ActionContext& c) { addApvAt(c, *c.state.pointedFloor); });
}

}  // namespace acentric::editor
