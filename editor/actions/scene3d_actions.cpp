#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool inScene3d(const ActionContext& c) { return withBuilt(c) && shows(c, View::scene3d); }

bool lookingThrough(const ActionContext& c) {
  return inScene3d(c) && c.state.scene3d.lookThrough &&
         cameraAtPlace(*c.session.built()->layout, *c.state.scene3d.lookThrough);
}

/// The first camera of the selected cells.
std::optional<CameraPlace> selectedCamera(const ActionContext& c) {
  if (!withBuilt(c)) return std::nullopt;
  for (const CellId& cell : c.state.selection)
    if (const auto place = firstPlace(*c.session.built()->layout, cell)) return place;
  return std::nullopt;
}

void setPlacing(ActionContext& c, bool placing) {
  if (c.state.planTool.mode() != PlanMode::cells) c.state.planTool.setMode(PlanMode::cells);
  c.state.scene3d.placing = placing;
}

/// The two ways of the cells tool; other tools give way to them.
void addPlacing(std::vector<Action>& table) {
  table.push_back(
      {"scene3d.select",
       "View",
       trLater("Select in 3D"),
       {},
       {},
       trLater(
           "Click a cell, a single APV, a corner of the outline or a key pose to select it; its arrows move "
           "it, its ring turns it (Shift snaps). Drag elsewhere orbits."),
       true,
       inScene3d,
       [](ActionContext& c) { setPlacing(c, false); },
       [](const ActionContext& c) {
         return !c.state.scene3d.placing && c.state.planTool.mode() == PlanMode::cells;
       },
       trLater("the 3D view")});
  table.push_back(
      {"scene3d.place",
       "View",
       trLater("Place cells in 3D"),
       {key::y, 0},
       {},
       trLater("Click a free place of the floor to add a cell, drag a placed one to move it, as on the plan"),
       false,
       inScene3d,
       [](ActionContext& c) {
         setPlacing(c, !c.state.scene3d.placing || c.state.planTool.mode() != PlanMode::cells);
       },
       [](const ActionContext& c) {
         return c.state.scene3d.placing && c.state.planTool.mode() == PlanMode::cells;
       },
       trLater("the 3D view")});
}

void addSwitches(std::vector<Action>& table) {
  table.push_back(
      {"scene3d.cut",
       "View",
       trLater("Cut the ceiling away"),
       {key::u, 0},
       {},
       trLater("Takes away all that is above the eyes, as on the plan"),
       true,
       inScene3d,
       [](ActionContext& c) {
         c.state.scene3d.cutCeiling = !c.state.scene3d.cutCeiling.value_or(c.state.scene3d.ceiling);
       },
       [](const ActionContext& c) { return c.state.scene3d.cutCeiling.value_or(c.state.scene3d.ceiling); },
       trLater(trLater("the 3D view"))});
  table.push_back({"scene3d.frusta",
                   "View",
                   trLater("Show sectors of all cameras"),
                   {},
                   {},
                   trLater("Of every camera, not of the selected cells' alone"),
                   false,
                   inScene3d,
                   [](ActionContext& c) { c.state.scene3d.allFrusta = !c.state.scene3d.allFrusta; },
                   [](const ActionContext& c) { return c.state.scene3d.allFrusta; },
                   trLater(trLater("the 3D view"))});
  table.push_back(
      {"scene3d.pick",
       "View",
       trLater("Pick surfaces"),
       {key::i, 0},
       {},
       trLater("Click a surface to ask which cameras sample it, and how finely; Alt+click does too"),
       true,
       inScene3d,
       [](ActionContext& c) { c.state.scene3d.picking = !c.state.scene3d.picking; },
       [](const ActionContext& c) { return c.state.scene3d.picking; },
       trLater(trLater("the 3D view"))});
}

void addCameraSteps(std::vector<Action>& table) {
  table.push_back(
      {"scene3d.lookThrough",
       "View",
       trLater("Look through a camera"),
       {key::o, 0},
       {},
       trLater(
           "The picture that a camera of the selected cell will take; double click on a camera for its own"),
       false,
       [](const ActionContext& c) {
         return inScene3d(c) && (c.state.scene3d.lookThrough || selectedCamera(c));
       },
       [](ActionContext& c) {
         auto& place = c.state.scene3d.lookThrough;
         place = place ? std::nullopt : selectedCamera(c);
       },
       [](const ActionContext& c) { return c.state.scene3d.lookThrough.has_value(); },
       trLater("the 3D view and a selected cell")});
  const auto step = [&table](const char* id, const char* label, int code, int steps) {
    table.push_back({id,
                     "View",
                     label,
                     {code, 0},
                     {},
                     "",
                     false,
                     lookingThrough,
                     [steps](ActionContext& c) {
                       c.state.scene3d.lookThrough =
                           stepped(*c.session.built()->layout, *c.state.scene3d.lookThrough, steps);
                     },
                     {},
                     trLater("a camera that is looked through")});
  };
  step("scene3d.previousCamera", trLater("Previous camera of the ring"), key::comma, -1);
  step("scene3d.nextCamera", trLater("Next camera of the ring"), key::period, 1);
  table.push_back(
      {"scene3d.otherHand",
       "View",
       trLater("Camera of the other hand"),
       {key::slash, 0},
       {},
       trLater("Of the ring that turns the other way, the camera that looks most nearly the same way"),
       false,
       [](const ActionContext& c) {
         return lookingThrough(c) && otherHand(*c.session.built()->layout, *c.state.scene3d.lookThrough);
       },
       [](ActionContext& c) {
         c.state.scene3d.lookThrough = otherHand(*c.session.built()->layout, *c.state.scene3d.lookThrough);
       },
       {},
       trLater("a camera that is looked through, of a cell with both hands")});
}

}  // namespace

void addScene3dActions(std::vector<Action>& table) {
  addPlacing(table);
  addSwitches(table);
  addCameraSteps(table);
}

}  // namespace acentric::editor
