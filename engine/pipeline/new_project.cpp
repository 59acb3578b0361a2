#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/inspect/lattice_shift.h"
#include "engine/inspect/walkable_outline.h"
#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/collect_model.h"
#include "engine/pipeline/first_cell.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/scene_probe.h"
#include "engine/pipeline/scene_scale.h"
#include "engine/pipeline/stair_storeys.h"
#include "engine/pipeline/start_view.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

double roundTo(double value, double step) { return std::round(value / step) * step; }

/// Three significant decimals: a value that a person can read and change.
float tidy(float value) { return std::stof(fmt::format("{:.3g}", value)); }

glm::dvec2 middleOf(const Outline& outline) {
  const auto [low, high] = extentOf(outline);
  return 0.5 * (low + high);
}

/// The walk planes that the options ask for, the largest first.
Result<Storeys> chosenPlanes(const RayScene& rays, const NewProjectOptions& options,
                             const WalkableOptions& walkable) {
  if (options.outline != "auto")
    return fail(ErrorKind::invalidArgument, "give either a storey or an outline, not both", options.outline);
  StoreyOptions storeys;
  storeys.walkable = walkable;
  if (options.storey.height) storeys.leastShare = 0;
  auto found = findSceneStoreys(rays, storeys);
  if (!found || options.everyStorey) return found;
  auto chosen = chooseStorey(*found, options.storey);
  if (!chosen) return tl::unexpected(chosen.error());
  return Storeys{{std::move(*chosen)}, {}, {}, found->ignoredSides};
}

Result<WalkableArea> walkableArea(const Scene& scene, const RayScene& rays, const NewProjectOptions& options,
                                  const WalkableOptions& walkable) {
  if (options.outline == "auto") return findWalkableArea(scene.bounds, walkable, probeFor(rays));
  const auto outline = parseOutline(options.outline);
  if (!outline) return tl::unexpected(outline.error());
  // A drawn outline needs only its floor. A scene without a walkable one there then stands on its lowest
  // point.
  const auto [low, high] = extentOf(*outline);
  Bounds within = scene.bounds;
  within.min = glm::max(within.min, glm::vec3(glm::vec2(low), within.min.z));
  within.max = glm::min(within.max, glm::vec3(glm::vec2(high), within.max.z));
  if (within.empty() || within.min.y > within.max.y)
    return fail(ErrorKind::invalidArgument, "the outline lies outside the scene", options.outline);
  const auto area = findWalkableArea(within, walkable, probeFor(rays));
  return WalkableArea{area ? area->floorHeight : double(scene.bounds.min.z), *outline};
}

WalkableOptions walkableFor(const NewProjectOptions& options) {
  WalkableOptions walkable;
  walkable.eyeHeight = options.eyeHeight;
  walkable.ignoreSides = options.ignoreSides;
  return walkable;
}

/// Walk planes to lay cells on, at least one. Of a single one without a choice only height and outline count.
Result<Storeys> planesFor(const Scene& scene, const RayScene& rays, const NewProjectOptions& options) {
  const WalkableOptions walkable = walkableFor(options);
  if (options.storey.given() || options.everyStorey) return chosenPlanes(rays, options, walkable);
  auto area = walkableArea(scene, rays, options, walkable);
  if (!area) return tl::unexpected(area.error());
  WalkPlane plane;
  plane.height = area->floorHeight;
  plane.outline = std::move(area->outline);
  return Storeys{{std::move(plane)}, {}, {}, area->ignoredSides};
}

std::vector<glm::dvec3> sampleEyes(const Layout& layout, std::size_t most) {
  std::vector<glm::dvec3> eyes;
  const std::size_t step = std::max<std::size_t>(1, layout.regions.size() / most);
  for (std::size_t i = 0; i < layout.regions.size() && eyes.size() < most; i += step) {
    const glm::dvec2 centre = layout.regions[i].polygon.centroid();
    if (layout.spec.outline.contains(centre)) eyes.emplace_back(centre, layout.eyeZ());
  }
  if (eyes.empty()) eyes.emplace_back(layout.regions.front().polygon.centroid(), layout.eyeZ());
  return eyes;
}

/// Lays `pattern`'s cells on a walk plane.
Result<Storey> storeyFor(const LayoutSpec& pattern, const WalkPlane& plane, std::string name,
                         bool ignoredSides, const FirstLayoutLimit& limit, const RayScene& rays,
                         std::stop_token stop) {
  Storey storey{std::move(name), pattern, {}, {}};
  LayoutSpec& spec = storey.layout;
  spec.outline = tidied(plane.outline);
  spec.floorHeight = roundTo(plane.height, 1e-4) + 0.0;  // never -0
  const glm::dvec2 middle = middleOf(spec.outline);
  spec.latticeOrigin = {roundTo(middle.x, 0.01), roundTo(middle.y, 0.01)};
  if (exceeds(spec, limit)) {
    auto kept = keepWithin(spec, limit, rays.scene().bounds, ignoredSides, probeFor(rays), stop);
    if (!kept) return tl::unexpected(kept.error());
    if (kept->outline != spec.outline) storey.walkable = std::move(spec.outline);
    spec = std::move(*kept);
  } else {
    if (Status sound = spec.check(); !sound) return tl::unexpected(sound.error());
    ShiftOptions shift;
    shift.crowding.trustSides = !ignoredSides;
    spec.latticeOrigin = findFreestOrigin(spec, shift, probeFor(rays), stop).origin;
  }
  const auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  if (layout->regions.empty())
    return fail(ErrorKind::invalidArgument,
                "no region fits the outline; draw a larger one or choose smaller cells");
  storey.spawn = chooseStart(*layout, rays);
  return storey;
}

/// Its share of all the cameras.
FirstLayoutLimit limitFor(const WalkPlane& plane, const Storeys& planes, const NewProjectOptions& options) {
  double all = 0;
  for (const WalkPlane& each : planes.planes) all += each.outline.area();
  FirstLayoutLimit limit;
  if (options.outline != "auto") return limit;
  limit.cameras = std::size_t(std::ceil(double(options.mostCameras) * plane.outline.area() / all));
  limit.around = options.around;
  limit.chooseCell = options.cellSize <= 0;
  limit.chooseConfiguration = !options.configuration;
  return limit;
}

}  // namespace

Result<OpenProject> makeProject(const fs::path& sceneFile, const fs::path& projectFile,
                                const NewProjectOptions& options, const ImportHost& host, TaskRunner& runner,
                                const Progress& progress, std::stop_token stop) {
  if (!(options.eyeHeight > 0 && options.eyeHeight <= 1000))
    return fail(ErrorKind::invalidArgument, "eye height must lie in (0, 1000] metres");
  if (options.outline != "auto" && options.around)
    return fail(ErrorKind::invalidArgument, "give either an outline or a place to lay out around, not both",
                options.outline);
  if (options.stairs && !options.everyStorey)
    return fail(ErrorKind::invalidArgument,
                "stairs join storeys: lay cells on all of them with --storey all, or add stairs to a project "
                "with acentric storeys PROJECT --add-stairs all");
  std::error_code error;
  if (!fs::exists(sceneFile, error))
    return fail(ErrorKind::notFound, "no such model file", sceneFile.string());

  Project project;
  project.import = options.import;
  const auto stated = scenePathFor(sceneFile, projectFile);
  if (!stated) return tl::unexpected(stated.error());
  project.scene = *stated;

  const auto scene = importScene(sceneFile, options.import, host, progress, stop);
  if (!scene) return tl::unexpected(scene.error());
  OpenProject bare;  // without a layout
  bare.file = projectFile, bare.project = project;
  bare.imported = bare.scene = *scene;
  bare.plan = planEffects(**scene);
  const auto rays = RayScene::build(*scene, bare.plan);
  if (!rays) return tl::unexpected(rays.error());

  if (progress) progress({0, 0, "finding the walkable area"});
  const auto planes = planesFor(**scene, **rays, options);
  if (!planes) return tl::unexpected(planes.error());
  const auto largest =
      std::ranges::max_element(planes->planes, {}, [](const WalkPlane& p) { return p.outline.area(); });

  LayoutSpec pattern;
  pattern.configuration = options.configuration.value_or(Configuration::b);
  pattern.eyeHeight = options.eyeHeight;
  pattern.cellSize =
      options.cellSize > 0 ? options.cellSize : firstCellSize(largest->outline.area(), pattern.configuration);
  if (options.samplesPerDegree > 0) project.bake.samplesPerDegree = options.samplesPerDegree;
  project.storeys.clear();
  std::vector<glm::dvec3> eyes;
  for (std::size_t s = 0; s < planes->planes.size(); ++s) {
    if (progress) progress({double(s), double(planes->planes.size()), "placing the cells"});
    auto storey = storeyFor(
        pattern, planes->planes[s], planes->planes.size() == 1 ? "floor" : fmt::format("storey {}", s),
        planes->ignoredSides, limitFor(planes->planes[s], *planes, options), **rays, stop);
    if (!storey) {
      Error failure = storey.error();
      failure.where = sceneFile.string();
      if (const auto doubt = doubtScale(**rays, options.import))
        failure.message += fmt::format(". {} (--metres-per-unit {:g})", doubt->text, doubt->metresPerUnit);
      return tl::unexpected(std::move(failure));
    }
    if (&planes->planes[s] == &*largest) project.storey = int(s);
    project.storeys.push_back(std::move(*storey));
  }

  if (options.stairs) {
    StairRequest request;
    request.walkable = walkableFor(options);
    auto added = addStairs(project, **rays, *planes, request, progress, stop);
    if (!added) return tl::unexpected(added.error());
  }

  if (progress) progress({0, 0, "estimating the exposure"});
  const auto layout = buildLayout(project.layout());
  if (!layout) return tl::unexpected(layout.error());
  project.exposure = tidy(estimateExposure(**rays, sampleEyes(*layout, 8), project.bake, runner));
  bare.rays = *rays, bare.mirrors = flatMirrorsOf(**scene, bare.plan);
  return reopenProject(bare, project, host, progress, stop);
}

Result<Storey> makeStorey(const OpenProject& open, const WalkPlane& plane, std::string name,
                          bool ignoredSides, std::stop_token stop) {
  LayoutSpec pattern;
  // Cells of stairs are as large as suits these.
  const auto& storeys = open.project.storeys;
  const auto level = std::ranges::find_if_not(storeys, isStairs);
  const bool onStairs = isStairs(open.project.current()) && level != storeys.end();
  const LayoutSpec& like = onStairs ? level->layout : open.project.layout();
  pattern.configuration = like.configuration;
  pattern.cellSize = like.cellSize;
  pattern.eyeHeight = like.eyeHeight;
  pattern.nearBand = like.nearBand;
  FirstLayoutLimit limit;
  limit.cameras = kUsualMostCameras;
  limit.chooseCell = false;
  return storeyFor(pattern, plane, std::move(name), ignoredSides, limit, *open.rays, stop);
}

}  // namespace acentric
