#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void addLooks(std::vector<Action>& table) {
  const auto look = [&table](const char* id, const char* name, const Shortcut& shortcut, const char* help,
                             WalkLook shown) {
    table.push_back({id,
                     "Walk",
                     name,
                     shortcut,
                     {},
                     help,
                     shown == WalkLook::holes,
                     withProject,
                     [shown](ActionContext& c) {
                       c.state.walkLook = c.state.walkLook == shown ? WalkLook::picture : shown;
                     },
                     [shown](const ActionContext& c) { return c.state.walkLook == shown; }});
  };
  look("view.holes", trLater("Mark holes"), {key::h, 0},
       trLater("Pixels without a real sample in magenta, those filled in by guesswork too"), WalkLook::holes);
  look("view.sources", trLater("Cameras by colour"), {key::r, 0},
       trLater("Which camera painted each pixel; point at one for its name"), WalkLook::sources);
  look("view.split", trLater("Split with the truth"), {key::k, 0},
       trLater("The walk left, the ray-traced truth right of a border that can be dragged"), WalkLook::split);
  look("view.difference", trLater("Difference from the truth"), {key::k, ui::modifier::shift},
       trLater("How far each pixel is from the ray-traced truth, amplified"), WalkLook::difference);
  table.push_back(
      {"variant.keep",
       "Walk",
       trLater("Keep as variant"),
       {},
       {},
       trLater("Keeps the project as it is now, to be compared with what it becomes; its captures have to "
               "stay on disk"),
       false,
       withBuilt,
       [](ActionContext& c) {
         c.session.variants().keep(c.session.built());
         c.session.messages().add(MessageLevel::info,
                                  tr("Kept. Change the project, bake, and press N to compare."));
       },
       {}});
  look("view.variant", trLater("Compare with the kept variant"), {key::n, 0},
       trLater("The kept variant left, the project as it is now right of a border that can be dragged"),
       WalkLook::variant);
  Action& compare = table.back();
  compare.enabled = [](const ActionContext& c) { return withProject(c) && c.session.variants().kept(); };
  compare.needs = trLater("a variant that was kept");
}

/// Shown beside the picture where they matter, not in a menu.
void addCompareSettings(std::vector<Action>& table) {
  for (const int rays : kTruthRays)
    table.push_back(
        {fmt::format("compare.rays.{}", rays),
         "",
         fmt::format("{}", rays),
         {},
         {},
         trLater("Rays per pixel that the truth ends with: a regular grid, averaged. More: smoother edges, "
                 "as many times longer."),
         false,
         withProject,
         [rays](ActionContext& c) { c.state.truthRays = rays; },
         [rays](const ActionContext& c) { return c.state.truthRays == rays; }});
  for (const int gain : kDifferenceGains)
    table.push_back({fmt::format("compare.gain.{}", gain),
                     "",
                     fmt::format("×{}", gain),
                     {},
                     {},
                     trLater("Differences of sRGB codes are multiplied by this"),
                     false,
                     withProject,
                     [gain](ActionContext& c) { c.state.differenceGain = gain; },
                     [gain](const ActionContext& c) { return c.state.differenceGain == gain; }});
}

}  // namespace

void addWalkViewActions(std::vector<Action>& table) {
  addLooks(table);
  addCompareSettings(table);
  const auto flag = [&table](const char* id, const char* label, const Shortcut& shortcut, const char* help,
                             bool EditorState::*member, bool first) {
    table.push_back({id,
                     "Walk",
                     label,
                     shortcut,
                     {},
                     help,
                     first,
                     withProject,
                     [member](ActionContext& c) { c.state.*member = !(c.state.*member); },
                     [member](const ActionContext& c) { return c.state.*member; }});
  };
  flag("view.minimap", trLater("Show minimap"), {key::m, 0},
       trLater(
           "The plan in a corner of the walk, with the eye and the cameras that the picture is painted from"),
       &EditorState::showMinimap, true);
  flag("view.images", trLater("List images in use"), {key::m, ui::modifier::shift},
       trLater("In the order in which they are painted; point at one to see what it paints"),
       &EditorState::showImages, false);
  flag("walk.ask", trLater("Ask the picture"), {key::j, 0},
       trLater("A click on the walk tells what painted it, how far it is from the truth, and what would "
               "improve it; "
               "Alt+click does so at any time"),
       &EditorState::asking, true);
  flag("view.frameTimes", trLater("Graph frame times"), {key::f3, 0},
       trLater("What the newest frames of the walk took, part by part"), &EditorState::showFrameTimes, false);
  table.push_back({"walk.screenshot",
                   "Walk",
                   trLater("Save picture"),
                   {key::f12, 0},
                   {},
                   trLater("Writes what the walk shows as a PNG beside the project, under a new name"),
                   true,
                   [](const ActionContext& c) {
                     return withBuilt(c) && c.session.walk() && !c.session.savingPicture().running();
                   },
                   [](ActionContext& c) { c.state.takePicture = true; },
                   {}});
}

}  // namespace acentric::editor
