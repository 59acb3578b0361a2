#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <ranges>
#include <set>

#include "engine/bake/surface_light_bake.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/pipeline/estimate_bake.h"
#include "engine/pipeline/local_triangles.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {
namespace {

/// Puts captures into the store with their records; takes none for there that is damaged.
class StoreSink final : public CaptureSink {
 public:
  StoreSink(const CaptureStore& store, const StoreyPlan& plan, int colourQuality,
            const std::function<Status()>& mayGoOn)
      : store_(store), colourQuality_(colourQuality), mayGoOn_(mayGoOn) {
    for (const PlannedCapture& camera : plan.cameras) planned_[camera.key] = &camera;
    planned_[plan.light.key] = &plan.light;
  }

  /// As it was when it was first asked for.
  bool has(const ContentKey& key) const override {
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_.emplace(key, look(key, false, {})).first->second;
  }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) override {
    if (Status sound = mayGoOn(); !sound) return sound;
    if (Status done = store_.put(key, capture, stop, colourQuality_); !done) return done;
    return note(key);
  }
  Status mayGoOn() const { return mayGoOn_ ? mayGoOn_() : Status(); }
  Status note(const ContentKey& key) const {
    const PlannedCapture& planned = *planned_.at(key);
    std::optional<SampleCounts> samples;
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = samples_.find(key); found != samples_.end()) samples = found->second;
    }
    return store_.putRecord(key, planned.subject, planned.parts, samples);
  }
  void tell(const ContentKey& key, const SampleCounts& samples) override {
    const std::lock_guard lock(mutex_);
    samples_[key] = samples;
  }

  /// Reads what is there of `keys` to its end.
  Status verify(const std::vector<ContentKey>& keys, TaskRunner& runner, const Progress& progress,
                const std::stop_token& stop) {
    std::vector<char> sound(keys.size(), 0);
    std::atomic<double> done = 0;
    runner.parallelFor(keys.size(), [&](std::size_t k) {
      if (stop.stop_requested()) return;
      sound[k] = look(keys[k], true, stop);
      const std::lock_guard lock(mutex_);
      if (progress) progress({done += 1, double(keys.size()), "reading what is baked"});
    });
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the bake was stopped");
    for (std::size_t k = 0; k < keys.size(); ++k) known_[keys[k]] = sound[k] != 0;
    return status();
  }

  /// Where another file can be written, the one that could not be is in the way of nothing else.
  bool passesOver(const ContentKey& key, const Error& error) override {
    if (error.kind != ErrorKind::unreadable || !checkWritable(store_.folder())) return false;
    const std::lock_guard lock(mutex_);
    refusedKeys_.insert(key);
    refused_.push_back(error.describe());
    return true;
  }
  bool isRefused(const ContentKey& key) const { return refusedKeys_.contains(key); }
  std::vector<std::string> takeRefused() { return std::move(refused_); }

  /// The first trouble in looking at what is there, other than damage.
  Status status() const {
    if (trouble_) return tl::unexpected(*trouble_);
    return {};
  }
  std::vector<std::string> takeDamaged() {
    std::ranges::sort(damaged_);
    return std::move(damaged_);
  }

 private:
  bool look(const ContentKey& key, bool toTheEnd, const std::stop_token& stop) const {
    const auto found = store_.inspect(key, toTheEnd, stop);
    if (found && found->condition == CaptureStore::Condition::sound) {
      if (!found->recorded) (void)note(key);  // if it cannot be noted, it is read again the next time
      const std::lock_guard lock(mutex_);
      if (found->recordDamage) damaged_.push_back(found->recordDamage->describe());
      return true;
    }
    // Should the bake end before it is baked again, the next one must not believe it by its size.
    if (found && found->condition == CaptureStore::Condition::damaged) store_.forgetRecord(key);
    const std::lock_guard lock(mutex_);
    if (!found && !trouble_) trouble_ = found.error();
    if (found)
      for (const Error& error : found->damage) damaged_.push_back(error.describe());
    return false;
  }

  const CaptureStore& store_;
  int colourQuality_;
  const std::function<Status()>& mayGoOn_;
  std::map<ContentKey, const PlannedCapture*> planned_;
  mutable std::map<ContentKey, bool> known_;  ///< used by the thread that bakes
  mutable std::mutex mutex_;
  std::map<ContentKey, SampleCounts> samples_;  ///< of what was baked just now
  mutable std::vector<std::string> damaged_;
  mutable std::optional<Error> trouble_;
  std::set<ContentKey> refusedKeys_;
  std::vector<std::string> refused_;
};

/// Nothing where nothing was ever baked: asking makes no folder.
std::optional<CaptureStore> storeIfThere(const OpenProject& open) {
  std::error_code error;
  const auto folder = captureFolderFor(open.file);
  if (!std::filesystem::is_directory(folder, error)) return std::nullopt;
  auto store = CaptureStore::open(folder);
  return store ? std::optional(std::move(*store)) : std::nullopt;
}

/// What could not be written, and what to do.
Error withAdvice(Error error) {
  if (error.kind == ErrorKind::outOfSpace)
    error.message += "; what is finished is kept: make room and bake again";
  else if (error.kind == ErrorKind::unreadable)
    error.message += "; make the folder writable, or bake a copy of the project and its model in one that is";
  return error;
}

/// Gives triangles that were left out the mean light of the others, so that none of them is black.
void spreadMean(const std::vector<std::uint8_t>& baked, SurfaceLight& light) {
  glm::dvec3 sum(0);
  double samples = 0;
  const auto each = [&](bool wanted, const auto& use) {
    for (std::size_t t = 0; t < baked.size(); ++t)
      if ((baked[t] != 0) == wanted)
        for (std::uint32_t s = light.firstSample[t]; s < light.firstSample[t + 1]; ++s) use(light.light[s]);
  };
  each(true, [&](const HalfColour& sample) { sum += glm::dvec3(unpackColour(sample)), ++samples; });
  if (samples == 0) return;
  const HalfColour mean = packColour({glm::vec3(sum / samples), 1});
  each(false, [&](HalfColour& sample) { sample = mean; });
}

/// The captures and the light of one storey in one quality.
class StoreyBake {
 public:
  StoreyBake(const OpenProject& open, const BakeRequest& request, const CaptureStore& store,
             TaskRunner& runner, const Progress& progress, const std::stop_token& stop)
      : open_(open),
        request_(request),
        store_(store),
        runner_(runner),
        progress_(progress),
        stop_(stop),
        plan_(planStorey(open)),
        sink_(store, plan_, open.project.bake.colourQuality, request.mayGoOn) {}

  Status verify(const std::vector<int>& cameras) {
    std::vector<ContentKey> keys;
    for (const int camera : cameras) keys.push_back(open_.keys[std::size_t(camera)]);
    if (request_.surfaceLight) keys.push_back(open_.surfaceLightKey);
    return sink_.verify(keys, runner_, progress_, stop_);
  }
  bool has(int camera) const { return sink_.has(plan_.cameras[std::size_t(camera)].key); }
  bool hasLight() const { return lightTried_ || sink_.has(open_.surfaceLightKey); }
  double pixelsOf(int camera) const { return plan_.cameras[std::size_t(camera)].pixels; }
  double bytesOf(int camera) const { return double(store_.bytesOf(plan_.cameras[std::size_t(camera)].key)); }

  /// May be called again, with other cameras.
  Status bakeCaptures(const std::vector<int>& cameras, const BakeWatch& watch) {
    auto captures = bake(*open_.rays, *open_.layout, cameras, open_.project.bake, sink_, runner_, progress_,
                         stop_, request_.memoryBytes, watch);
    if (!captures) return tl::unexpected(withAdvice(captures.error()));
    captures->baked -= int(std::erase_if(captures->cameras, [&](const BakedCamera& camera) {
      return !camera.reused && sink_.isRefused(camera.key);
    }));
    std::ranges::move(captures->cameras, std::back_inserter(captures_.cameras));
    captures_.baked += captures->baked;
    captures_.reused += captures->reused;
    captures_.seconds += captures->seconds;
    captures_.counts += captures->counts;
    captures_.testEyes += captures->testEyes;
    captures_.peakBytes = std::max(captures_.peakBytes, captures->peakBytes);
    return {};
  }
  /// What one region draws; what was baked of it is the light's own, and is not baked again.
  Status bakeFirstLight(const Region& region) {
    const Stopwatch watch;
    const std::vector<std::uint8_t> near = localTrianglesOf(*open_.drawn, region, stop_);
    if (std::ranges::find(near, 1) == near.end()) return {};
    auto light = gatherLight(near);
    if (!light) return tl::unexpected(withAdvice(light.error()));
    spreadMean(near, *light);
    if (Status sound = sink_.mayGoOn(); !sound) return sound;
    const ContentKey key = firstLightKey(open_.surfaceLightKey);
    if (Status kept = store_.putSurfaceLight(key, *light, stop_);
        !kept && !sink_.passesOver(key, kept.error()))
      return tl::unexpected(withAdvice(kept.error()));
    lightSeconds_ += watch.seconds();
    return {};
  }
  Status bakeLight() {
    const Stopwatch watch;
    const ContentKey& key = open_.surfaceLightKey;
    const auto light = gatherLight({});
    if (!light) return tl::unexpected(withAdvice(light.error()));
    if (Status sound = sink_.mayGoOn(); !sound) return sound;
    Status kept = store_.putSurfaceLight(key, *light, stop_);
    if (kept) kept = sink_.note(key);
    if (!kept && !sink_.passesOver(key, kept.error())) return tl::unexpected(withAdvice(kept.error()));
    if (kept) {
      store_.forgetSurfaceLightParts(key);
      std::error_code ignored;
      std::filesystem::remove(store_.fileOf(firstLightKey(key), ".light"), ignored);
    }
    lightBaked_ = kept.has_value();
    lightTried_ = true;
    lightSeconds_ += watch.seconds();
    return {};
  }

  /// Adds what was done, or the first trouble there was in looking at what is there.
  Status tell(ProjectBakeReport& report) {
    if (Status looked = sink_.status(); !looked) return looked;
    if (Status sound = sink_.mayGoOn(); !sound) return sound;
    std::ranges::move(sink_.takeDamaged(), std::back_inserter(report.damaged));
    report.captures = std::move(captures_);
    report.surfaceLightBaked = lightBaked_;
    report.surfaceLightReused = request_.surfaceLight && !lightTried_;
    std::ranges::move(sink_.takeRefused(), std::back_inserter(report.refused));
    report.surfaceLightSeconds = lightSeconds_;
    report.surfaceLightResumed = lightResumed_.value_or(0);
    return {};
  }

 private:
  /// Of what `only` marks, or of all.
  Result<SurfaceLight> gatherLight(std::vector<std::uint8_t> only) {
    if (!local_) local_ = localTrianglesOf(*open_.rays, *open_.drawn, *open_.layout, runner_, stop_);
    const ContentKey& key = open_.surfaceLightKey;
    SurfaceLightParts parts;
    parts.only = std::move(only);
    parts.known = store_.getSurfaceLightParts(key);
    parts.keep = [&](const SurfaceLightPart& part) {
      if (Status sound = sink_.mayGoOn(); !sound) return sound;
      return store_.putSurfaceLightPart(key, part);
    };
    auto light = bakeSurfaceLight(*open_.rays, *open_.drawn, local_->wanted, local_->viewer,
                                  open_.project.bake, runner_, progress_, stop_, &parts);
    if (!lightResumed_) lightResumed_ = parts.resumed;  // later ones find what this bake has left
    return light;
  }

  const OpenProject& open_;
  const BakeRequest& request_;
  const CaptureStore& store_;
  TaskRunner& runner_;
  const Progress& progress_;
  const std::stop_token& stop_;
  StoreyPlan plan_;
  StoreSink sink_;
  BakeReport captures_;
  bool lightBaked_ = false, lightTried_ = false;
  double lightSeconds_ = 0;
  std::optional<std::uint64_t> lightResumed_;
  std::optional<LocalTriangles> local_;
};

/// What comes before the first camera is done: previews of those that have nothing yet.
struct Previews {
  OpenProject open;
  std::vector<int> cameras;
  std::unique_ptr<StoreyBake> bake;
};

/// What a bake has before it, of one storey.
struct Missing {
  std::vector<int> cameras;
  double pixels = 0, previewPixels = 0;
  bool light = false;
  int known = 0;  ///< of the captures that are there
  double knownPixels = 0, knownBytes = 0;
  bool any() const { return !cameras.empty() || light; }
};
Missing missingOf(const std::vector<int>& cameras, const BakeRequest& request, const StoreyBake& bake,
                  const Previews* previews, const std::stop_token& stop) {
  Missing missing;
  missing.light = request.surfaceLight && !bake.hasLight();
  for (const int camera : cameras) {
    if (stop.stop_requested()) break;
    const double pixels = bake.pixelsOf(camera);
    if (bake.has(camera))
      ++missing.known, missing.knownPixels += pixels, missing.knownBytes += bake.bytesOf(camera);
    else
      missing.cameras.push_back(camera), missing.pixels += pixels;
  }
  if (previews != nullptr)
    for (const int camera : previews->cameras) missing.previewPixels += previews->bake->pixelsOf(camera);
  return missing;
}

/// Bytes a pixel of captures that are not known yet; half as much again as a furnished room takes.
constexpr double kTypicalBytesPerPixel = 12;
constexpr int kFewestKnown = 4;

/// Refuses to begin what cannot be finished, of all that is before the bake, previews too. Where room is
/// plentiful by far, a rough figure does; else a little is baked to know better.
Status checkRoom(const OpenProject& open, const Missing& missing, const BakeRequest& request,
                 const CaptureStore& store, TaskRunner& runner, ProjectBakeReport& report,
                 const Progress& progress, const std::stop_token& stop) {
  const auto available = freeSpace(store.folder());
  if (!available) return tl::unexpected(available.error());
  report.freeBytes = *available;
  const double perPixel =
      missing.known >= kFewestKnown ? missing.knownBytes / missing.knownPixels : kTypicalBytesPerPixel;
  report.neededBytes = (missing.pixels + missing.previewPixels) * perPixel;
  if (!missing.any()) return {};
  if (Status writable = checkWritable(store.folder()); !writable)
    return tl::unexpected(withAdvice(writable.error()));
  constexpr double kPlenty = 4;
  if (kPlenty * report.neededBytes + double(std::uint64_t(1) << 30) > double(*available)) {
    EstimateOptions options;
    options.surfaceLight = missing.light;
    options.memoryBytes = request.memoryBytes;
    const auto estimate = estimateProjectBake(open, missing.cameras, options, runner, progress, stop);
    if (!estimate) return tl::unexpected(estimate.error());
    report.neededBytes = missing.light ? estimate->lightBytes.value : 0;
    if (!missing.cameras.empty())
      report.neededBytes += estimate->captureBytes.value * (1 + missing.previewPixels / missing.pixels);
  }
  const std::string figures =
      fmt::format("about {:.0f} MB are needed{}, {:.0f} MB are free", report.neededBytes / 1e6,
                  missing.previewPixels > 0 ? " for previews and captures" : "", double(*available) / 1e6);
  if (report.neededBytes > double(*available))
    return fail(ErrorKind::outOfSpace,
                figures + ": make room, bake fewer cameras, or lower the samples per degree",
                store.folder().string());
  if (progress) progress({0, 0, figures});
  return {};
}

/// All that comes before the first view can be left. `rest`: the cameras to be baked; of these the first
/// view's are taken away when they are baked.
Status bakeCoarseFirst(const OpenProject& open, const BakeRequest& request, Previews& previews,
                       StoreyBake& full, bool light, std::vector<int>& rest, ProjectBakeReport& report) {
  const glm::dvec2 from = request.from.value_or(glm::dvec2(open.project.spawn().position));
  const std::vector<int> view = firstViewCameras(open, from);
  const auto isFirst = [&](int camera) { return std::ranges::find(view, camera) != view.end(); };
  const auto takeFirst = [&](std::vector<int>& cameras) {
    const auto other = std::ranges::stable_partition(cameras, isFirst).begin();
    std::vector<int> first(cameras.begin(), other);
    cameras.erase(cameras.begin(), other);
    return first;
  };
  BakeWatch watch;
  if (request.watch)
    watch = [&](CameraNews news) {
      news.preview = true;
      request.watch(news);
    };
  if (Status done = previews.bake->bakeCaptures(takeFirst(previews.cameras), watch); !done) return done;
  if (Status done = full.bakeCaptures(takeFirst(rest), request.watch); !done) return done;
  if (const auto region = open.layout->regionAt(from); light && region)
    if (Status done = full.bakeFirstLight(open.layout->regions[std::size_t(*region)]); !done) return done;
  if (Status done = previews.bake->bakeCaptures(previews.cameras, watch); !done) return done;
  if (Status told = previews.bake->tell(report); !told) return told;
  return light ? full.bakeLight() : Status();
}

}  // namespace

void ProjectBakeReport::add(const ProjectBakeReport& other) {
  damaged.insert(damaged.end(), other.damaged.begin(), other.damaged.end());
  refused.insert(refused.end(), other.refused.begin(), other.refused.end());
  captures.cameras.clear();
  captures.baked += other.captures.baked;
  captures.reused += other.captures.reused;
  captures.seconds += other.captures.seconds;
  captures.counts += other.captures.counts;
  captures.testEyes += other.captures.testEyes;
  captures.peakBytes = std::max(captures.peakBytes, other.captures.peakBytes);
  surfaceLightBaked = surfaceLightBaked || other.surfaceLightBaked;
  surfaceLightReused = surfaceLightReused || other.surfaceLightReused;
  surfaceLightSeconds += other.surfaceLightSeconds;
  surfaceLightResumed += other.surfaceLightResumed;
  bytes += other.bytes;
  neededBytes += other.neededBytes;
  freeBytes = other.freeBytes;
}

OpenProject atQuality(const OpenProject& open, Quality quality) {
  OpenProject lower = open;
  lower.project.bake = open.project.bake.at(quality);
  if (quality != Quality::full)
    lower.keys = captureKeys(*open.scene, open.plan, lower.project.bake, *open.layout);
  return lower;
}

std::vector<std::optional<ContentKey>> bestKeys(const OpenProject& open, const CaptureStore& store) {
  std::vector<std::optional<ContentKey>> best(open.keys.size());
  const auto take = [&](const std::vector<ContentKey>& keys) {
    for (std::size_t camera = 0; camera < keys.size(); ++camera)
      if (!best[camera] && store.has(keys[camera])) best[camera] = keys[camera];
  };
  take(open.keys);
  for (const Quality quality : kQualities | std::views::reverse)
    if (quality != Quality::full &&
        !std::ranges::all_of(best, [](const auto& key) { return key.has_value(); }))
      take(captureKeys(*open.scene, open.plan, open.project.bake.at(quality), *open.layout));
  return best;
}

std::vector<bool> bakedCameras(const OpenProject& open) {
  std::vector<bool> baked(open.keys.size(), false);
  if (const auto store = storeIfThere(open))
    for (std::size_t i = 0; i < open.keys.size(); ++i) baked[i] = store->has(open.keys[i]);
  return baked;
}

bool surfaceLightBaked(const OpenProject& open) {
  const auto store = storeIfThere(open);
  return store && store->hasSurfaceLight(open.surfaceLightKey);
}

Result<CaptureStore> openCaptures(const std::filesystem::path& projectPath) {
  auto store = CaptureStore::open(captureFolderFor(projectPath));
  if (!store) return tl::unexpected(withAdvice(store.error()));
  return store;
}

Result<ProjectBakeReport> bakeProject(const OpenProject& open, const BakeRequest& request, TaskRunner& runner,
                                      const Progress& progress, std::stop_token stop) {
  const auto store = openCaptures(open.file);
  if (!store) return tl::unexpected(store.error());
  return bakeProject(open, request, *store, runner, progress, std::move(stop));
}

Result<ProjectBakeReport> bakeProject(const OpenProject& open, const BakeRequest& request,
                                      const CaptureStore& store, TaskRunner& runner, const Progress& progress,
                                      std::stop_token stop) {
  if (Status near = checkNear(open.near); !near) return tl::unexpected(near.error());
  const std::vector<int> cameras = request.cameras ? *request.cameras : bakingOrder(open);
  for (int camera : cameras)
    if (camera < 0 || camera >= int(open.keys.size()))
      return fail(ErrorKind::invalidArgument, "there is no camera " + std::to_string(camera) +
                                                  "; the layout has " + std::to_string(open.keys.size()));

  StoreyBake full(open, request, store, runner, progress, stop);
  if (request.verify)
    if (Status read = full.verify(cameras); !read) return tl::unexpected(read.error());
  std::optional<Previews> previews;
  if (request.coarseFirst) {
    previews.emplace(Previews{atQuality(open, Quality::preview), {}, {}});
    previews->bake = std::make_unique<StoreyBake>(previews->open, request, store, runner, progress, stop);
    const auto best = bestKeys(open, store);
    std::ranges::copy_if(cameras, std::back_inserter(previews->cameras),
                         [&](int camera) { return !best[std::size_t(camera)]; });
  }
  ProjectBakeReport report;
  const Missing missing = missingOf(cameras, request, full, previews ? &*previews : nullptr, stop);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the bake was stopped");
  if (Status room = checkRoom(open, missing, request, store, runner, report, progress, stop); !room)
    return tl::unexpected(room.error());

  std::vector<int> rest = cameras;
  if (previews)
    if (Status done = bakeCoarseFirst(open, request, *previews, full, missing.light, rest, report); !done)
      return tl::unexpected(done.error());
  if (Status done = full.bakeCaptures(rest, request.watch); !done) return tl::unexpected(done.error());
  if (request.surfaceLight && !full.hasLight())
    if (Status done = full.bakeLight(); !done) return tl::unexpected(done.error());
  if (Status told = full.tell(report); !told) return tl::unexpected(told.error());
  for (const ContentKey& key : open.keys) report.bytes += store.bytesOf(key);
  return report;
}

}  // namespace acentric
