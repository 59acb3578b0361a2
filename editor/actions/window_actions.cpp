#include <algorithm>
#include <array>

#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr std::array<int, 9> kScales = {75, 90, 100, 110, 125, 150, 175, 190, 200};

/// The next of the usual scales above (steps > 0) or below.
void changeScale(ActionContext& c, int steps) {
  int& percent = c.session.preferences().scalePercent;
  const int now = percent > 0 ? percent : 100;
  if (steps > 0) {
    const auto next = std::ranges::upper_bound(kScales, now);
    percent = next == kScales.end() ? kScales.back() : *next;
  } else {
    const auto here = std::ranges::lower_bound(kScales, now);
    percent = here == kScales.begin() ? kScales.front() : *(here - 1);
  }
  c.session.savePreferencesNow();
}

}  // namespace

void addPreferenceActions(std::vector<Action>& table) {
  table.push_back({"file.preferences",
                   "File",
                   trLater("Preferences…"),
                   {key::comma, kCtrl},
                   {},
                   trLater("Theme, size of the interface, threads and memory, walking, autosave, start-up"),
                   true,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::preferences; },
                   {}});
  table.push_back({"window.lightTheme",
                   "File",
                   trLater("Light theme"),
                   {},
                   {},
                   trLater("Dark ink on light ground; dark theme again when switched off"),
                   false,
                   always,
                   [](ActionContext& c) {
                     Theme& theme = c.session.preferences().theme;
                     theme = theme == Theme::light ? Theme::dark : Theme::light;
                     c.session.savePreferencesNow();
                   },
                   [](const ActionContext& c) { return c.session.preferences().theme == Theme::light; }});
  table.push_back({"window.resetLayout",
                   "File",
                   trLater("Reset window layout"),
                   {},
                   {},
                   trLater("The panes get their first sizes back"),
                   false,
                   always,
                   [](ActionContext& c) {
                     c.session.preferences().resetLayout();
                     c.session.savePreferencesNow();
                   },
                   {}});
}

void addWindowActions(std::vector<Action>& table) {
  const auto scale = [&table](const char* id, const char* label, int code, const char* help, int steps) {
    table.push_back({id,
                     "",
                     label,
                     {code, kCtrl},
                     {},
                     help,
                     false,
                     always,
                     [steps](ActionContext& c) { changeScale(c, steps); },
                     {}});
  };
  scale("window.larger", trLater("Larger interface"), key::equal,
        trLater("Texts, buttons and marks, up to 200 %"), 1);
  scale("window.smaller", trLater("Smaller interface"), key::minus,
        trLater("Texts, buttons and marks, down to 75 %"), -1);
  table.push_back({"window.automaticScale",
                   "",
                   trLater("Interface as large as the display asks"),
                   {key::digit0, kCtrl},
                   {},
                   trLater("The size follows the scale that is set for the monitor"),
                   false,
                   always,
                   [](ActionContext& c) {
                     c.session.preferences().scalePercent = 0;
                     c.session.savePreferencesNow();
                   },
                   {}});
  table.push_back({"window.menus",
                   "",
                   trLater("Open the menus"),
                   {key::f10, 0},
                   {},
                   trLater("Arrows walk them, Enter runs, Esc leaves; Alt opens them too"),
                   false,
                   always,
                   [](ActionContext& c) { c.state.openMenus = true; },
                   {}});
}

}  // namespace acentric::editor
