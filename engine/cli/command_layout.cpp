#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/lattice_fit.h"
#include "engine/inspect/placement_checks.h"
#include "engine/picture/layout_picture.h"
#include "engine/pipeline/scene_probe.h"
#include "engine/pipeline/scene_storeys.h"

namespace acentric::cli {
namespace {

/// Mean distance from a centre of projection to the nearest other one, metres; 0 for fewer than two.
double meanSpacing(const std::vector<CameraCentre>& centres) {
  if (centres.size() < 2) return 0;
  const auto nearestFrom = [&](std::size_t c) {  // centres are in order of x
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec2& at = centres[c].position;
    for (std::size_t k = c; k-- > 0 && at.x - centres[k].position.x < nearest;)
      nearest = std::min(nearest, glm::distance(at, centres[k].position));
    for (std::size_t k = c + 1; k < centres.size() && centres[k].position.x - at.x < nearest; ++k)
      nearest = std::min(nearest, glm::distance(at, centres[k].position));
    return nearest;
  };
  double sum = 0;
  for (std::size_t c = 0; c < centres.size(); ++c) sum += nearestFrom(c);
  return sum / double(centres.size());
}

struct KindCount {
  RegionKind kind;
  std::size_t regions = 0;
  double area = 0;
};

std::vector<KindCount> countKinds(const Layout& layout) {
  std::vector<KindCount> kinds;
  for (const RegionKind kind :
       {RegionKind::ring, RegionKind::gapTriangle, RegionKind::gapSquare, RegionKind::gapHexagon})
    kinds.push_back({kind});
  for (const Region& region : layout.regions)
    for (KindCount& count : kinds)
      if (count.kind == region.kind) ++count.regions, count.area += region.polygon.area();
  std::erase_if(kinds, [](const KindCount& count) { return count.regions == 0; });
  return kinds;
}

Report describeLayout(const OpenProject& open) {
  const Layout& layout = *open.layout;
  const LayoutSpec& spec = layout.spec;
  const std::vector<CameraCentre> centres = centresOf(layout);
  const double spacing = meanSpacing(centres), megapixels = megapixelsOf(open);
  const double outlineArea = spec.outline.empty() ? 0 : spec.outline.area();
  const std::vector<bool> baked = bakedCameras(open);
  const auto bakedCount = std::ranges::count(baked, true);
  const double samplesPerDegree = open.project.bake.samplesPerDegree;

  Report report;
  report.text = fmt::format(
      "layout   {} ({}), cells of {:g} m at ({:g}, {:g}) m turned by {:g} degrees; floor at {:g} m, eye {:g} "
      "m "
      "above\n",
      nameOf(spec.configuration), describe(spec.configuration), spec.cellSize, spec.latticeOrigin.x,
      spec.latticeOrigin.y, degrees(spec.rotationRadians), spec.floorHeight, spec.eyeHeight);
  Json kinds = Json::object();
  double area = 0;
  for (const KindCount& count : countKinds(layout)) {
    area += count.area;
    kinds[nameOf(count.kind)] = {{"regions", count.regions}, {"squareMetres", count.area}};
    report.text += fmt::format("regions  {:>7} {:<11} {:.1f} m2\n", countText(count.regions),
                               nameOf(count.kind), count.area);
  }
  report.text += fmt::format(
      "area     {:.1f} m2 in regions, {:.1f} m2 in the outline\n"
      "cameras  {} at {} centres of projection, {:.2f} m apart in the mean; {:.1f} Mpixel at {:g} samples "
      "per "
      "degree\n",
      area, outlineArea, countText(layout.cameras.size()), countText(centres.size()), spacing, megapixels,
      samplesPerDegree);
  if (!spec.freeApvs.empty() || !spec.split.empty() || !spec.added.empty() || !spec.removed.empty() ||
      !spec.density.empty())
    report.text += fmt::format(
        "single   {} cells added, {} removed, {} split, {} of another density, {} free APVs\n",
        spec.added.size(), spec.removed.size(), spec.split.size(), spec.density.size(), spec.freeApvs.size());
  report.text += fmt::format("baked    {} of {} cameras\n", bakedCount, baked.size());
  report.json = {{"configuration", nameOf(spec.configuration)},
                 {"description", describe(spec.configuration)},
                 {"cellSize", spec.cellSize},
                 {"latticeOrigin", {spec.latticeOrigin.x, spec.latticeOrigin.y}},
                 {"rotationDegrees", degrees(spec.rotationRadians)},
                 {"floorHeight", spec.floorHeight},
                 {"eyeHeight", spec.eyeHeight},
                 {"nearBand", spec.nearBand},
                 {"regions", layout.regions.size()},
                 {"kinds", std::move(kinds)},
                 {"squareMetres", {{"regions", area}, {"outline", outlineArea}}},
                 {"cameras", layout.cameras.size()},
                 {"centres", centres.size()},
                 {"meanSpacing", spacing},
                 {"megapixels", megapixels},
                 {"samplesPerDegree", samplesPerDegree},
                 {"added", spec.added.size()},
                 {"removed", spec.removed.size()},
                 {"split", spec.split.size()},
                 {"density", spec.density.size()},
                 {"freeApvs", spec.freeApvs.size()},
                 {"baked", bakedCount}};
  return report;
}

Result<Project> editProject(const OpenProject& open, const LayoutOptions& options, const Common& common,
                            std::vector<std::string>& notes) {
  Project project = open.project;
  auto edited = applyEdits(project.layout(), options.edits);
  if (!edited) return tl::unexpected(edited.error());
  project.layout() = std::move(edited->spec);
  notes = std::move(edited->notes);
  if (options.outline == "auto") {
    auto outline = findOutlineAt(*open.rays, project.layout().floorHeight, project.layout().eyeHeight);
    if (!outline) return tl::unexpected(outline.error());
    project.layout().outline = std::move(*outline);
    project.current().walkable = {};  // all of it is laid out now
  } else if (!options.outline.empty()) {
    auto outline = parseOutline(options.outline);
    if (!outline) return tl::unexpected(outline.error());
    project.layout().outline = std::move(*outline);
  }
  if (options.fit) {
    const auto before = buildLayout(project.layout());
    if (!before) return tl::unexpected(before.error());
    const SurfaceProbe probe = probeFor(*open.rays);
    const auto placement =
        checkPlacement(*before, open.scene->bounds, {}, probe, *common.runner(), common.stop);
    if (!placement) return tl::unexpected(placement.error());
    LatticeFitOptions fitting;
    fitting.shift.crowding.trustSides = !placement->ignoredSides;
    const LatticeFit fit = fitLattice(project.layout(), fitting, probe, common.stop);
    notes.push_back(fmt::format("fitted: {:.1f} % of the floor lies in cells, {} cells are left out",
                                100 * fit.served, fit.spec.removed.size()));
    project.layout() = fit.spec;
  }
  return project;
}

}  // namespace

Result<Report> runLayout(const LayoutOptions& options, const Common& common) {
  auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  std::vector<std::string> notes;
  const auto project = editProject(*open, options, common, notes);
  if (!project) return tl::unexpected(project.error());
  const bool changed = *project != open->project;
  if (changed) {
    open = reopenProject(*open, *project, common.host, common.progress, common.stop);
    if (!open) return tl::unexpected(open.error());
  }
  if (open->layout->regions.empty())
    return fail(ErrorKind::invalidArgument,
                "no region is left; draw a larger outline, choose smaller cells or add single cells",
                options.project.string());
  Report report = describeLayout(*open);
  report.json["project"] = options.project.string();
  report.json["notes"] = notes;
  for (const std::string& note : notes) report.text += fmt::format("note     {}\n", note);
  if (!options.output.empty()) {
    if (Status written =
            writePlanPicture(pictureOf(*open->layout, open->scene->name + ": layout"), options.output);
        !written)
      return tl::unexpected(written.error());
    report.json["picture"] = options.output.string();
    report.text += fmt::format("wrote {}\n", options.output.string());
  }
  report.json["changed"] = changed;
  report.json["applied"] = changed && options.apply;
  if (changed && options.apply) {
    if (Status saved = saveEdited(*project, options.project); !saved) return tl::unexpected(saved.error());
    report.text += fmt::format("changed {}\n", options.project.string());
  } else if (changed) {
    report.text += "not written: --apply changes the project\n";
  }
  return report;
}

}  // namespace acentric::cli
