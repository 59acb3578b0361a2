#include "engine/pipeline/new_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "engine/base/stopwatch.h"
#include "engine/geometry/round_to.h"
#include "engine/inspect/lattice_fit.h"
#include "engine/inspect/walkable_outline.h"
#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/collect_model.h"
#include "engine/pipeline/first_cell.h"
#include "engine/pipeline/scene_probe.h"
#include "engine/pipeline/scene_scale.h"
#include "engine/pipeline/stair_storeys.h"
#include "engine/pipeline/start_view.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

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

WalkableOptions walkableFor(const NewProjectOptions& options, TaskRunner& runner) {
  WalkableOptions walkable;
  walkable.runner = &runner;
  walkable.eyeHeight = options.eyeHeight;
  walkable.ignoreSides = options.ignoreSides;
  return walkable;
}

/// Walk planes to lay cells on, at least one. Of a single one without a choice only height and outline count.
Result<Storeys> planesFor(const Scene& scene, const RayScene& rays, const NewProjectOptions& options,
                          TaskRunner& runner) {
  const WalkableOptions walkable = walkableFor(options, runner);
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
  const SurfaceProbe probe = probeFor(rays);
  bool fitted = false;
  if (exceeds(spec, limit)) {
    auto kept = keepWithin(spec, limit, rays.scene().bounds, ignoredSides, probe, stop);
    if (!kept) return tl::unexpected(kept.error());
    fitted = kept->outline != spec.outline;
    if (fitted) storey.walkable = std::move(spec.outline);
    spec = std::move(*kept);
  }
  if (!fitted) {
    if (Status sound = spec.check(); !sound) return tl::unexpected(sound.error());
    LatticeFitOptions fit;
    fit.shift.crowding.trustSides = !ignoredSides;
    if (limit.fit)
      spec = fitLattice(spec, fit, probe, stop).spec;
    else
      spec.latticeOrigin = findFreestOrigin(spec, fit.shift, probe, stop).origin;
  }
  const auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  if (layout->regions.empty())
    return fail(ErrorKind::invalidArgument,
                "no region fits the outline; draw a larger one or choose smaller cells");
  storey.spawn = chooseStart(*layout, rays);
  return storey;
}

/// What each storey may have however small its share is, or little time there is: a region or so of it. All
/// of them keep to the most cameras that are asked for.
std::size_t fewestFor(std::size_t storeys, const NewProjectOptions& options) {
  if (storeys == 1) return 0;
  const std::size_t usual = kFewestCameras / 2;
  return options.mostCameras > 0 ? std::min(usual, options.mostCameras / storeys) : usual;
}

/// Its share of all the cameras: the fewest of each, and of the rest by its area.
FirstLayoutLimit limitFor(const WalkPlane& plane, const Storeys& planes, const NewProjectOptions& options,
                          const LayoutSpec& pattern, std::size_t mostCameras) {
  double all = 0;
  for (const WalkPlane& each : planes.planes) all += each.outline.area();
  FirstLayoutLimit limit;
  limit.fit = options.outline == "auto";  // what was drawn is laid out as drawn
  if (!limit.fit) return limit;
  if (mostCameras > 0) {
    const std::size_t fewest = fewestFor(planes.planes.size(), options);
    const double rest = std::max(0.0, double(mostCameras) - double(fewest * planes.planes.size()));
    limit.cameras = fewest + std::size_t(std::ceil(rest * plane.outline.area() / all));
  }
  limit.around = options.around;
  // Cells that are small since there is little ground suit it.
  limit.chooseCell = options.cellSize <= 0 && pattern.cellSize >= kLargestUsualCell;
  limit.chooseConfiguration = !options.configuration;
  return limit;
}

/// Lays out the storeys of a new project, once or more.
class Maker {
 public:
  /// `bare`: the model, opened, without a layout; `model`: the file, which errors name.
  Maker(OpenProject bare, fs::path model, Storeys planes, const NewProjectOptions& options,
        const ImportHost& host, TaskRunner& runner, const Progress& progress, std::stop_token stop)
      : bare_(std::move(bare)),
        model_(std::move(model)),
        project_(bare_.project),
        planes_(std::move(planes)),
        options_(options),
        host_(host),
        runner_(runner),
        progress_(progress),
        stop_(std::move(stop)) {
    largest_ = std::size_t(
        std::ranges::max_element(planes_.planes, {}, [](const WalkPlane& p) { return p.outline.area(); }) -
        planes_.planes.begin());
    pattern_.configuration = options.configuration.value_or(Configuration::b);
    pattern_.eyeHeight = options.eyeHeight;
    pattern_.cellSize = options.cellSize > 0
                            ? options.cellSize
                            : firstCellSize(planes_.planes[largest_].outline.area(), pattern_.configuration);
    if (options.samplesPerDegree > 0) project_.bake.samplesPerDegree = options.samplesPerDegree;
  }

  Result<NewProject> make() {
    BakeLimit limit;
    limit.seconds = options_.outline == "auto" ? 60 * options_.bakeMinutes : 0;
    limit.mostCameras = options_.mostCameras;
    limit.layOut = [this](std::size_t mostCameras) { return layOut(mostCameras); };
    limit.predict = [this]() { return predict(); };
    const auto limitedBy = layOutWithin(limit);
    if (!limitedBy) return tl::unexpected(limitedBy.error());
    if (options_.stairs) {
      StairRequest request;
      request.walkable = walkableFor(options_, runner_);
      auto added = addStairs(project_, *bare_.rays, planes_, request, progress_, stop_);
      if (!added) return tl::unexpected(added.error());
      plan_.reset();
    }
    if (progress_) progress_({0, 0, "estimating the exposure"});
    const auto layout = buildLayout(project_.layout());
    if (!layout) return tl::unexpected(layout.error());
    project_.exposure = tidy(estimateExposure(*bare_.rays, sampleEyes(*layout, 8), project_.bake, runner_));
    if (Status opened = open(); !opened) return tl::unexpected(opened.error());
    if (plan_ && *plan_ && planned_ != cameras_) plan_ = (*plan_)->ofSoManyCameras(int(cameras_));
    return NewProject{std::move(*open_), *limitedBy, std::move(plan_)};
  }

 private:
  Result<LaidOut> layOut(std::size_t mostCameras) {
    project_.storeys.clear();
    cameras_ = 0;
    bool whole = true;
    for (std::size_t s = 0; s < planes_.planes.size(); ++s) {
      const WalkPlane& plane = planes_.planes[s];
      if (progress_) progress_({double(s), double(planes_.planes.size()), "placing the cells"});
      auto storey =
          storeyFor(pattern_, plane, planes_.planes.size() == 1 ? "floor" : fmt::format("storey {}", s),
                    planes_.ignoredSides, limitFor(plane, planes_, options_, pattern_, mostCameras),
                    *bare_.rays, stop_);
      if (!storey) return tl::unexpected(scaleMayBe(storey.error()));
      if (s == largest_) project_.storey = int(s);
      const auto layout = buildLayout(storey->layout);
      if (!layout) return tl::unexpected(layout.error());
      cameras_ += layout->cameras.size();
      whole = whole && storey->walkable.empty();
      project_.storeys.push_back(std::move(*storey));
    }
    return LaidOut{cameras_, whole};
  }

  /// Of what was laid out last. All that is asked has kPlanningSeconds together.
  std::optional<double> predict() {
    const double left = kPlanningSeconds - predicting_;
    if (!(left > 0) || !open()) return std::nullopt;
    const Stopwatch watch;
    const auto storeys = acentric::openStoreys(*open_, host_, progress_, stop_);
    if (!storeys) return std::nullopt;
    auto plan = glanceAtBake(*storeys, left, runner_, progress_, stop_);
    predicting_ += watch.seconds();
    const bool known = plan.has_value();
    if (known) planned_ = cameras_;
    if (known || !plan_) plan_ = std::move(plan);
    return known ? std::optional((*plan_)->seconds()) : std::nullopt;
  }

  /// The project as it is laid out now.
  Status open() {
    auto opened = reopenProject(open_ ? *open_ : bare_, project_, host_, progress_, stop_);
    if (!opened) return tl::unexpected(opened.error());
    open_ = std::move(*opened);
    return {};
  }

  /// What cannot be laid out may be of another scale than it seems.
  Error scaleMayBe(Error failure) const {
    failure.where = model_.string();
    if (const auto doubt = doubtScale(*bare_.rays, options_.import))
      failure.message += fmt::format(". {} (--metres-per-unit {:g})", doubt->text, doubt->metresPerUnit);
    return failure;
  }

  const OpenProject bare_;
  const fs::path model_;
  Project project_;
  std::optional<OpenProject> open_;
  Storeys planes_;
  const NewProjectOptions& options_;
  const ImportHost& host_;
  TaskRunner& runner_;
  const Progress& progress_;
  std::stop_token stop_;
  std::size_t largest_ = 0;  ///< of the planes
  LayoutSpec pattern_;
  std::size_t cameras_ = 0;  ///< laid out
  double predicting_ = 0;    ///< seconds
  std::optional<Result<BakeForecast>> plan_;
  std::size_t planned_ = 0;  ///< cameras of `plan_`, if it is known
};

}  // namespace

Result<NewProject> makeProject(const fs::path& sceneFile, const fs::path& projectFile,
                               const NewProjectOptions& options, const ImportHost& host, TaskRunner& runner,
                               const Progress& progress, std::stop_token stop) {
  if (!(options.eyeHeight > 0 && options.eyeHeight <= 1000))
    return fail(ErrorKind::invalidArgument, "eye height must lie in (0, 1000] metres");
  if (!(options.bakeMinutes >= 0 && options.bakeMinutes <= kMostBakeMinutes))
    return fail(ErrorKind::invalidArgument, "minutes of baking must lie in [0, 1e6]; 0 is no limit");
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

  OpenProject bare;  // without a layout
  bare.file = projectFile;
  bare.project.import = options.import;
  const auto stated = scenePathFor(sceneFile, projectFile);
  if (!stated) return tl::unexpected(stated.error());
  bare.project.scene = *stated;

  const auto scene = importScene(sceneFile, options.import, host, progress, stop);
  if (!scene) return tl::unexpected(scene.error());
  bare.imported = bare.scene = *scene;
  bare.plan = planEffects(**scene);
  const auto rays = RayScene::build(*scene, bare.plan);
  if (!rays) return tl::unexpected(rays.error());
  bare.rays = *rays, bare.mirrors = flatMirrorsOf(**scene, bare.plan);

  if (progress) progress({0, 0, "finding the walkable area"});
  auto planes = planesFor(**scene, **rays, options, runner);
  if (!planes) return tl::unexpected(planes.error());
  return Maker(std::move(bare), sceneFile, std::move(*planes), options, host, runner, progress, stop).make();
}

Result<BakeForecast> glanceAtBake(std::span<const OpenProject> storeys, double seconds, TaskRunner& runner,
                                  const Progress& progress, std::stop_token stop) {
  constexpr double kEnough = 0.3;  // of the time: the storeys that are left are like the others
  std::vector<BakeShare> shares;
  for (const OpenProject& storey : storeys) shares.push_back(missingOf(storey, BakeRequest{}));
  BakeForecastOptions options;
  options.enoughSeconds = kEnough * seconds;
  options.glance = true;
  std::stop_source late;
  const std::stop_callback stopped(stop, [&] { late.request_stop(); });
  const std::jthread clock([&late, seconds](const std::stop_token& known) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, known, std::chrono::duration<double>(seconds),
                                           [] { return false; });
    if (!known.stop_requested()) late.request_stop();
  });
  return forecastBake(shares, options, runner, progress, late.get_token());
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
