#include <fmt/format.h>

#include "editor/actions/accuracy_actions.h"

#include "editor/actions/menu_actions.h"
#include "engine/pipeline/knobs.h"

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
    c.session.messages().addFailure("Measure accuracy against time", started.error());
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
    return c.session.messages().add(MessageLevel::info, label + ": the project is so already");
  c.session.apply({*project, label});
}

void addAccuracyActions(std::vector<Action>& table) {
  table.push_back(
      {"sweep.start",
       "Walk",
       "Measure accuracy against time",
       {},
       {},
       "Tries settings one by one, then together, on the same frames against ray-traced truth; goes on "
       "where it ended",
       true,
       canMeasure,
       [](ActionContext& c) { measure(c, false); },
       {},
       "a saved project that is not being measured"});
  table.push_back({"sweep.again",
                   "Walk",
                   "Measure it anew",
                   {},
                   {},
                   "Forgets what was measured before: for a project that has changed",
                   false,
                   canMeasure,
                   [](ActionContext& c) { measure(c, true); },
                   {},
                   "a saved project that is not being measured"});
  table.push_back({"sweep.stop",
                   "Walk",
                   "Stop measuring accuracy",
                   {},
                   {},
                   "What is measured is kept",
                   false,
                   [](const ActionContext& c) {
                     return c.session.sweeping().running() && !c.session.sweeping().stopping();
                   },
                   [](ActionContext& c) { c.session.sweeping().stop(); },
                   {},
                   "a measurement that runs"});
  const auto preset = [&table](const char* name, const char* help) {
    table.push_back({std::string("preset.") + name,
                     "Walk",
                     fmt::format("Use the {} preset", name),
                     {},
                     {},
                     help,
                     false,
                     [name](const ActionContext& c) { return presetNow(c, name).has_value(); },
                     [name](ActionContext& c) {
                       applySetting(c, *presetNow(c, name), fmt::format("Use the {} preset", name));
                     },
                     {},
                     "a measurement of accuracy against time"});
  };
  preset("fast", "Of what is worth having, the quickest frames with at most three times the least error");
  preset("balanced",
         "Of what is worth having, nearest to least error, quickest frame and fewest bytes at once");
  preset("accurate", "Of what is worth having, the least error");
}

}  // namespace acentric::editor
