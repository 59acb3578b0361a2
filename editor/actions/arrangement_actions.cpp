#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

WholeView wholeOf(View view) { return view == View::walk ? WholeView::walk : WholeView::centre; }

/// Shows it; where it is shown already it fills the window, and again makes room for the others.
void showOrEnlarge(ActionContext& c, View view) {
  WholeView& whole = c.state.whole;
  const bool shown = shows(c, view);
  if (view != View::walk) c.state.centreView = view;
  if (shown)
    whole = whole == WholeView::none ? wholeOf(view) : WholeView::none;
  else if (whole != WholeView::none)
    whole = wholeOf(view);
}

void addViews(std::vector<Action>& table) {
  const auto add = [&table](const char* id, const char* label, int code, const char* help, View view) {
    table.push_back({id,
                     "View",
                     label,
                     {code, 0},
                     {},
                     help,
                     false,
                     withProject,
                     [view](ActionContext& c) { showOrEnlarge(c, view); },
                     [view](const ActionContext& c) { return shows(c, view); }});
  };
  add("view.plan", trLater("Plan"), key::f2,
      trLater("The layout from above. Again: it fills the window; once more: back."), View::plan);
  add("view.scene3d", trLater("3D"), key::f4,
      trLater("The scene from any side, with the layout in it. Again: it fills the window; once more: back."),
      View::scene3d);
  add("view.accuracy", trLater("Accuracy"), key::f6,
      trLater("How near settings come to the truth, and what they cost in time and bytes. Again: it fills "
              "the window; once more: back."),
      View::accuracy);
  add("view.walk", trLater("Walk"), key::f7,
      trLater("The walk. Again: it fills the window; once more: back."), View::walk);
}

void addPane(std::vector<Action>& table, const char* id, const char* label, const char* help,
             bool Preferences::*shown) {
  table.push_back({id,
                   "View",
                   label,
                   {},
                   {},
                   help,
                   false,
                   withProject,
                   [shown](ActionContext& c) {
                     Preferences& preferences = c.session.preferences();
                     preferences.*shown = !(preferences.*shown);
                     c.session.savePreferencesNow();
                   },
                   [shown](const ActionContext& c) { return c.session.preferences().*shown; }});
}

}  // namespace

bool shows(const ActionContext& c, View view) {
  const bool inFront = view == View::walk || c.state.centreView == view;
  if (c.state.whole != WholeView::none) return c.state.whole == wholeOf(view) && inFront;
  return inFront || fourViews(c);
}

bool fourViews(const ActionContext& c) {
  return c.session.preferences().fourViews && !c.session.shippedWalk();
}

Arrangement arrangementOf(const ActionContext& c) {
  if (!c.session.hasProject()) return Arrangement::panels;
  if (c.state.fullScreen || c.state.whole == WholeView::walk) return Arrangement::walk;
  if (c.state.whole == WholeView::centre) return Arrangement::centre;
  return fourViews(c) ? Arrangement::four : Arrangement::panels;
}

void addArrangementActions(std::vector<Action>& table) {
  addViews(table);
  table.push_back({"view.four",
                   "View",
                   trLater("Four views"),
                   {key::f8, 0},
                   {},
                   trLater("Plan, walk, 3D and accuracy at once; again: back to panels"),
                   true,
                   withProject,
                   [](ActionContext& c) {
                     Preferences& preferences = c.session.preferences();
                     preferences.fourViews = !(fourViews(c) && c.state.whole == WholeView::none);
                     c.state.whole = WholeView::none;
                     c.session.savePreferencesNow();
                   },
                   [](const ActionContext& c) { return arrangementOf(c) == Arrangement::four; }});
  table.push_back({"window.fullScreen",
                   "View",
                   trLater("Full-screen walk"),
                   {key::f11, 0},
                   {},
                   trLater("The walk alone on the whole screen; F11 or Esc leaves"),
                   false,
                   withProject,
                   [](ActionContext& c) { c.state.fullScreen = !c.state.fullScreen; },
                   [](const ActionContext& c) { return c.state.fullScreen; }});
  addPane(table, "window.settings", trLater("Settings pane"), trLater("At the left of the window"),
          &Preferences::showSettings);
  addPane(table, "window.bottom", trLater("Bake and messages pane"), trLater("At the bottom of the window"),
          &Preferences::showBottom);
}

}  // namespace acentric::editor
