#include "editor/panels/bottom_tabs.h"

#include <array>

#include "editor/panels/history_panel.h"
#include "editor/panels/messages_panel.h"
#include "editor/panels/paths_panel.h"
#include "editor/panels/problems_panel.h"
#include "ui/tabs.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

struct Entry {
  BottomTab tab;
  const char* action;  ///< that opens it
  const char* label;
  void (*draw)(PanelContext&);
};
constexpr std::array kTabs{
    Entry{BottomTab::messages, "tab.messages", trLater("Messages"), drawMessagesPanel},
    Entry{BottomTab::history, "tab.history", trLater("History"), drawHistoryPanel},
    Entry{BottomTab::paths, "tab.paths", trLater("Paths"), drawPathsPanel},
    // Last: its count comes and goes, and moves no other.
    Entry{BottomTab::problems, "tab.problems", trLater("Problems"), drawProblemsPanel}};

}  // namespace

void drawBottomTabs(PanelContext& context) {
  const BottomTab open = context.state().bottomTab;
  std::array<ui::Tab, kTabs.size()> tabs;
  for (std::size_t t = 0; t < tabs.size(); ++t) {
    tabs[t] = {tr(kTabs[t].label), kTabs[t].tab == open};
    if (kTabs[t].tab != BottomTab::problems) continue;
    const ProblemMark mark = problemMark(context.session());
    tabs[t].mark = mark.text;
    tabs[t].markColour = mark.colour;
  }
  ImFont* bold = context.window.fonts().bold;
  const float gap = ui::tabGap(bold, tabs);
  for (std::size_t t = 0; t < tabs.size(); ++t) {
    const bool clicked = ui::tab(bold, tabs[t], t == 0 ? 0 : gap);
    context.log.item(kTabs[t].action);
    if (clicked) runAction(context, *findAction(context.table, std::string(kTabs[t].action)));
  }
  ui::endTabs();
  for (const Entry& entry : kTabs)
    if (entry.tab == open) entry.draw(context);
}

}  // namespace acentric::editor
