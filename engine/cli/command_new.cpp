#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/pipeline/first_cell.h"
#include "engine/pipeline/new_project.h"
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

struct MadeProject {
  CollectedModel model;
  NewProject project;
};

Result<MadeProject> makeAndSave(const NewOptions& options, const NewProjectOptions& choices,
                                const Common& common) {
  auto collected =
      collectModel(options.scene, options.output, choices.import,
                   options.link ? Collect::link : Collect::files, common.host, common.progress, common.stop);
  if (!collected) return tl::unexpected(collected.error());
  const auto runner = common.runner();
  auto project = makeProject(options.output.parent_path() / collected->scene, options.output, choices,
                             common.host, *runner, common.progress, common.stop);
  Status made;
  if (!project)
    made = tl::unexpected(project.error());
  else if (made = saveProject(project->open.project, options.output); made)
    made = mustExist(options.output);
  if (made) return MadeProject{std::move(*collected), std::move(*project)};
  takeBack(*collected);
  return tl::unexpected(made.error());
}

/// Why cells that were not asked for are larger than usual; empty where they are not.
std::string largeCellsText(const LayoutSpec& spec) {
  if (spec.cellSize <= kLargestUsualCell || !spec.split.empty()) return {};
  return fmt::format(
      "{:g} m, since {:.3g} km2 are walkable; choose smaller ones with --cell and a smaller area with "
      "--outline",
      spec.cellSize, 1e-6 * spec.outline.area());
}

std::string areaText(double squareMetres) {
  return squareMetres < 1e5 ? fmt::format("{:.0f} m2", squareMetres)
                            : fmt::format("{:.3g} km2", 1e-6 * squareMetres);
}

/// What of the ground is not laid out, and how to have it; empty where all is.
std::string leftOutText(const Storey& storey, const NewOptions& options, LimitedBy limit) {
  if (storey.walkable.empty()) return {};
  const double laid = storey.layout.outline.area(), all = storey.walkable.area();
  std::string why =
      fmt::format("since {} cameras are the limit; more with --max-cameras", countText(options.mostCameras));
  if (limit == LimitedBy::minutes)
    why = fmt::format("as much as bakes in about {:g} minutes here{}; more with --bake-minutes",
                      options.bakeMinutes, options.storey == "all" ? ", or a few cells of each storey" : "");
  if (limit == LimitedBy::unknown)
    why = fmt::format("since it was not known within {:g} s what baking takes; more with --bake-minutes 0",
                      kPlanningSeconds);
  return fmt::format(
      "only {} of {} that can be walked, around ({:.0f}, {:.0f}), {}, another part with --around x,y, or one "
      "of your own with --outline",
      areaText(laid), areaText(all), storey.spawn.position.x, storey.spawn.position.y, why);
}

/// "12 to 6 m" where cells are of several sizes.
std::string cellsText(const Layout& layout) {
  const auto [largest, finest] =
      std::ranges::minmax_element(layout.regions, {}, [](const Region& region) { return region.id.level; });
  const auto edge = [&](const Region& region) { return std::ldexp(layout.spec.cellSize, -region.id.level); };
  if (largest->id.level == finest->id.level) return fmt::format("{:g} m", edge(*largest));
  return fmt::format("{:g} to {:g} m", edge(*largest), edge(*finest));
}

/// What the first bake will take, at a glance. `known`: what is predicted already.
Status addPlan(const std::vector<OpenProject>& storeys, const std::optional<Result<BakeForecast>>& known,
               const std::filesystem::path& project, const Common& common, Report& report) {
  std::size_t cameras = 0;
  double megapixels = 0;
  for (const OpenProject& storey : storeys)
    cameras += storey.layout->cameras.size(), megapixels += megapixelsOf(storey);
  report.json["plan"] = {{"cameras", cameras}, {"megapixels", megapixels}};
  const auto runner = common.runner();
  const auto plan =
      known ? *known : glanceAtBake(storeys, kPlanningSeconds, *runner, common.progress, common.stop);
  if (common.stop.stop_requested())
    return fail(ErrorKind::cancelled, "stopped; the project is made", project.string());
  if (plan) report.json["plan"].update(cli::toJson(*plan));
  std::string text;
  if (plan)
    text = describe(*plan);
  else
    text = fmt::format("{} cameras, {:.0f} Mpixel to bake; acentric estimate {} tells what that takes ({})",
                       countText(cameras), megapixels, project.string(),
                       plan.error().kind == ErrorKind::cancelled
                           ? fmt::format("it is not known within {:g} s", kPlanningSeconds)
                           : plan.error().describe());
  report.text += fmt::format("plan: {}\n", text);
  return {};
}

}  // namespace

Result<Report> runNew(const NewOptions& options, const Common& common) {
  std::error_code error;
  if (std::filesystem::exists(options.output, error) && !options.force)
    return fail(ErrorKind::invalidArgument,
                "exists already; give --force to replace it, or another name with -o",
                options.output.string());
  NewProjectOptions choices;
  if (options.configuration != "auto") {
    const auto configuration = parseConfiguration(options.configuration);
    if (!configuration) return tl::unexpected(configuration.error());
    choices.configuration = *configuration;
  }
  choices.mostCameras = options.mostCameras;
  choices.bakeMinutes = options.estimate ? options.bakeMinutes : 0;
  if (!options.around.empty()) {
    const auto around = parsePoint(options.around);
    if (!around) return tl::unexpected(around.error());
    choices.around = *around;
  }
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
  choices.stairs = options.stairs;
  if (!options.storey.empty() && !choices.everyStorey) {
    const auto storey = parseStoreyChoice(options.storey);
    if (!storey) return tl::unexpected(storey.error());
    choices.storey = *storey;
  }
  const auto made = makeAndSave(options, choices, common);
  if (!made) return tl::unexpected(made.error());
  const OpenProject* open = &made->project.open;
  const LimitedBy limitedBy = made->project.limitedBy;
  const auto& plan = made->project.plan;
  const auto storeys = acentric::openStoreys(*open, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  const Report model = collectReport(made->model);
  Report report;
  report.text = fmt::format("{}: {}\n", options.output.string(), trianglesText(*open->imported));
  report.text += model.text;
  Json json = Json::array();
  for (const OpenProject& storey : *storeys) {
    const LayoutSpec& spec = storey.layout->spec;
    json.push_back(
        {{"name", storey.project.current().name},
         {"configuration", nameOf(spec.configuration)},
         {"cellSize", spec.cellSize},
         {"floorHeight", spec.floorHeight},
         {"walkableSquareMetres",
          (storey.project.current().walkable.empty() ? spec.outline : storey.project.current().walkable)
              .area()},
         {"laidOutSquareMetres", spec.outline.area()},
         {"regions", storey.layout->regions.size()},
         {"cameras", storey.layout->cameras.size()}});
    report.text += fmt::format(
        "  {}: {:.1f} m2 walkable at z = {:.2f} m; configuration {} with cells of {}: {} regions, {} "
        "cameras\n",
        storey.project.current().name, spec.outline.area(), spec.floorHeight, nameOf(spec.configuration),
        cellsText(*storey.layout), storey.layout->regions.size(), storey.layout->cameras.size());
    if (const std::size_t bare = spec.removed.size(); bare > 0 && storey.project.current().walkable.empty())
      report.text += fmt::format("  left out: {} cell{} with hardly any floor\n", bare, bare == 1 ? "" : "s");
    const std::string leftOut = leftOutText(storey.project.current(), options, limitedBy);
    if (!leftOut.empty()) {
      json.back()["leftOut"] = leftOut;
      report.text += fmt::format("  laid out: {}\n", leftOut);
    }
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
                 {"mostCameras", options.mostCameras},
                 {"bakeMinutes", choices.bakeMinutes},
                 {"limitedBy", nameOf(limitedBy)},
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
  if (options.estimate)
    if (Status planned = addPlan(*storeys, plan, options.output, common, report); !planned)
      return tl::unexpected(planned.error());
  report.text += fmt::format("next: acentric bake {}\n", options.output.string());
  return report;
}

}  // namespace acentric::cli
