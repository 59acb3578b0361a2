#include "editor/actions/accuracy_actions.h"

#include "editor/actions/menu_actions.h"
#include "engine/pipeline/knobs.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr const char* kNeeds = trLater("a saved project that is not being measured");

bool canMeasure(const ActionContext& c) {
  return withBuilt(c) && !c.session.untitled() && !c.session.dirty() && !c.session.sweeping().running() &&
         !c.session.proposing().running();
}

void show(ActionContext& c, bool goals) {
  c.state.centreView = View::accuracy;
  c.state.accuracy.goals = goals;
}

void begin(ActionContext& c, SweepWatch& watch, SweepRequest request, bool again, const char* what) {
  request.again = again;
  if (const Status started = watch.start(request); !started)
    c.session.messages().addFailure(what, started.error());
}

void measure(ActionContext& c, bool again) {
  show(c, false);
  begin(c, c.session.sweeping(), c.state.accuracy.request, again, tr("Measure accuracy against time"));
}

void search(ActionContext& c) {
  show(c, true);
  begin(c, c.session.proposing(), c.state.accuracy.goalsRequest, false, tr("Look for what keeps the goals"));
}

/// Of the sweep that there is; nothing where it has none.
std::optional<SweepSetting> presetNow(const ActionContext& c, const SweepWatch& watch,
                                      const std::string& name) {
  const auto& sweep = watch.sweep();
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
       "Accuracy",
       trLater("Measure accuracy against time"),
       {},
       {},
       trLater(
           "Tries settings one by one, then together, on the same frames against ray-traced truth; goes on "
           "where it ended"),
       false,
       canMeasure,
       [](ActionContext& c) { measure(c, false); },
       {},
       kNeeds});
  table.push_back({"sweep.again",
                   "Accuracy",
                   trLater("Measure it anew"),
                   {},
                   {},
                   trLater("Forgets what was measured before: for a project that has changed"),
                   false,
                   canMeasure,
                   [](ActionContext& c) { measure(c, true); },
                   {},
                   kNeeds});
  table.push_back({"sweep.stop",
                   "Accuracy",
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
    table.push_back(
        {std::string("preset.") + name,
         "Accuracy",
         label,
         {},
         {},
         help,
         false,
         [name](const ActionContext& c) { return presetNow(c, c.session.sweeping(), name).has_value(); },
         [name, label](ActionContext& c) {
           applySetting(c, *presetNow(c, c.session.sweeping(), name), tr(label));
         },
         {},
         trLater("a measurement of accuracy against time")});
  };
  preset("fast", trLater("Use the fast preset"),
         trLater("Of what is worth having, the quickest frames with at most three times the least error"));
  preset("balanced", trLater("Use the balanced preset"),
         trLater("Of what is worth having, nearest to least error, quickest frame and fewest bytes at once"));
  preset("accurate", trLater("Use the accurate preset"), trLater("Of what is worth having, the least error"));
  table.push_back(
      {"goals.show",
       "Accuracy",
       trLater("Keep to goals"),
       {},
       {},
       trLater("Bytes, milliseconds, decibels: looks for the layout and settings that keep to them"),
       true,
       withProject,
       [](ActionContext& c) { show(c, true); },
       {}});
  table.push_back(
      {"goals.start",
       "Accuracy",
       trLater("Look for what keeps the goals"),
       {},
       {},
       trLater("Bakes and measures what a few frames need, with one setting after another; goes on where it "
               "ended"),
       false,
       [](const ActionContext& c) {
         return canMeasure(c) && c.state.accuracy.goalsRequest.goals.check().has_value();
       },
       [](ActionContext& c) { search(c); },
       {},
       trLater("a goal, and a saved project that is not being measured")});
  table.push_back({"goals.stop",
                   "Accuracy",
                   trLater("Stop looking for what keeps the goals"),
                   {},
                   {},
                   trLater("What is measured is kept"),
                   false,
                   [](const ActionContext& c) {
                     return c.session.proposing().running() && !c.session.proposing().stopping();
                   },
                   [](ActionContext& c) { c.session.proposing().stop(); },
                   {},
                   trLater("a search that runs")});
  table.push_back(
      {"goals.take",
       "Accuracy",
       trLater("Take what keeps the goals best"),
       {},
       {},
       trLater("Sets the project so; undo takes it back"),
       false,
       [](const ActionContext& c) { return presetNow(c, c.session.proposing(), "proposal").has_value(); },
       [](ActionContext& c) {
         applySetting(c, *presetNow(c, c.session.proposing(), "proposal"), tr("Keep to goals"));
       },
       {},
       trLater("a search for what keeps goals")});
}

}  // namespace acentric::editor
