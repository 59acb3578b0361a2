#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/first_cell.h"
#include "engine/pipeline/scene_storeys.h"

namespace acentric::cli {
namespace {

/// A model that was brought along for nothing goes again.
void takeBack(const CollectedModel& collected) {
  std::error_code error;
  if (collected.folder.empty()) return;
  std::filesystem::remove_all(collected.folder, error);
  std::filesystem::remove(collected.folder.parent_path(), error);  // unless it holds others
}

Result<CollectedModel> makeAndSave(const NewOptions& options, const NewProjectOptions& choices,
                                   const Common& common) {
  auto collected =
      collectModel(options.scene, options.output, choices.import,
                   options.link ? Collect::link : Collect::files, common.host, common.progress, common.stop);
  if (!collected) return collected;
  const auto runner = common.runner();
  const auto project = makeProject(options.output.parent_path() / collected->scene, options.output, choices,
                                   common.host, *runner, common.progress, common.stop);
  Status made;
  if (!project)
    made = tl::unexpected(project.error());
  else if (made = saveProject(*project, options.output); made)
    made = mustExist(options.output);
  if (made) return collected;
  takeBack(*collected);
  return tl::unexpected(made.error());
}

/// Why cells that were not asked for are larger than usual; empty where they are not.
std::string largeCellsText(const LayoutSpec& spec) {
  if (spec.cellSize <= kLargestUsualCell) return {};
  return fmt::format(
      "{:g} m, since {:.3g} km2 are walkable; choose smaller ones with --cell and a smaller area with "
      "--outline",
      spec.cellSize, 1e-6 * spec.outline.area());
}

}  // namespace

Result<Report> runNew(const NewOptions& options, const Common& common) {
  std::error_code error;
  if (std::filesystem::exists(options.output, error) && !options.force)
    return fail(ErrorKind::invalidArgument,
                "exists already; give --force to replace it, or another name with -o",
                options.output.string());
  const auto configuration = parseConfiguration(options.configuration);
  if (!configuration) return tl::unexpected(configuration.error());

  NewProjectOptions choices;
  choices.configuration = *configuration;
  choices.cellSize = options.cellSize;
  choices.eyeHeight = options.eyeHeight;
  choices.outline = options.outline;
  choices.samplesPerDegree = options.samplesPerDegree;
  choices.import = importOptions(options.up, options.metresPerUnit, options.light);
  choices.ignoreSides = options.ignoreSides;
  if (options.storey == "list") {
    StoreyOptions storeys;
    storeys.walkable.eyeHeight = options.eyeHeight;
    storeys.walkable.ignoreSides = options.ignoreSides;
    const auto found =
        findFileStoreys(options.scene, choices.import, storeys, common.host, common.progress, common.stop);
    if (!found) return tl::unexpected(found.error());
    return storeysReport(*found);
  }
  choices.everyStorey = options.storey == "all";
  if (!options.storey.empty() && !choices.everyStorey) {
    const auto storey = parseStoreyChoice(options.storey);
    if (!storey) return tl::unexpected(storey.error());
    choices.storey = *storey;
  }
  const auto collected = makeAndSave(options, choices, common);
  if (!collected) return tl::unexpected(collected.error());
  const auto open = openProject(options.output, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  const auto storeys = acentric::openStoreys(*open, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  const Report model = collectReport(*collected);
  Report report;
  report.text = fmt::format("{}: {}\n", options.output.string(), trianglesText(*open->imported));
  report.text += model.text;
  Json json = Json::array();
  for (const OpenProject& storey : *storeys) {
    const LayoutSpec& spec = storey.layout->spec;
    json.push_back({{"name", storey.project.current().name},
                    {"configuration", nameOf(spec.configuration)},
                    {"cellSize", spec.cellSize},
                    {"floorHeight", spec.floorHeight},
                    {"walkableSquareMetres", spec.outline.area()},
                    {"regions", storey.layout->regions.size()},
                    {"cameras", storey.layout->cameras.size()}});
    report.text += fmt::format(
        "  {}: {:.1f} m2 walkable at z = {:.2f} m; configuration {} with {:g} m cells: {} regions, {} "
        "cameras\n",
        storey.project.current().name, spec.outline.area(), spec.floorHeight, nameOf(spec.configuration),
        spec.cellSize, storey.layout->regions.size(), storey.layout->cameras.size());
  }
  const std::string large = options.cellSize > 0 ? std::string() : largeCellsText(open->layout->spec);
  if (!large.empty()) report.text += fmt::format("  large cells: {}\n", large);
  const auto doubt = doubtScale(*open->rays, open->project.import);
  report.json = {{"project", options.output.string()},
                 {"model", model.json},
                 {"triangles", open->imported->shownTriangleCount()},
                 {"uniqueTriangles", open->imported->uniqueTriangleCount()},
                 {"instances", open->imported->instances.size()},
                 {"storey", open->project.current().name},
                 {"storeys", std::move(json)},
                 {"guessed", open->scene->report.guessed},
                 {"dropped", open->scene->report.dropped},
                 {"ignored", open->scene->report.ignored},
                 {"scaleInDoubt", scaleJson(doubt)}};
  if (!large.empty()) report.json["largeCells"] = large;
  if (const Status near = checkNear(open->near); !near) {
    report.text += fmt::format("  not to be baked as it is: {}\n", near.error().message);
    report.json["cannotBake"] = near.error().message;
  }
  for (const auto& [label, lines] : {std::pair{"guessed", &open->scene->report.guessed},
                                     std::pair{"dropped", &open->scene->report.dropped},
                                     std::pair{"ignored", &open->scene->report.ignored}})
    for (const std::string& line : *lines) report.text += fmt::format("  {}: {}\n", label, line);
  if (doubt)
    report.text +=
        fmt::format("  scale in doubt: {} (--metres-per-unit {:g})\n", doubt->text, doubt->metresPerUnit);
  report.text += fmt::format("next: acentric bake {}\n", options.output.string());
  return report;
}

}  // namespace acentric::cli
