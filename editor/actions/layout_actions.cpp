#include "editor/actions/menu_actions.h"
#include "editor/commands/storey_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void addStoreyActions(std::vector<Action>& table) {
  const auto beside = [&table](const char* id, const char* label, int code, int steps, bool first) {
    table.push_back({id,
                     "Plan",
                     label,
                     {code, 0},
                     {},
                     "",
                     first,
                     [steps](const ActionContext& c) {
                       return c.session.hasProject() && storeyBeside(c.session.project(), steps);
                     },
                     [steps](ActionContext& c) {
                       c.state.selection.clear();
                       c.session.apply(
                           showStorey(c.session.project(), *storeyBeside(c.session.project(), steps)));
                     },
                     {},
                     trLater("a storey there")});
  };
  beside("storey.up", trLater("Storey above"), key::pageUp, 1, true);
  beside("storey.down", trLater("Storey below"), key::pageDown, -1, false);
  table.push_back(
      {"storey.find",
       "Plan",
       trLater("Find more storeys"),
       {},
       {},
       trLater(
           "Looks for floors to walk on that have no layout yet, and lays cells like this storey's on them"),
       false,
       [](const ActionContext& c) { return withBuilt(c) && !c.session.searching().running(); },
       [](ActionContext& c) { c.session.findStoreys(); },
       {},
       trLater("that no search runs")});
  table.push_back(
      {"storey.stairs",
       "Plan",
       trLater("Find stairs and ramps"),
       {},
       {},
       trLater("Lays cells on the stairs and ramps between this project's storeys: the walk goes over them"),
       false,
       [](const ActionContext& c) {
         return withBuilt(c) && c.session.project().storeys.size() > 1 && !c.session.searching().running();
       },
       [](ActionContext& c) { c.session.findStairs(); },
       {},
       trLater("two storeys, and that no search runs")});
  table.push_back({"storey.remove",
                   "Plan",
                   trLater("Remove this storey"),
                   {},
                   {},
                   "",
                   false,
                   [](const ActionContext& c) {
                     return c.session.hasProject() && c.session.project().storeys.size() > 1;
                   },
                   [](ActionContext& c) {
                     c.state.selection.clear();
                     c.session.apply(removeStorey(c.session.project()));
                   },
                   {},
                   trLater("a second storey")});
}

void addBudgetActions(std::vector<Action>& table) {
  const auto search = [&table](const char* id, const char* label, const char* help, bool onlySplit,
                               void (Session::*run)()) {
    table.push_back({id,
                     "Plan",
                     label,
                     {},
                     {},
                     help,
                     !onlySplit,
                     [onlySplit](const ActionContext& c) {
                       return withBuilt(c) && !c.session.searching().running() &&
                              c.session.project().budget.trianglesPerRegion > 0 &&
                              (!onlySplit || canSplit(c.session.project().layout().configuration));
                     },
                     [run](ActionContext& c) { (c.session.*run)(); },
                     {},
                     trLater("a triangle budget")});
  };
  search("budget.fit", trLater("Fit cells to the budget"),
         trLater("The largest cells whose regions all keep to the triangle budget"), false,
         &Session::fitCells);
  search("budget.split", trLater("Split cells above the budget"),
         trLater("Only the cells that exceed the triangle budget (configurations e and g)"), true,
         &Session::splitOverBudget);
  table.push_back({"search.cancel",
                   "Plan",
                   trLater("Stop searching"),
                   {},
                   {},
                   "",
                   false,
                   [](const ActionContext& c) {
                     return c.session.searching().running() && !c.session.searching().cancelling();
                   },
                   [](ActionContext& c) { c.session.cancelSearch(); },
                   {},
                   trLater("a running search")});
}

}  // namespace

void addLayoutActions(std::vector<Action>& table) {
  addStoreyActions(table);
  addBudgetActions(table);
}

}  // namespace acentric::editor
