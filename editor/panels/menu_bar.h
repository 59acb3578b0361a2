#pragma once
/// The menus, made from the table of actions.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

struct MenuBar {
  float height = 0;      ///< pixels
  bool focused = false;  ///< arrows walk it, no menu being open
};
MenuBar drawMenuBar(PanelContext& context);

}  // namespace acentric::editor
