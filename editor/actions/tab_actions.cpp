#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {

void addTabActions(std::vector<Action>& table) {
  const auto tab = [&table](const char* id, const char* menu, const char* label, const Shortcut& shortcut,
                            const char* help, BottomTab shown, bool first) {
    table.push_back({id,
                     menu,
                     label,
                     shortcut,
                     {},
                     help,
                     first,
                     always,
                     [shown](ActionContext& c) { c.state.bottomTab = shown; },
                     [shown](const ActionContext& c) { return c.state.bottomTab == shown; }});
  };
  tab("tab.history", "Edit", trLater("Show history"), {key::h, kCtrl},
      trLater("Every edit; click one to go back or forth to it"), BottomTab::history, true);
  tab("tab.problems", "Plan", trLater("Show problems"), {key::p, kCtrl},
      trLater("What is wrong, or deserves a look"), BottomTab::problems, true);
  tab("tab.paths", "Walk", trLater("Show paths"), {}, trLater("Bookmarks and recorded walks"),
      BottomTab::paths, true);
  tab("tab.messages", "Help", trLater("Show messages"), {}, trLater("What the program has said"),
      BottomTab::messages, false);
}

}  // namespace acentric::editor
