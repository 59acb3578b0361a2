#include <fmt/format.h>

#include "engine/cli/commands.h"

namespace acentric::cli {
namespace {

const char* nameOf(Lighting lighting) {
  return lighting == Lighting::inTextures ? "in-textures"
         : lighting == Lighting::computed ? "computed"
                                          : "guess";
}

}  // namespace

Result<Report> runModel(const ModelOptions& options, const Common& common) {
  const auto open = openProject(options.project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  Project project = open->project;
  if (!options.light.empty()) project.import.lighting = importOptions("", 0, options.light).lighting;
  double metres = open->scene->report.metresPerUnit;
  if (options.metresPerUnit) {
    metres = *options.metresPerUnit;
    project = atScale(project, *open->scene, metres);
  }
  if (project != open->project)
    if (Status saved = saveEdited(project, options.project); !saved) return tl::unexpected(saved.error());
  const bool guessed = project.import.metresPerUnit == 0;
  Report report;
  report.json = {{"project", options.project.string()},
                 {"metresPerUnit", metres},
                 {"guessed", guessed},
                 {"light", nameOf(project.import.lighting)}};
  report.text = fmt::format("{}: {:g} metres per unit{}, light {}\n", options.project.string(), metres,
                            guessed ? " (guessed)" : "", nameOf(project.import.lighting));
  return report;
}

}  // namespace acentric::cli
