/// acentric preset: a project set as a sweep found worth having.

#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/knobs.h"

namespace acentric::cli {

Result<Report> runPreset(const PresetOptions& options, const Common&) {
  const auto project = loadProject(options.project);
  if (!project) return tl::unexpected(project.error());
  const auto file = sweepFileOf(options.project, options.from);
  const auto setting = presetOf(file, options.name);
  if (!setting) return tl::unexpected(setting.error());
  const auto set = applySetting(*project, *setting);
  if (!set) return tl::unexpected(set.error());
  const auto changes = inOrder(*setting, *project);
  if (!changes) return tl::unexpected(changes.error());

  Report report;
  report.json = {{"preset", options.name},
                 {"from", file.string()},
                 {"changes", Json::array()},
                 {"applied", options.apply}};
  report.text = fmt::format("{} of {}:\n", options.name, file.string());
  bool bakes = false;
  for (const KnobChoice& choice : *changes) {
    const Knob& knob = **knobOf(choice.knob);
    const std::string before = knob.value(*project);
    bakes = bakes || knob.bakes;
    report.json["changes"].push_back({{"knob", knob.name}, {"from", before}, {"to", choice.value}});
    report.text += fmt::format("  {}: {} -> {}\n", knob.name, before, choice.value);
  }
  if (changes->empty()) report.text += "  the project is so already\n";
  report.json["bakes"] = bakes;
  if (!options.apply) {
    report.text += "nothing is written: add --apply\n";
    return report;
  }
  if (Status saved = saveProject(*set, options.project); !saved) return tl::unexpected(saved.error());
  if (bakes) report.text += "its captures are others now: `acentric bake` makes them\n";
  return report;
}

}  // namespace acentric::cli
