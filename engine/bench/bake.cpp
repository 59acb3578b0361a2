#include "engine/bench/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <optional>

#include "engine/bake/capture_writer.h"
#include "engine/bake/ray_log.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"
#include "engine/base/work_clock.h"
#include "engine/bench/bake_to_size.h"
#include "engine/pipeline/trial_folder.h"

namespace acentric {
namespace {

/// What a set leaves on of the plan's effects.
enum class BenchLight { none, hardShadows, all };

/// One layer without pruning and silhouettes shows what the effects cost; the qualities are as a bake has
/// them.
struct Kind {
  const char* name;
  BenchLight light;
  std::optional<Quality> quality;
};
constexpr Kind kKinds[] = {
    {"geometry", BenchLight::none, {}},         {"one shadow ray", BenchLight::hardShadows, {}},
    {"all effects", BenchLight::all, {}},       {"preview", BenchLight::all, Quality::preview},
    {"draft", BenchLight::all, Quality::draft}, {"final", BenchLight::all, Quality::full}};
constexpr std::size_t kGeometry = 0, kAllEffects = 2;

/// The distance in two bytes instead of four.
constexpr double kQuantisedBytes = double(kCaptureSampleBytes) - 2;

/// As if the background were samples like others.
double bytesWithBackground(const SampleCounts& samples) {
  return double(kCaptureSampleBytes) * double(samples.keptInAll() + samples.background);
}

EffectPlan planWith(const EffectPlan& plan, BenchLight light) {
  EffectPlan out = plan;
  if (light == BenchLight::all) return out;
  for (const Effect effect :
       {Effect::emission, Effect::directionalLights, Effect::pointLights, Effect::spotLights,
        Effect::areaLights, Effect::sky, Effect::hardShadows, Effect::softShadows, Effect::ambientOcclusion,
        Effect::diffuseInterreflection, Effect::mirrorReflection, Effect::transmission})
    out[effect].on = false;
  if (light == BenchLight::hardShadows) {
    out[Effect::directionalLights].on = plan.on(Effect::directionalLights);
    out[Effect::hardShadows].on = out.on(Effect::directionalLights);
  }
  return out;
}

std::string effectsOf(const EffectPlan& plan) {
  std::string names;
  for (int e = 0; e < kEffectCount; ++e)
    if (plan.on(Effect(e))) names += (names.empty() ? "" : ", ") + std::string(labelOf(Effect(e)));
  return names.empty() ? "none" : names;
}

/// A ring around the spawn, about as large as a region.
Result<Layout> ringAt(const OpenProject& open, int cameras) {
  const LayoutSpec& spec = open.project.layout();
  Apv apv;
  apv.centre = open.project.spawn().position;
  apv.fovDegrees = 360.0 / cameras;
  apv.offset = {spec.cellSize, 0};
  LayoutSpec alone;
  alone.configuration = spec.configuration;
  alone.cellSize = spec.cellSize;
  alone.floorHeight = spec.floorHeight;
  alone.eyeHeight = spec.eyeHeight;
  alone.nearBand = spec.nearBand;
  alone.freeApvs[1] = apv;
  return buildLayout(alone);
}

class BakeTimer {
 public:
  BakeTimer(const OpenProject& open, const BakeBenchOptions& options, const Layout& ring,
            std::stop_token stop)
      : open_(open), options_(options), ring_(ring), stop_(std::move(stop)) {}

  ColumnCamera columnsOf(const LayoutCamera& camera, const BakeSettings& settings) const {
    ColumnCamera columns = columnCameraFor(camera, ring_, open_.scene->bounds, settings);
    columns.columns = columns.rows = sideOf(settings);
    return columns;
  }
  /// Of a coarser quality accordingly smaller.
  int sideOf(const BakeSettings& settings) const {
    return std::max(
        1, int(std::lround(options_.side * settings.samplesPerDegree / open_.project.bake.samplesPerDegree)));
  }

  /// What all of it will take.
  Result<BakeForecast> foretell(TaskRunner& runner, const Progress& progress) const {
    BakeForecast all;
    for (const BenchLight light : {BenchLight::none, BenchLight::hardShadows, BenchLight::all}) {
      const auto forecast = foretell(light, runner, progress);
      if (!forecast) return forecast;
      all += *forecast;
    }
    return all;
  }

  BakeSettings settingsOf(const std::optional<Quality>& quality) const {
    if (quality) return open_.project.bake.at(*quality);
    BakeSettings settings = open_.project.bake;
    settings.pruning = false;
    settings.maxLayers = 1;
    settings.silhouettes = false;
    return settings;
  }

  /// A set's settings without pruning: all that its rays meet.
  BakeSettings everySurface() const {
    BakeSettings everything = settingsOf(Quality::full);
    everything.pruning = false;
    return everything;
  }

  Status bakeOnce(const RayScene& rays, const BakeSettings& settings, TaskRunner& runner,
                  CaptureCounts& counts, std::vector<Capture>* captures = nullptr) const {
    counts = {};
    CameraBaker baker(rays, settings);
    for (const LayoutCamera& camera : ring_.cameras) {
      auto capture = baker.bake(camera, columnsOf(camera, settings), runner, counts, stop_);
      if (!capture) return tl::unexpected(capture.error());
      if (captures != nullptr) captures->push_back(std::move(*capture));
    }
    return {};
  }

  /// BakeBenchSet::tracerShare.
  Result<double> tracerShare(const EffectPlan& plan, const BakeSettings& settings) const {
    RayLog log;
    const auto rays = RayScene::build(open_.scene, plan, &log);
    if (!rays) return tl::unexpected(rays.error());
    TaskRunner one(0);
    CameraBaker baker(**rays, settings);
    double seconds = 0;
    for (int pass = 0; pass < 2; ++pass) {  // the first for what cameras share
      log.clear();
      CaptureCounts counts;
      const LayoutCamera& camera = ring_.cameras.front();
      const WorkClock watch;
      const auto capture = baker.bake(camera, columnsOf(camera, settings), one, counts, stop_);
      if (!capture) return tl::unexpected(capture.error());
      seconds = watch.seconds();
    }
    const WorkClock watch;
    (*rays)->replay(log);
    return watch.seconds() * log.scale() / seconds;
  }

  /// Seconds of the fastest repeat, and of gathering light in the first of them. Captures are kept of the
  /// last: memory that is used again costs nothing.
  Result<double> bakeRing(const RayScene& rays, const BakeSettings& settings, TaskRunner& runner,
                          CaptureCounts& counts, double& gatherSeconds,
                          std::vector<Capture>* captures = nullptr) const {
    gatherSeconds = 0;
    return fastest([&](bool last) {
      Status done = bakeOnce(rays, settings, runner, counts, last ? captures : nullptr);
      gatherSeconds += counts.rays.gatherSeconds / runner.threads();
      return done;
    });
  }

  /// The same ring from start to files.
  Result<double> ringToFiles(const RayScene& rays, TaskRunner& runner,
                             const std::filesystem::path& folder) const {
    const auto remove = [&] {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    };
    return fastest([&](bool) { return writeRing(rays, runner, folder); }, remove);
  }

  double firstRays(const BakeSettings& settings) const {
    return double(ring_.cameras.size()) * sideOf(settings) * sideOf(settings);
  }

  /// The ray tracer alone on each camera's first rays, those of the march.
  Result<double> traceAlone(const RayScene& rays, TaskRunner& runner) const {
    return fastest([&](bool) -> Status {
      for (const LayoutCamera& camera : ring_.cameras)
        traceFirstRays(rays, camera, columnsOf(camera, open_.project.bake), runner);
      return {};
    });
  }

 private:
  /// Seconds of the fastest repeat of `work(is it the last)`; `after` each is not timed.
  template <class Work, class After = void (*)()>
  Result<double> fastest(
      const Work& work, const After& after = [] {}) const {
    double least = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < options_.repeats; ++repeat) {
      const Stopwatch watch;
      if (Status done = work(repeat + 1 == options_.repeats); !done) return tl::unexpected(done.error());
      least = std::min(least, watch.seconds());
      after();
    }
    return least;
  }
  Status writeRing(const RayScene& rays, TaskRunner& runner, const std::filesystem::path& folder) const;
  /// Of the sets with this light: each set of effects has a tracer of its own, and one is enough at a time.
  Result<BakeForecast> foretell(BenchLight light, TaskRunner& runner, const Progress& progress) const;
  /// Samples per degree with which a camera usually has as many pixels as it is baked with here.
  double resolutionOf(const BakeSettings& settings) const {
    const ColumnCamera usual = columnCameraFor(ring_.cameras.front(), ring_, open_.scene->bounds, settings);
    return settings.samplesPerDegree * sideOf(settings) / std::sqrt(double(usual.columns) * usual.rows);
  }

  const OpenProject& open_;
  const BakeBenchOptions& options_;
  const Layout& ring_;
  std::stop_token stop_;
};

Status BakeTimer::writeRing(const RayScene& rays, TaskRunner& runner,
                            const std::filesystem::path& folder) const {
  const auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  class Sink final : public CaptureSink {
   public:
    Sink(const CaptureStore& s, int quality) : store(s), colourQuality(quality) {}
    bool has(const ContentKey&) const override { return false; }
    Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) override {
      return store.put(key, capture, stop, colourQuality);
    }
    const CaptureStore& store;
    int colourQuality;
  } sink(*store, open_.project.bake.colourQuality);
  MemoryBudget budget;
  CaptureWriter writer(sink, budget, stop_);
  const BakeSettings settings = settingsOf({});
  CameraBaker baker(rays, settings, &budget);
  std::uint64_t number = 0;
  for (const LayoutCamera& camera : ring_.cameras) {
    CaptureCounts counts;
    auto capture = baker.bake(camera, columnsOf(camera, settings), runner, counts, stop_);
    if (!capture) return tl::unexpected(capture.error());
    if (Status put = writer.put({0, ++number}, std::move(*capture)); !put) return put;
  }
  return writer.finish();
}

Result<BakeForecast> BakeTimer::foretell(BenchLight light, TaskRunner& runner,
                                         const Progress& progress) const {
  OpenProject lit = open_;
  lit.layout = std::make_shared<const Layout>(ring_);
  lit.plan = planWith(open_.plan, light);
  if (light != BenchLight::all) {
    auto rays = RayScene::build(open_.scene, lit.plan);
    if (!rays) return tl::unexpected(rays.error());
    lit.rays = std::move(*rays);
  }
  std::list<OpenProject> opened;
  std::vector<BakeShare> shares;
  const auto add = [&](BakeSettings settings, TrialBake trial) {
    const double wanted = resolutionOf(settings);
    settings.samplesPerDegree = std::clamp(wanted, kLeastSamplesPerDegree, kMostSamplesPerDegree);
    trial.times *= std::pow(wanted / settings.samplesPerDegree, 2);
    opened.push_back(lit);
    opened.back().project.bake = settings;
    shares.push_back({&opened.back(), allCamerasOf(ring_), false, 0, trial});
  };
  for (const Kind& kind : kKinds) {
    if (kind.light != light) continue;
    TrialBake trial{options_.repeats, double(options_.repeats)};
    trial.kept = TrialBake::Kept::letGo;
    if (light == BenchLight::hardShadows) {  // again, to files
      trial.bakes *= 2, trial.times *= 2;
      trial.kept = TrialBake::Kept::onDisk;
    }
    if (kind.quality == Quality::full && runner.threads() > 1) {  // again, on one thread
      trial.bakes *= 2, trial.times *= 1 + runner.threads();
    }
    add(settingsOf(kind.quality), trial);
  }
  if (light == BenchLight::none) {
    TrialBake once;
    once.kept = TrialBake::Kept::letGo;
    add(everySurface(), once);
  }
  return forecastBake(shares, {}, runner, progress, stop_);
}

struct FileCosts {
  double encodingSeconds = 0, writingSeconds = 0, packBytes = 0;
};

Result<FileCosts> fileCosts(const std::vector<Capture>& captures, int colourQuality,
                            const std::filesystem::path& folder) {
  FileCosts costs;
  const auto again = [&](const std::filesystem::path& path, double& bytes) -> Status {
    const auto content = readFile(path);
    if (!content) return tl::unexpected(content.error());
    bytes += double(content->size());
    const Stopwatch watch;
    if (Status done = writeFileAtomically(path, *content); !done) return done;
    costs.writingSeconds += watch.seconds();
    return {};
  };
  const auto pack = folder / "trial.pack";
  for (const Capture& capture : captures) {
    const Stopwatch watch;
    if (Status done = writeCodedPack(capture, {}, pack, colourQuality); !done)
      return tl::unexpected(done.error());
    costs.encodingSeconds += watch.seconds();
    if (Status done = again(pack, costs.packBytes); !done) return tl::unexpected(done.error());
  }
  costs.encodingSeconds = std::max(0.0, costs.encodingSeconds - costs.writingSeconds);
  return costs;
}

}  // namespace

Status BakeBenchOptions::check() const {
  const auto bad = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "bench bake");
  };
  if (cameras < 6 || cameras > 72) return bad(fmt::format("{} cameras: must lie in 6..72", cameras));
  if (side < 8 || side > 16384) return bad(fmt::format("{} columns and rows: must lie in 8..16384", side));
  if (repeats < 1 || repeats > 100) return bad(fmt::format("{} repeats: must lie in 1..100", repeats));
  return {};
}

Result<BakeBench> benchBake(const OpenProject& open, const BakeBenchOptions& options, TaskRunner& runner,
                            const Progress& progress, std::stop_token stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const auto ring = ringAt(open, options.cameras);
  if (!ring) return tl::unexpected(ring.error());
  const auto folder = TrialFolder::make(std::filesystem::absolute(open.file).parent_path());
  if (!folder) return tl::unexpected(folder.error());
  const BakeTimer bench(open, options, *ring, stop);
  BakeBench out;
  out.cameras = int(ring->cameras.size());
  out.side = options.side;
  out.threads = runner.threads();
  out.firstRays = bench.firstRays(open.project.bake);

  if (options.tell) {
    const auto forecast = bench.foretell(runner, progress);
    if (!forecast) return tl::unexpected(forecast.error());
    options.tell(*forecast);
  }
  std::vector<Capture> captures;
  for (const Kind& kind : kKinds) {
    if (progress)
      progress(
          {double(out.sets.size()), double(std::size(kKinds)), fmt::format("baking a ring: {}", kind.name)});
    const EffectPlan plan = planWith(open.plan, kind.light);
    const auto rays = RayScene::build(open.scene, plan);
    if (!rays) return tl::unexpected(rays.error());
    if (kind.light == BenchLight::none) {
      const auto tracer = bench.traceAlone(**rays, runner);
      if (!tracer) return tl::unexpected(tracer.error());
      out.tracerSeconds = *tracer;
    }
    const BakeSettings settings = bench.settingsOf(kind.quality);
    const bool last = kind.quality == Quality::full;
    BakeBenchSet set;
    set.name = kind.name;
    set.effects = effectsOf(plan);
    set.firstRays = bench.firstRays(settings);
    const auto seconds =
        bench.bakeRing(**rays, settings, runner, set.counts, set.gatherSeconds, last ? &captures : nullptr);
    if (!seconds) return tl::unexpected(seconds.error());
    set.seconds = *seconds;
    set.primaryShare = double(set.counts.rays.primary) / set.seconds / (out.firstRays / out.tracerSeconds);
    if (kind.light == BenchLight::none) {
      CaptureCounts met;
      if (Status counted = bench.bakeOnce(**rays, bench.everySurface(), runner, met); !counted)
        return tl::unexpected(counted.error());
      out.bytes.everySurface = bytesWithBackground(met.samples);
    }
    if (kind.light == BenchLight::hardShadows) {
      const auto ringSeconds = bench.ringToFiles(**rays, runner, folder->path() / "ring");
      if (!ringSeconds) return tl::unexpected(ringSeconds.error());
      out.ringSeconds = *ringSeconds;
    }
    if (last && runner.threads() > 1) {
      TaskRunner one(0);
      CaptureCounts counts;
      double gathered = 0;
      const auto alone = bench.bakeRing(**rays, settings, one, counts, gathered);
      if (!alone) return tl::unexpected(alone.error());
      out.oneThreadSeconds = *alone;
    }
    const auto share = bench.tracerShare(plan, settings);
    if (!share) return tl::unexpected(share.error());
    set.tracerShare = *share;
    out.sets.push_back(std::move(set));
  }
  const BakeBenchSet& final = out.sets.back();
  out.shadingSeconds = std::max(0.0, out.sets[kAllEffects].seconds - out.sets[kGeometry].seconds);
  const double kept = double(final.counts.samples.keptInAll());
  double runs = 0;
  for (const Capture& capture : captures) runs += double(capture.background.bytes());
  out.bytes.pruned = bytesWithBackground(final.counts.samples);
  out.bytes.surfaces = double(kCaptureSampleBytes) * kept + runs;
  out.bytes.quantised = kQuantisedBytes * kept + runs;
  const auto costs = fileCosts(captures, open.project.bake.colourQuality, folder->path());
  if (!costs) return tl::unexpected(costs.error());
  out.encodingSeconds = costs->encodingSeconds;
  out.writingSeconds = costs->writingSeconds;
  out.bytes.pack = costs->packBytes;
  return out;
}

}  // namespace acentric
