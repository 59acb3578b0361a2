#include "editor/actions/menu_actions.h"
#include "editor/commands/setting_edits.h"
#include "ui/translate.h"

namespace acentric::editor {

void addWalkActions(std::vector<Action>& table) {
  table.push_back({"bake.start",
                   "Walk",
                   trLater("Bake"),
                   {key::b, kCtrl},
                   {},
                   trLater("Bake what is missing, nearest to where you stand first"),
                   false,
                   [](const ActionContext& c) { return withBuilt(c) && !c.session.baking().running(); },
                   [](ActionContext& c) {
                     if (c.session.untitled()) return saveThen(c, {Continuation::Kind::bake, {}});
                     c.session.startBake(glm::dvec2(c.state.walker.pose().eye));
                   },
                   {},
                   trLater("that no bake runs")});
  table.push_back({"bake.takeOver",
                   "Walk",
                   trLater("Take over bake"),
                   {},
                   {},
                   trLater("Bake here although another program bakes this project; that one ends"),
                   false,
                   [](const ActionContext& c) {
                     return withBuilt(c) && !c.session.baking().running() && !c.session.untitled();
                   },
                   [](ActionContext& c) { c.session.startBake(glm::dvec2(c.state.walker.pose().eye), true); },
                   {},
                   trLater("a saved project, and that no bake runs")});
  table.push_back({"bake.cancel",
                   "Walk",
                   trLater("Cancel bake"),
                   {},
                   {},
                   trLater("What is finished stays"),
                   false,
                   [](const ActionContext& c) {
                     return c.session.baking().running() && !c.session.baking().cancelling();
                   },
                   [](ActionContext& c) { c.session.cancelBake(); },
                   {},
                   trLater("a running bake")});
  table.push_back({"bake.pause",
                   "Walk",
                   trLater("Pause bake"),
                   {},
                   {},
                   trLater("Leaves the processors to others until it goes on"),
                   true,
                   [](const ActionContext& c) {
                     return c.session.baking().running() && !c.session.baking().cancelling();
                   },
                   [](ActionContext& c) { c.session.pauseBake(!c.session.bakePaused()); },
                   [](const ActionContext& c) { return c.session.bakePaused(); },
                   trLater("a running bake")});
  table.push_back({"bake.estimate",
                   "Walk",
                   trLater("Estimate the bake"),
                   {},
                   {},
                   trLater("Tells time and bytes of what is missing, by baking a little of it"),
                   false,
                   [](const ActionContext& c) {
                     return withBuilt(c) && !c.session.baking().running() &&
                            !c.session.estimating().running();
                   },
                   [](ActionContext& c) { c.session.estimateBake(); },
                   {},
                   trLater("that no bake or estimate runs")});
  table.push_back({"walk.restart",
                   "Walk",
                   trLater("Go to start"),
                   {key::home, 0},
                   {},
                   "",
                   true,
                   withBuilt,
                   [](ActionContext& c) { c.state.restart = true; },
                   {}});
  table.push_back({"walk.setStart",
                   "Walk",
                   trLater("Start here"),
                   {key::home, kCtrl},
                   {},
                   trLater("The walk begins where the eye is now, and baking begins near it"),
                   false,
                   withBuilt,
                   [](ActionContext& c) {
                     const WalkPose& pose = c.state.walker.pose();
                     c.session.apply(setSpawn(c.session.project(), {glm::dvec2(pose.eye), pose.yawRadians}));
                   },
                   {}});
}

}  // namespace acentric::editor
