#include "editor/actions/menu_actions.h"
#include "editor/commands/setting_edits.h"

namespace acentric::editor {

void addWalkActions(std::vector<Action>& table) {
  table.push_back({"bake.start",
                   "Walk",
                   "Bake",
                   {key::b, kCtrl},
                   {},
                   "Bake what is missing, nearest to where you stand first",
                   false,
                   [](const ActionContext& c) { return withBuilt(c) && !c.session.baking().running(); },
                   [](ActionContext& c) {
                     if (c.session.untitled()) return saveThen(c, {Continuation::Kind::bake, {}});
                     c.session.startBake(glm::dvec2(c.state.walker.pose().eye));
                   },
                   {},
                   "that no bake runs"});
  table.push_back({"bake.takeOver",
                   "Walk",
                   "Take over bake",
                   {},
                   {},
                   "Bake here although another program bakes this project; that one ends",
                   false,
                   [](const ActionContext& c) {
                     return withBuilt(c) && !c.session.baking().running() && !c.session.untitled();
                   },
                   [](ActionContext& c) { c.session.startBake(glm::dvec2(c.state.walker.pose().eye), true); },
                   {},
                   "a saved project, and that no bake runs"});
  table.push_back({"bake.cancel",
                   "Walk",
                   "Cancel bake",
                   {},
                   {},
                   "What is finished stays",
                   false,
                   [](const ActionContext& c) {
                     return c.session.baking().running() && !c.session.baking().cancelling();
                   },
                   [](ActionContext& c) { c.session.cancelBake(); },
                   {},
                   "a running bake"});
  table.push_back({"bake.pause",
                   "Walk",
                   "Pause bake",
                   {},
                   {},
                   "Leaves the processors to others until it goes on",
                   true,
                   [](const ActionContext& c) {
                     return c.session.baking().running() && !c.session.baking().cancelling();
                   },
                   [](ActionContext& c) { c.session.pauseBake(!c.session.bakePaused()); },
                   [](const ActionContext& c) { return c.session.bakePaused(); },
                   "a running bake"});
  table.push_back({"bake.estimate",
                   "Walk",
                   "Estimate the bake",
                   {},
                   {},
                   "Tells time and bytes of what is missing, by baking a little of it",
                   false,
                   [](const ActionContext& c) {
                     return withBuilt(c) && !c.session.baking().running() &&
                            !c.session.estimating().running();
                   },
                   [](ActionContext& c) { c.session.estimateBake(); },
                   {},
                   "that no bake or estimate runs"});
  table.push_back({"walk.restart",
                   "Walk",
                   "Go to start",
                   {key::home, 0},
                   {},
                   "",
                   true,
                   withBuilt,
                   [](ActionContext& c) { c.state.restart = true; },
                   {}});
  table.push_back({"walk.setStart",
                   "Walk",
                   "Start here",
                   {key::home, kCtrl},
                   {},
                   "The walk begins where the eye is now, and baking begins near it",
                   false,
                   withBuilt,
                   [](ActionContext& c) {
                     const WalkPose& pose = c.state.walker.pose();
                     c.session.apply(setSpawn(c.session.project(), {glm::dvec2(pose.eye), pose.yawRadians}));
                   },
                   {}});
}

}  // namespace acentric::editor
