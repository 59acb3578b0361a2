#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/setting_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void addPreset(std::vector<Action>& table, BakePreset preset, const char* label, const char* help) {
  table.push_back({fmt::format("quality.{}", nameOf(preset)),
                   "Walk",
                   label,
                   {},
                   {},
                   help,
                   preset == BakePreset::draft,
                   withProject,
                   [preset](ActionContext& c) {
                     if (presetInForce(c.session.project().bake) != preset)
                       c.session.apply(setBakePreset(c.session.project(), preset));
                   },
                   [preset](const ActionContext& c) {
                     return c.session.hasProject() && presetInForce(c.session.project().bake) == preset;
                   }});
}

}  // namespace

void addQualityActions(std::vector<Action>& table) {
  addPreset(
      table, BakePreset::draft, trLater("Bake quality: draft"),
      trLater(
          "Half the resolution of a new project, fewer rays and layers: soon there, to see what the layout "
          "lacks"));
  addPreset(table, BakePreset::balanced, trLater("Bake quality: balanced"),
            trLater("What new projects have: 16 samples per degree"));
  addPreset(table, BakePreset::fine, trLater("Bake quality: fine"),
            trLater("Twice the resolution, four times the rays for light: several times the time and bytes"));
  const auto advanced = [&table](const char* id, const char* label, const char* help, const char* section) {
    table.push_back({id,
                     "View",
                     label,
                     {},
                     {},
                     help,
                     false,
                     withProject,
                     [section](ActionContext& c) { c.state.openSection = section; },
                     {}});
  };
  advanced("settings.advancedLayout", trLater("Advanced settings of the layout"),
           trLater("Near band, floor height and the lattice's origin"), "Layout/Advanced");
  advanced("settings.advancedBake", trLater("Advanced settings of the bake"),
           trLater("Eye range, pruning, test eyes, layers, distance shift, ambient radius, surface texel"),
           "Bake quality/Advanced");
}

}  // namespace acentric::editor
