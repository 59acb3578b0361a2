#include "engine/bench/holes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "engine/bake/surface_light_bake.h"
#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/local_triangles.h"
#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

using CapturePtr = std::shared_ptr<const DisplayCapture>;

/// How near the border of the ring the walk ends: a share of the way from its centre.
constexpr double kWalkedShare = 0.95;

/// Keeps captures ready for display.
class KeptCaptures final : public CaptureSink {
 public:
  explicit KeptCaptures(float exposure) : exposure_(exposure) {}
  bool has(const ContentKey& key) const override { return find(key) != nullptr; }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token&) override {
    auto display = std::make_shared<const DisplayCapture>(prepareForDisplay(capture, exposure_));
    const std::lock_guard lock(mutex_);
    captures_[key] = std::move(display);
    return {};
  }
  CapturePtr find(const ContentKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = captures_.find(key);
    return found == captures_.end() ? nullptr : found->second;
  }

 private:
  float exposure_;
  mutable std::mutex mutex_;
  std::map<ContentKey, CapturePtr> captures_;
};

/// The ring that holds the place, else the one nearest to it.
std::optional<int> ringAt(const Layout& layout, const glm::dvec2& place) {
  std::optional<int> best;
  double least = 0;
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    if (region.kind != RegionKind::ring || region.id.slot == kFreeSlot) continue;
    const double distance = glm::distance(region.polygon.nearestPoint(place), place);
    if (!best || distance < least) best = int(r), least = distance;
  }
  return best;
}

/// The ring alone, with or without a panorama at its centre.
Result<Layout> ringAlone(const LayoutSpec& spec, const Region& ring, bool panorama) {
  LayoutSpec alone = spec;
  alone.outline = {};
  alone.added = {ring.id};
  alone.removed.clear();
  alone.freeApvs.clear();
  if (panorama) alone.freeApvs[0] = Apv{ring.polygon.centroid(), {0, 0}};
  return buildLayout(alone);
}

/// From the ring's centre to the left of the way one looks.
std::vector<PerspectiveView> viewsToTheLeft(const Region& ring, double eyeZ, double yaw, double fov,
                                            const HoleBenchOptions& options) {
  const glm::dvec2 centre = ring.polygon.centroid(), left = directionOf(yaw + kPi / 2);
  const auto span = ring.polygon.raySpan(centre, left);
  require(span.has_value(), "a ring's centre lies in it");
  std::vector<PerspectiveView> views;
  for (int i = 0; i < options.frames; ++i) {
    PerspectiveView view;
    const double way = kWalkedShare * span->second * i / std::max(options.frames - 1, 1);
    view.eye = glm::dvec3(centre + way * left, eyeZ);
    view.yawRadians = yaw;
    view.fovRadians = fov;
    view.width = options.width, view.height = options.height;
    views.push_back(view);
  }
  return views;
}

/// Scenes to be drawn: layers or one layer, with or without the panorama, with or without the ring.
class HolesBench {
 public:
  HolesBench(const OpenProject& open, const HoleBenchOptions& options, TaskRunner& runner, Progress progress,
             std::stop_token stop)
      : open_(open),
        options_(options),
        runner_(runner),
        progress_(std::move(progress)),
        stop_(std::move(stop)),
        kept_(open.project.exposure) {}

  Result<HoleBench> run() {
    const Spawn& spawn = open_.project.spawn();
    const auto ring = ringAt(*open_.layout, options_.place.value_or(spawn.position));
    if (!ring)
      return fail(ErrorKind::invalidArgument, "the layout has no ring to walk in: place a cell first",
                  open_.file.string());
    const Region& region = open_.layout->regions[std::size_t(*ring)];
    for (const bool panorama : {false, true}) {
      auto layout = ringAlone(open_.project.layout(), region, panorama);
      if (!layout) return tl::unexpected(layout.error());
      (panorama ? withPanorama_ : bare_) = std::make_shared<const Layout>(std::move(*layout));
    }
    oneLayer_ = open_.project.bake;
    oneLayer_.maxLayers = 1;
    oneLayer_.pruning = false;
    if (options_.tell)
      if (Status told = foretell(); !told) return tl::unexpected(told.error());
    for (const BakeSettings& settings : {oneLayer_, open_.project.bake})
      if (Status baked = bakeAll(settings); !baked) return tl::unexpected(baked.error());
    if (Status lit = lightLocal(); !lit) return tl::unexpected(lit.error());

    HoleBench bench;
    bench.region = region.id;
    const double fov = options_.fovDegrees > 0 ? options_.fovDegrees : open_.project.fovDegrees;
    bench.views = viewsToTheLeft(region, open_.layout->eyeZ(), options_.yawRadians.value_or(spawn.yawRadians),
                                 radians(fov), options_);
    for (const PerspectiveView& view : bench.views)
      if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
    return drawAll(std::move(bench));
  }

 private:
  enum class Cameras { ring, panorama, both };

  /// One layer, then all layers, for which little light is left to gather, and light on what is near.
  Status foretell() const {
    OpenProject layered = open_;
    layered.layout = withPanorama_;
    OpenProject oneLayer = layered;
    oneLayer.project.bake = oneLayer_;
    TrialBake trial;
    trial.kept = TrialBake::Kept::inMemory;
    const std::vector<int> all = allCamerasOf(*withPanorama_);
    const BakeShare first{&oneLayer, all, false, 0, trial};
    trial.gathers = false;
    const BakeShare shares[] = {first, {&layered, all, !surfaceLightBaked(open_), 0, trial}};
    const auto forecast = forecastBake(shares, {}, runner_, progress_, stop_);
    if (!forecast) return tl::unexpected(forecast.error());
    options_.tell(*forecast);
    return {};
  }

  Status bakeAll(const BakeSettings& settings) {
    auto report = bake(*open_.rays, *withPanorama_, allCamerasOf(*withPanorama_), settings, kept_, runner_,
                       progress_, stop_);
    if (!report) return tl::unexpected(report.error());
    return {};
  }

  Status lightLocal() {
    local_ = std::make_shared<const LocalGeometry>(clipToPolygon(*open_.drawn, bare_->regions.front().grown));
    std::error_code error;
    if (const auto folder = captureFolderFor(open_.file); std::filesystem::is_directory(folder, error)) {
      const auto store = CaptureStore::open(folder);
      if (!store) return tl::unexpected(store.error());
      if (store->hasSurfaceLight(open_.surfaceLightKey))
        if (auto light = store->getSurfaceLight(open_.surfaceLightKey)) {
          light_ = std::make_shared<const SurfaceLight>(std::move(*light));
          return {};
        }
    }
    const LocalTriangles near = localTrianglesOf(*open_.rays, *open_.drawn, *bare_, runner_, stop_);
    auto light = bakeSurfaceLight(*open_.rays, *open_.drawn, near.wanted, near.viewer, open_.project.bake,
                                  runner_, progress_, stop_);
    if (!light) return tl::unexpected(light.error());
    light_ = std::make_shared<const SurfaceLight>(std::move(*light));
    return {};
  }

  WalkScene sceneOf(const BakeSettings& settings, Cameras cameras) const {
    WalkScene walk;
    walk.scene = open_.drawn->sharedScene();
    walk.layout = cameras == Cameras::ring ? bare_ : withPanorama_;
    walk.plan = open_.plan;
    walk.mirrors = open_.mirrors;
    walk.exposure = open_.project.exposure;
    walk.surfaceLight = light_;
    walk.local = {local_};
    const auto keys = captureKeys(*open_.scene, open_.plan, settings, *walk.layout);
    for (std::size_t c = 0; c < keys.size(); ++c) {
      const bool ofRing = walk.layout->cameras[c].id.corner != kFreeCorner;
      walk.captures.push_back(ofRing && cameras == Cameras::panorama ? nullptr : kept_.find(keys[c]));
    }
    return walk;
  }

  Status draw(HoleBench& bench, const std::vector<FloatImage>& distances, std::string name,
              std::string description, const WalkScene& walk, bool otherHand) const {
    HoleBenchMethod method{std::move(name), std::move(description), {}, {}, {}, 0};
    for (const CapturePtr& capture : walk.captures)
      method.samples += capture ? std::uint64_t(capture->samples.size()) : 0;
    ViewSettings settings = open_.project.view;
    settings.renderer = Renderer::list;
    settings.localGeometry = true;
    settings.secondaryCover = otherHand;
    for (std::size_t v = 0; v < bench.views.size(); ++v) {
      // All are compared alike, as a walk shows them: filled. Pictures show what there was to be filled.
      settings.fillHoles = true;
      const auto filled = renderFrame(walk, bench.views[v], settings, runner_);
      if (!filled) return tl::unexpected(filled.error());
      const auto comparison = compare(*filled, bench.truth[v], distances[v]);
      if (!comparison) return tl::unexpected(comparison.error());
      method.comparisons.push_back(*comparison);
      settings.fillHoles = false;
      auto frame = renderFrame(walk, bench.views[v], settings, runner_);
      if (!frame) return tl::unexpected(frame.error());
      method.openShares.push_back(double(frame->holeCount()) / double(frame->source.pixels.size()));
      method.pictures.push_back(std::move(frame->colour));
    }
    bench.methods.push_back(std::move(method));
    return {};
  }

  Result<HoleBench> drawAll(HoleBench bench) const {
    std::vector<FloatImage> distances;
    for (const PerspectiveView& view : bench.views) {
      if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
      TruthFrame truth = renderTruth(*open_.rays, view, open_.project.bake, open_.project.exposure,
                                     options_.truthSamples, runner_);
      bench.truth.push_back(std::move(truth.colour));
      distances.push_back(std::move(truth.rayDistance));
    }
    struct Method {
      const char* name;
      const char* description;
      bool layered;
      Cameras cameras;
      bool otherHand;
    };
    static constexpr Method kMethods[] = {
        {"TPV", "one panorama at the centre, one layer", false, Cameras::panorama, true},
        {"APV, one hand", "the ring of the better hand, one layer", false, Cameras::ring, false},
        {"APV", "the rings of both hands, one layer", false, Cameras::ring, true},
        {"TPV + APV", "both, one layer", false, Cameras::both, true},
        {"layered", "the rings of both hands, layered", true, Cameras::ring, true},
        {"layered + TPV", "the same and a layered panorama behind them", true, Cameras::both, true}};
    for (const Method& m : kMethods)
      if (Status drawn = draw(bench, distances, m.name, m.description,
                              sceneOf(m.layered ? open_.project.bake : oneLayer_, m.cameras), m.otherHand);
          !drawn)
        return tl::unexpected(drawn.error());
    return bench;
  }

  const OpenProject& open_;
  const HoleBenchOptions& options_;
  TaskRunner& runner_;
  Progress progress_;
  std::stop_token stop_;
  KeptCaptures kept_;
  BakeSettings oneLayer_;
  std::shared_ptr<const Layout> bare_, withPanorama_;  ///< the ring alone
  std::shared_ptr<const LocalGeometry> local_;
  std::shared_ptr<const SurfaceLight> light_;
};

}  // namespace

Status HoleBenchOptions::check() const {
  if (frames < 1 || frames > 1000)
    return fail(ErrorKind::invalidArgument, fmt::format("{} frames: must be 1 to 1000", frames),
                "bench holes");
  if (place && !(std::isfinite(place->x) && std::isfinite(place->y)))
    return fail(ErrorKind::invalidArgument, "the place must be two numbers in metres", "bench holes");
  return {};
}

Result<HoleBench> benchHoles(const OpenProject& open, const HoleBenchOptions& options, TaskRunner& runner,
                             const Progress& progress, std::stop_token stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  return HolesBench(open, options, runner, progress, std::move(stop)).run();
}

}  // namespace acentric
