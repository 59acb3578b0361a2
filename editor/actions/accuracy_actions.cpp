#include "editor/actions/accuracy_actions.h"

#include "editor/actions/menu_actions.h"
#include "engine/pipeline/knobs.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool canMeasure(const ActionContext& c) {
  return withBuilt(c) && !c.session.untitled() && !c.session.dirty() && !c.session.sweeping().running();
}

void measure(ActionContext& c, bool again) {
  c.state.centreView = View::accuracy;
  SweepRequest request = c.state.accuracy.request;
  request.again = again;
  if (const Status started = c.session.sweeping().start(request); !started)
    c.session.messages().addFailure(tr("Measure accuracy against time"), started.error());
}

/// Of the sweep that there is; nothing where it has none.
std::optional<SweepSetting> presetNow(const ActionContext& c, const std::string& name) {
  const auto& sweep = c.session.sweeping().sweep();
  if (!withBuilt(c) || !sweep) return std::nullopt;
  for (SweepPreset& preset : presetsOf(*sweep))
    if (preset.name == name) return std::move(preset.setting);
  return std::nullopt;
}

}  // namespace

void applySetting(ActionContext& c, const SweepSetting& setting, const std::string& label) {
  const auto project = acentric::applySetting(c.session.project(), setting);
  if (!project) return c.session.messages().addFailure(label, project.error());
  if (*project == c.session.project())
    return c.session.messages().add(MessageLevel::info, trf("{}: the project is so already", label));
  c.session.apply({*project, label});
}

void addAccuracyActions(std::vector<Action>& table) {
  table.push_back(
      {"sweep.start",
       "Walk",
       trLater("Measure accuracy against time"),
       {},
       {},
       trLater(
           "Tries settings one by one, then together, on the same frames against ray-traced truth; goes on "
           "where it ended"),
       true,
       canMeasure,
       [](ActionContext& c) { measure(c, false); },
       {},
       trLater("a saved project that is not being measured")});
  table.push_back({"sweep.again",
                   "Walk",
                   trLater("Measure it anew"),
                   {},
                   {},
                   trLater("Forgets what was measured before: for a project that has changed"),
                   false,
                   canMeasure,
                   [](ActionContext& c) { measure(c, true); },
                   {},
                   trLater("a saved project that is not being measured")});
  table.push_back({"sweep.stop",
                   "Walk",
                   trLater("Stop measuring accuracy"),
                   {},
                   {},
                   trLater("What is measured is kept"),
                   false,
                   [](const ActionContext& c) {
                     return c.session.sweeping().running() && !c.session.sweeping().stopping();
                   },
                   [](ActionContext& c) { c.session.sweeping().stop(); },
                   {},
                   trLater("a measurement that runs")});
  const auto preset = [&table](const char* name, const char* label, const char* help) {
    table.push_back({std::string("preset.") + name,
                     "Walk",
                     label,
                     {},
                     {},
                     help,
                     false,
                     [name](const ActionContext& c) { return presetNow(c, name).has_value(); },
                     [name, label](ActionContext& c) { applySetting(c, *presetNow(c, name), tr(label)); },
                     {},
                     trLater("a measurement of accuracy against time")});
  };
  preset("fast", trLater("Use the fast preset"),
         trLater("Of what is worth having, the quickest frames with at most three times the least error"));
  preset("balanced", trLater("Use the balanced preset"),
         trLater("Of what is worth having, nearest to least error, quickest frame and fewest bytes at once"));
  preset("accurate", trLater("Use the accurate preset"), trLater("Of what is worth having, the least error"));
}

}  // namespace acentric::editor
