#pragma once
/// The actions by menu; makeActionTable() puts them in order. Each appends to the table.

#include <optional>
#include <vector>

#include "editor/actions/action.h"
#include "editor/session/pane_sizes.h"
#include "ui/keys.h"

namespace acentric::editor {

namespace key = ui::key;
inline constexpr int kCtrl = ui::modifier::control;
inline constexpr int kCtrlShift = ui::modifier::control | ui::modifier::shift;

// When an action makes sense.
inline bool always(const ActionContext&) { return true; }
inline bool withProject(const ActionContext& c) { return c.session.hasProject(); }
inline bool withBuilt(const ActionContext& c) {
  return c.session.hasProject() && c.session.built() != nullptr;
}

/// Which the walk's eye stands in.
std::optional<CellId> cellOfEye(const ActionContext& c);

/// Four views in place of panels, which only a project has.
bool fourViews(const ActionContext& c);
Arrangement arrangementOf(const ActionContext& c);
/// Does the window show it, alone or with others?
bool shows(const ActionContext& c, View view);

void addFileActions(std::vector<Action>& table);
/// Which views the window shows, and which alone.
void addArrangementActions(std::vector<Action>& table);
void addEditActions(std::vector<Action>& table);
/// What is selected, and copies and moves of it: part of the Edit menu.
void addSelectionActions(std::vector<Action>& table);
/// How densely cells are sampled: part of the Edit menu.
void addDensityActions(std::vector<Action>& table);
/// Tools and what the plan shows.
void addPlanActions(std::vector<Action>& table);
/// Storeys, and cells that keep to the triangle budget.
void addLayoutActions(std::vector<Action>& table);
/// Of the walkable area.
void addOutlineActions(std::vector<Action>& table);
void addWalkActions(std::vector<Action>& table);
/// What is added and selected where the eye of the walk stands: part of the Walk menu.
void addHereActions(std::vector<Action>& table);
/// In the File menu, after saving: the walk in browsers.
void addPublishActions(std::vector<Action>& table);
/// In the File menu, after closing: preferences and the window's layout.
void addPreferenceActions(std::vector<Action>& table);
/// In no menu: size of the interface, and the menus themselves.
void addWindowActions(std::vector<Action>& table);
/// What the 3D view shows.
void addScene3dActions(std::vector<Action>& table);
/// What the walk shows of its frames, and over them.
void addWalkViewActions(std::vector<Action>& table);
/// Recording, replay, paths and bookmarks.
void addPathActions(std::vector<Action>& table);
/// What accuracy costs in time, presets of it, and goals: the Accuracy menu.
void addAccuracyActions(std::vector<Action>& table);
/// Presets of the bake's settings, in the Walk menu, and the ways to settings that are folded away.
void addQualityActions(std::vector<Action>& table);
void addHelpActions(std::vector<Action>& table);
/// Which tab the pane at the lower right shows.
void addTabActions(std::vector<Action>& table);

}  // namespace acentric::editor
