#include <fmt/format.h>

#include <algorithm>

#include "engine/bake/effect_costs.h"
#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/geometry/conventions.h"
#include "engine/inspect/budgets.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

Json effectsJson(const EffectPlan& plan, const EffectCosts& costs) {
  Json out = Json::array();
  for (int i = 0; i < kEffectCount; ++i) {
    const EffectState& state = plan[Effect(i)];
    out.push_back({{"effect", nameOf(Effect(i))},
                   {"on", state.on},
                   {"calledFor", state.calledFor},
                   {"overridden", state.overridden},
                   {"shareOfBakeTime", costs.of(Effect(i))},
                   {"reason", state.reason}});
  }
  return out;
}

std::string effectsText(const EffectPlan& plan, const EffectCosts& costs) {
  std::string text = "effects  (share of a bake's tracing and shading, measured on pixels of all cameras)\n";
  for (int i = 0; i < kEffectCount; ++i) {
    const EffectState& state = plan[Effect(i)];
    const std::string share =
        state.on && costs.pixels > 0 ? fmt::format("{:.0f} %", 100 * costs.of(Effect(i))) : std::string();
    text += fmt::format("  {:<3} {:<26} {:>5}  {}{}\n", state.on ? "on" : "off", labelOf(Effect(i)), share,
                        state.reason, state.overridden ? " (overridden)" : "");
  }
  return text;
}

Json toJson(const Bookmark& bookmark, const Project& project) {
  return {{"name", bookmark.name},
          {"storey", project.storeys[std::size_t(bookmark.storey)].name},
          {"eye", cli::toJson(bookmark.eye)},
          {"yaw", degrees(bookmark.yawRadians)},
          {"pitch", degrees(bookmark.pitchRadians)},
          {"fov", bookmark.fovDegrees}};
}

Json toJson(const WalkPath& path, const Project& project) {
  return {{"name", path.name},
          {"storey", project.storeys[std::size_t(path.storey)].name},
          {"seconds", path.path.seconds()},
          {"poses", path.path.poses.size()}};
}

/// Bookmarks and paths, a line each.
std::string walksText(const Project& project) {
  const auto where = [&](int storey) {
    return project.storeys.size() > 1 ? ", " + project.storeys[std::size_t(storey)].name : std::string();
  };
  std::string text;
  for (const Bookmark& b : project.bookmarks)
    text += fmt::format(
        "bookmark {}: ({:.2f}, {:.2f}, {:.2f}) m, yaw {:.1f}°, pitch {:.1f}°, field of view {:g}°{}\n",
        b.name, b.eye.x, b.eye.y, b.eye.z, degrees(b.yawRadians), degrees(b.pitchRadians), b.fovDegrees,
        where(b.storey));
  for (const WalkPath& p : project.paths)
    text += fmt::format("path     {}: {:.1f} s, {} key poses{}\n", p.name, p.path.seconds(),
                        p.path.poses.size(), where(p.storey));
  return text;
}

}  // namespace

Result<Report> runInfo(const InfoOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const Scene &scene = *open->scene, &model = *open->imported;
  const Layout& layout = *open->layout;
  const auto baked = bakedCameras(*open);
  const auto bakedCount = std::count(baked.begin(), baked.end(), true);
  std::uint64_t bytes = 0;
  std::ptrdiff_t coarse = 0;
  std::error_code error;
  if (std::filesystem::is_directory(captureFolderFor(open->file), error))
    if (const auto store = CaptureStore::open(captureFolderFor(open->file))) {
      for (const ContentKey& key : open->keys) bytes += store->bytesOf(key);
      for (const auto& best : bestKeys(*open, *store)) coarse += best ? 1 : 0;
      coarse -= bakedCount;
    }
  const auto triangles = countLocalTriangles(scene, layout);
  const Spread budget = spreadOf(std::vector<double>(triangles.begin(), triangles.end()));
  const EffectCosts costs = measureEffectCosts(*open->rays, layout, open->project.bake);
  const double megapixels = megapixelsOf(*open);
  const glm::vec3 size = scene.bounds.size();

  const auto doubt = doubtScale(*open->rays, open->project.import);
  Report report;
  Json bookmarks = Json::array(), paths = Json::array();
  for (const Bookmark& bookmark : open->project.bookmarks)
    bookmarks.push_back(toJson(bookmark, open->project));
  for (const WalkPath& path : open->project.paths) paths.push_back(toJson(path, open->project));
  Json storeys = Json::array();
  for (const Storey& storey : open->project.storeys)
    storeys.push_back({{"name", storey.name},
                       {"floorHeight", storey.layout.floorHeight},
                       {"squareMetres", storey.layout.outline.area()}});
  report.json = {
      {"project", options.project.string()},
      {"storey", open->project.current().name},
      {"storeys", std::move(storeys)},
      {"bookmarks", std::move(bookmarks)},
      {"paths", std::move(paths)},
      {"scene",
       {{"file", open->project.scene.generic_string()},
        {"triangles", scene.shownTriangleCount()},
        {"uniqueTriangles", model.uniqueTriangleCount()},
        {"instances", model.instances.size()},
        {"nearInstances", open->near.instances},
        {"nearInstancedTriangles", open->near.triangles},
        {"meshes", model.meshes.size() + model.prototypes.size()},
        {"materials", scene.materials.size()},
        {"textures", scene.textures.size()},
        {"lights", scene.lights.size()},
        {"boundsMin", toJson(glm::dvec3(scene.bounds.min))},
        {"boundsMax", toJson(glm::dvec3(scene.bounds.max))},
        {"origin", toJson(scene.origin)},
        {"found", scene.report.found},
        {"dropped", scene.report.dropped},
        {"ignored", scene.report.ignored},
        {"guessed", scene.report.guessed},
        {"metresPerUnit", scene.report.metresPerUnit},
        {"scaleInDoubt", scaleJson(doubt)}}},
      {"effects", effectsJson(open->plan, costs)},
      {"layout",
       {{"configuration", nameOf(layout.spec.configuration)},
        {"description", describe(layout.spec.configuration)},
        {"cellSize", layout.spec.cellSize},
        {"eyeHeight", layout.spec.eyeHeight},
        {"nearBand", layout.spec.nearBand},
        {"regions", layout.regions.size()},
        {"cameras", layout.cameras.size()},
        {"megapixels", megapixels},
        {"localTriangles", {{"min", budget.min}, {"median", budget.median}, {"max", budget.max}}}}},
      {"bake", {{"baked", bakedCount}, {"coarse", coarse}, {"of", baked.size()}, {"bytes", bytes}}}};
  report.text = fmt::format(
      "scene    {}: {}, {} meshes, {} materials, {} textures, {} lights; {:.2f} x {:.2f} x {:.2f} "
      "m\n"
      "layout   {} ({}), cells of {:g} m, eye at {:g} m: {} regions, {} cameras, {:.1f} Mpixel\n"
      "local    {} / {} / {} triangles per region (least / median / most)\n"
      "baked    {} of {} cameras{}, {}\n",
      open->project.scene.generic_string(), trianglesText(model),
      model.meshes.size() + model.prototypes.size(), scene.materials.size(), scene.textures.size(),
      scene.lights.size(), size.x, size.y, size.z, nameOf(layout.spec.configuration),
      describe(layout.spec.configuration), layout.spec.cellSize, layout.spec.eyeHeight, layout.regions.size(),
      layout.cameras.size(), megapixels, countText(std::uint64_t(budget.min)),
      countText(std::uint64_t(budget.median)), countText(std::uint64_t(budget.max)), bakedCount, baked.size(),
      coarse > 0 ? fmt::format(" ({} more as previews or drafts)", coarse) : std::string(), bytesText(bytes));
  if (open->project.storeys.size() > 1)
    for (const Storey& storey : open->project.storeys)
      report.text += fmt::format("storey   {} {}: {:.2f} m, {:.1f} m2 walkable\n",
                                 storey == open->project.current() ? '>' : ' ', storey.name,
                                 storey.layout.floorHeight, storey.layout.outline.area());
  report.text += walksText(open->project);
  for (const auto& [label, lines] :
       {std::pair{"found", &scene.report.found}, std::pair{"guessed", &scene.report.guessed},
        std::pair{"dropped", &scene.report.dropped}, std::pair{"ignored", &scene.report.ignored}})
    for (const std::string& line : *lines) report.text += fmt::format("{:<8} {}\n", label, line);
  if (const Status near = checkNear(open->near); !near) {
    report.text += fmt::format("near     {}\n", near.error().message);
    report.json["cannotBake"] = near.error().message;
  } else if (open->near.any()) {
    report.text +=
        fmt::format("near     of {} instances {} triangles lie in regions or near, and are drawn\n",
                    open->near.instances, countText(open->near.triangles));
  }
  if (doubt) report.text += fmt::format("{:<8} {}\n", "scale", doubt->text);
  report.text += effectsText(open->plan, costs);

  if (options.regions) {
    Json regions = Json::array();
    for (std::size_t r = 0; r < layout.regions.size(); ++r) {
      const Region& region = layout.regions[r];
      Json json = toJson(region);
      json["localTriangles"] = triangles[r];
      regions.push_back(std::move(json));
      report.text +=
          fmt::format("region   {}: {} local triangles\n", placeText(region), countText(triangles[r]));
    }
    report.json["regions"] = std::move(regions);
  }
  return report;
}

}  // namespace acentric::cli
