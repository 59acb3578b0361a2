#include "engine/pipeline/estimate_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "engine/bake/capture_writer.h"
#include "engine/bake/eye_views.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/surface_light_bake.h"
#include "engine/bake/test_eyes.h"
#include "engine/base/file.h"
#include "engine/base/work_clock.h"
#include "engine/pipeline/gather_forecast.h"
#include "engine/pipeline/local_triangles.h"
#include "engine/pipeline/trial_folder.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

/// Enough pixels of a camera to keep every thread busy through most of the probe, and more samples than the
/// files pack into one block: smaller blocks pack better.
constexpr double kProbePixelsPerThread = 10000, kFewestProbePixels = 30000;
constexpr int kProbeColumns = 64;  ///< side by side, of which bytes are told: pictures of fewer pack worse
constexpr double kLightSamples = 66000, kLightRunSamples = 2000;
constexpr std::size_t kFewestLightRuns = 4;  ///< one may be finer for a shadow's edge, the next is not
constexpr int kColumnsPerThread = 4;         ///< of which the bake makes one task
/// Of slices as dense as a bake: columns of each, and pixels of a camera's together.
constexpr int kSliceColumns = 32;
constexpr double kSlicePixels = 2e5;
constexpr std::size_t kTimedRegions = 8;  ///< whose test eyes are found
constexpr std::size_t kTimedViews = 8;    ///< what eyes see, as finely as a bake looks
constexpr double kBriefly = 10;           ///< so many times fewer of all these, where it is to be brief
constexpr std::size_t kBriefSlices = 3;   ///< cameras that tell of bytes where it is: as many as tell of pace

/// With which cameras are probed: maps of what eyes see that do for few pixels (more is traced along edges),
/// and little gathering, since a part would gather nearly all for itself alone. Colours are then rougher by
/// too little to change how well they pack.
BakeSettings probingSettings(BakeSettings settings) {
  constexpr double kSamplesPerDegree = 2;
  constexpr int kAmbientRays = 4;
  settings.samplesPerDegree = std::min(settings.samplesPerDegree, kSamplesPerDegree);
  settings.ambientRays = std::min(settings.ambientRays, kAmbientRays);
  settings.bounces = 1;
  settings.pruningLoss = 0;
  return settings;
}

/// The same for the surfaces' own light, which packs as it was gathered: one bounce looks like many.
BakeSettings lightProbingSettings(BakeSettings settings) {
  settings.bounces = 1;
  return settings;
}

/// Neighbouring columns of a camera, as it would bake them.
ColumnCamera sliceOf(const ColumnCamera& whole, int first, int columns) {
  ColumnCamera slice = whole;
  slice.lowAzimuth = whole.azimuthAt(first);
  slice.fovRadians = columns * whole.columnPitch();
  slice.columns = columns;
  return slice;
}

/// Slices spread over a camera; all of it where they would be half. Those of camera after camera lie at other
/// places each time, since the middle of cameras tells little of their sides.
std::vector<ColumnCamera> slicesOf(const ColumnCamera& whole, int columns, double pixels, std::size_t probe) {
  constexpr double kGolden = 0.6180339887498949;
  const int count = std::max(1, int(pixels / (double(columns) * whole.rows)));
  if (2 * count * columns > whole.columns) return {whole};
  const double place = std::fmod((double(probe) + 0.5) * kGolden, 1.0);
  std::vector<ColumnCamera> slices;
  for (int n = 0; n < count; ++n)
    slices.push_back(sliceOf(whole, int((n + place) / count * (whole.columns - columns)), columns));
  return slices;
}

struct Written {
  std::size_t trial = 0;
  double samples = 0, seconds = 0, bytes = 0;
};

/// Encodes and writes as the store does, measures, and removes.
class TrialSink final : public CaptureSink {
 public:
  TrialSink(fs::path folder, int colourQuality) : folder_(std::move(folder)), colourQuality_(colourQuality) {}

  bool has(const ContentKey&) const override { return false; }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) override {
    const fs::path pack = folder_ / "trial.pack";
    const WorkClock watch;
    if (Status done = writeCodedPack(capture, key, pack, colourQuality_, stop); !done) return done;
    const double seconds = watch.seconds();
    written_.push_back({key.low, double(capture.sampleCount()), seconds, double(fs::file_size(pack))});
    fs::remove(pack);
    return {};
  }
  const std::vector<Written>& written() const { return written_; }

 private:
  fs::path folder_;
  int colourQuality_;
  std::vector<Written> written_;
};

/// Triangles that get about as many samples each.
class TriangleKind {
 public:
  void add(std::size_t triangle, double samples) {
    triangles_.push_back(triangle);
    last_.push_back(this->samples() + samples);
    taken_.push_back(0);
  }
  double samples() const { return last_.empty() ? 0 : last_.back(); }

  /// Triangles not handed out before, of `wanted` samples or more: short runs of neighbours, begun at places
  /// spread evenly over all the samples.
  std::vector<std::size_t> next(double wanted) {
    constexpr double kGolden = 0.6180339887498949;
    const double mostRuns = 4 * samples() / kLightRunSamples + 16;
    std::vector<std::size_t> chosen;
    const std::size_t begun = runs_;
    for (double found = 0; (found < wanted || runs_ < begun + kFewestLightRuns) && double(runs_) < mostRuns;
         ++runs_) {
      const double place = std::fmod((double(runs_) + 0.5) * kGolden, 1.0) * samples();
      auto at = std::size_t(std::ranges::upper_bound(last_, place) - last_.begin());
      for (double run = 0; run < kLightRunSamples && at < taken_.size() && taken_[at] == 0; ++at) {
        taken_[at] = 1;
        chosen.push_back(triangles_[at]);
        const double count = last_[at] - (at > 0 ? last_[at - 1] : 0);
        run += count, found += count;
      }
    }
    return chosen;
  }

 private:
  std::vector<std::size_t> triangles_;
  std::vector<double> last_;  ///< samples of the triangles up to and with each
  std::vector<std::uint8_t> taken_;
  std::size_t runs_ = 0;
};

constexpr std::size_t kKinds = 3;
std::size_t kindOf(double samples) { return samples < 100 ? 0 : samples < 1000 ? 1 : 2; }

class ProjectProber final : public BakeProber {
 public:
  ProjectProber(const OpenProject& open, const std::vector<int>& cameras, TaskRunner& runner,
                std::stop_token stop, const TrialFolder& folder, const EstimateOptions& options)
      : open_(open),
        cameras_(cameras),
        runner_(runner),
        stop_(std::move(stop)),
        brief_(options.brief),
        fewer_(options.brief ? kBriefly : 1),
        budget_(options.memoryBytes),
        baker_(*open.rays, probingSettings(open.project.bake), &budget_),
        lightFile_(folder.path() / "trial.light"),
        sink_(folder.path(), open.project.bake.colourQuality) {}

  ColumnCamera columnsOf(int camera) const {
    return columnCameraFor(layoutCamera(camera), *open_.layout, open_.scene->bounds, open_.project.bake);
  }

  Result<GatherForecast> forecastGathering(bool surfaceLight) override {
    if (surfaceLight)
      if (Status laidOut = layOutLight(); !laidOut) return tl::unexpected(laidOut.error());
    auto forecast = acentric::forecastGathering(open_, cameras_, surfaceLight ? &layout_ : nullptr, runner_,
                                                stop_, brief_);
    if (forecast) secondsPerGatheredRay_ = forecast->secondsPerRay;
    return forecast;
  }

  Result<CaptureOverhead> captureOverhead() override {
    ColumnCamera one = columnsOf(0);
    one.columns = one.rows = 1;
    constexpr int kRepeats = 3;  // the first also warms up
    for (int n = 0; n < kRepeats; ++n) {
      const auto capture = bake(0, one);
      if (!capture) return tl::unexpected(capture.error());
      overhead_.traceSeconds = capture->seconds;
      TrialSink sink(lightFile_.parent_path(), open_.project.bake.colourQuality);
      if (Status done = sink.put({}, capture->capture, stop_); !done) return tl::unexpected(done.error());
      smallest_ = sink.written().front();
    }
    overhead_.writeSeconds = smallest_.seconds;
    overhead_.bytes = smallest_.bytes;
    return overhead_;
  }

  Result<double> probeCapture(int camera) override {
    if (!writer_) writer_.emplace(sink_, budget_, stop_);
    const ColumnCamera whole = columnsOf(camera);
    const double wanted = std::max(kFewestProbePixels, kProbePixelsPerThread * runner_.threads()) / fewer_;
    const double thinning = double(whole.columns) * whole.rows / wanted;
    probes_.push_back({});
    if (thinning < 2) return traceTrial(camera, whole, {});
    // Columns spread over all of it tell of samples and time, some side by side of the file.
    ColumnCamera fewColumns = whole;
    const int evenly = kColumnsPerThread * runner_.threads();
    fewColumns.columns =
        std::clamp(int(std::lround(whole.columns / thinning / evenly)) * evenly, 1, whole.columns);
    auto traced = traceTrial(camera, fewColumns, {.written = false});
    if (!traced || (brief_ && probes_.size() > kBriefSlices)) return traced;
    for (const ColumnCamera& slice : slicesOf(whole, kProbeColumns, wanted, probes_.size())) {
      // A slice has many more pixels than a brief estimate counts.
      const auto rays = traceTrial(camera, slice, {.counted = !brief_});
      if (!rays) return rays;
      *traced += *rays;
    }
    return traced;
  }

  Result<std::vector<CaptureProbe>> finishCaptures() override {
    if (writer_)
      if (Status done = writer_->finish(); !done) return tl::unexpected(done.error());
    for (const Written& written : sink_.written()) {
      CaptureProbe& probe = probes_[written.trial];
      probe.writtenSamples += written.samples;
      probe.writeSeconds += std::max(0.0, written.seconds - overhead_.writeSeconds);
      probe.bytes += std::max(0.0, written.bytes - smallest_.bytes);
    }
    return probes_;
  }

  Result<std::vector<SliceProbe>> bakeSlices(const std::vector<int>& cameras) override {
    TrialSink sink(lightFile_.parent_path(), open_.project.bake.colourQuality);
    CaptureWriter writer(sink, budget_, stop_);
    std::vector<SliceProbe> probes;
    for (const int camera : cameras) {
      SliceProbe& probe = probes.emplace_back();
      const std::vector<ColumnCamera> slices =
          slicesOf(columnsOf(camera), kSliceColumns, kSlicePixels / fewer_, probes.size());
      const WorkClock watch;
      double apart = (double(slices.size()) - 1) * overhead_.traceSeconds;
      for (const ColumnCamera& slice : slices) {
        auto traced = bake(camera, slice);
        if (!traced) return tl::unexpected(traced.error());
        probe.pixels += double(slice.columns) * slice.rows;
        apart +=
            traced->counts.seconds.sight() + double(traced->counts.rays.gathered) * secondsPerGatheredRay_;
        if (Status put = writer.put({}, std::move(traced->capture)); !put) return tl::unexpected(put.error());
      }
      probe.seconds = std::max(0.0, watch.seconds() - apart);
    }
    const WorkClock watch;
    if (Status done = writer.finish(); !done) return tl::unexpected(done.error());
    probes.back().seconds += watch.seconds();
    return probes;
  }

  double sightSeconds() override {
    if (!open_.project.bake.pruning) return 0;
    const double eyeZ = open_.layout->eyeZ();
    std::set<std::array<double, 3>> eyes;
    std::map<CellId, const Role*> regions;
    for (int camera = 0; camera < int(cameras_.size()); ++camera)
      for (const Role& role : layoutCamera(camera).roles)
        if (regions.emplace(role.region, &role).second)
          for (const glm::dvec3& eye : placedEyes(role.polygon, eyeZ, open_.project.bake))
            eyes.insert({eye.x, eye.y, eye.z});
    std::size_t count = eyes.size();
    const double findingSeconds = findEyes(regions, eyeZ, count);
    const ColumnCamera columns = columnsOf(0);
    EyeViews views(*open_.rays, {columns.bottomElevation, columns.topElevation}, open_.project.bake, budget_);
    const std::size_t step =
        std::max<std::size_t>(1, std::size_t(double(eyes.size()) * fewer_ / kTimedViews));
    RayCounts rays;
    const WorkClock watch;
    std::size_t n = 0;
    for (const auto& eye : eyes)
      if (n++ % step == 0 && !views.at({eye[0], eye[1], eye[2]}, runner_, rays, stop_)) return 0;
    return views.traced() == 0 ? 0 : findingSeconds + watch.seconds() / views.traced() * double(count);
  }

  Result<LightOverhead> lightOverhead() override {
    if (Status laidOut = layOutLight(); !laidOut) return tl::unexpected(laidOut.error());
    LightOverhead overhead;
    for (std::size_t t = 0; t < local_.wanted.size(); ++t)
      if (const double samples = double(layout_.firstSample[t + 1] - layout_.firstSample[t]); samples > 0)
        kinds_[kindOf(samples)].add(t, samples);
    for (const TriangleKind& kind : kinds_) overhead.samplesOfKind.push_back(kind.samples());
    // The tables that a file of light has however dark it is, and the time they take.
    const auto dark = writeLight(layout_);
    if (!dark) return tl::unexpected(dark.error());
    const auto nothing = bakeLight({});
    if (!nothing) return tl::unexpected(nothing.error());
    nothingSeconds_ = nothing->seconds;
    overhead.bytes = dark->bytes;
    overhead.seconds = findingSeconds_ + dark->seconds + nothing->seconds;
    return overhead;
  }

  Result<LightProbe> probeLight(int kind) override {
    constexpr double kUsualRays = 64;  // with more, fewer samples do
    const double wanted = kLightSamples / fewer_ * std::min(1.0, kUsualRays / open_.project.bake.ambientRays);
    const std::vector<std::size_t> chosen = kinds_[std::size_t(kind)].next(wanted);
    if (chosen.empty()) return LightProbe{};
    auto probe = bakeLight(chosen);
    if (probe) probe->seconds = std::max(0.0, probe->seconds - nothingSeconds_);
    return probe;
  }

 private:
  /// Adds the eyes that a bake will find in regions, as a few of these tell. Seconds that finding takes.
  double findEyes(const std::map<CellId, const Role*>& regions, double eyeZ, std::size_t& count) {
    const std::size_t step =
        std::max<std::size_t>(1, std::size_t(double(regions.size()) * fewer_ / kTimedRegions));
    RayCounts rays;
    const WorkClock watch;
    std::size_t n = 0, asked = 0, found = 0;
    for (const auto& [id, role] : regions) {
      if (n++ % step != 0) continue;
      const RegionEyes eyes = findTestEyes(*open_.rays, role->polygon, role->grown, eyeZ, open_.project.bake,
                                           runner_, rays, stop_);
      ++asked;
      found += eyes.eyes.size() - eyes.placed;
    }
    const double share = asked == 0 ? 0 : double(regions.size()) / double(asked);
    count += std::size_t(share * double(found));
    return share * watch.seconds();
  }

  const LayoutCamera& layoutCamera(int camera) const {
    return open_.layout->cameras[std::size_t(cameras_[std::size_t(camera)])];
  }

  struct Traced {
    Capture capture;
    CaptureCounts counts;
    double seconds = 0;  ///< without looking what regions see
  };
  Result<Traced> bake(int camera, const ColumnCamera& columns) {
    Traced traced;
    const WorkClock watch;
    auto capture = baker_.bake(layoutCamera(camera), columns, runner_, traced.counts, stop_);
    if (!capture) return tl::unexpected(capture.error());
    traced.capture = std::move(*capture);
    traced.seconds = watch.seconds() - traced.counts.seconds.sight();
    return traced;
  }

  /// What a trial tells of: pixels, samples, rays and time where it is counted, bytes where it is written.
  struct Telling {
    bool counted = true, written = true;
  };
  /// Rays of all purposes.
  Result<double> traceTrial(int camera, const ColumnCamera& columns, Telling of) {
    auto first = bake(camera, columns);
    if (!first) return tl::unexpected(first.error());
    const RayCounts& rays = first->counts.rays;
    double seconds = first->seconds, traced = double(rays.total());
    if (of.counted) {
      if (rays.gathered > 0) {  // now that it is there, what the rest takes
        const auto again = bake(camera, columns);
        if (!again) return tl::unexpected(again.error());
        seconds = again->seconds;
        traced += double(again->counts.rays.total());
      }
      CaptureProbe& probe = probes_.back();
      probe.pixels += double(columns.columns) * columns.rows;
      probe.samples += double(first->capture.sampleCount());
      // Less what the regions' eyes look at: a camera shares that with its neighbours, whatever part is
      // probed.
      probe.rays += double(rays.total() - rays.visibility - rays.gathered);
      probe.traceSeconds += std::max(0.0, seconds - overhead_.traceSeconds);
    }
    if (of.written)
      if (Status put = writer_->put({0, probes_.size() - 1}, std::move(first->capture)); !put)
        return tl::unexpected(put.error());
    return traced;
  }

  /// Once.
  Status layOutLight() {
    if (!layout_.resolution.empty()) return {};
    const WorkClock finding;
    local_ = localTrianglesOf(*open_.rays, *open_.drawn, *open_.layout, runner_, stop_);
    if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "the estimate was stopped");
    findingSeconds_ = finding.seconds();
    auto layout = layOutSurfaceLight(*open_.rays, *open_.drawn, local_.wanted, open_.project.bake);
    if (!layout) return tl::unexpected(layout.error());
    layout_ = std::move(*layout);
    return {};
  }

  struct LightFile {
    double bytes = 0, seconds = 0;
  };
  Result<LightFile> writeLight(const SurfaceLight& light) const {
    const WorkClock watch;
    if (Status done = writeSurfaceLight(light, {}, lightFile_, stop_); !done)
      return tl::unexpected(done.error());
    return LightFile{double(fs::file_size(lightFile_)), watch.seconds()};
  }

  /// Bytes: of the light itself, without the tables.
  Result<LightProbe> bakeLight(const std::vector<std::size_t>& triangles) const {
    std::vector<LightSides> wanted(local_.wanted.size(), LightSides::none);
    for (const std::size_t t : triangles) wanted[t] = local_.wanted[t];
    const auto bakeOnce = [&] {
      return bakeSurfaceLight(*open_.rays, *open_.drawn, wanted, local_.viewer,
                              lightProbingSettings(open_.project.bake), runner_, {}, stop_);
    };
    WorkClock watch;
    auto light = bakeOnce();
    if (!light) return tl::unexpected(light.error());
    double seconds = watch.seconds();
    if (gathersLight(open_.plan, open_.project.bake) && !triangles.empty()) {
      watch = {};
      if (const auto again = bakeOnce(); !again) return tl::unexpected(again.error());
      seconds = watch.seconds();
    }
    const auto lit = writeLight(*light);
    if (!lit) return tl::unexpected(lit.error());
    LightProbe probe{0, 0, seconds + lit->seconds, double(light->light.size())};
    for (const std::size_t t : triangles)
      probe.samples += double(layout_.firstSample[t + 1] - layout_.firstSample[t]);
    std::ranges::fill(light->light, HalfColour(0));
    const auto dark = writeLight(*light);
    if (!dark) return tl::unexpected(dark.error());
    probe.bytes = std::max(0.0, lit->bytes - dark->bytes);
    return probe;
  }

  const OpenProject& open_;
  const std::vector<int>& cameras_;
  TaskRunner& runner_;
  std::stop_token stop_;
  bool brief_;
  double fewer_;
  MemoryBudget budget_;
  CameraBaker baker_;
  fs::path lightFile_;
  TrialSink sink_;
  std::optional<CaptureWriter> writer_;
  CaptureOverhead overhead_;
  Written smallest_;
  std::vector<CaptureProbe> probes_;
  double secondsPerGatheredRay_ = 0;
  LocalTriangles local_;
  SurfaceLight layout_;
  double findingSeconds_ = 0;
  std::array<TriangleKind, kKinds> kinds_;
  double nothingSeconds_ = 0;  ///< of baking no light at all
};

}  // namespace

Result<BakeEstimate> estimateProjectBake(const OpenProject& open, const std::vector<int>& cameras,
                                         const EstimateOptions& options, TaskRunner& runner,
                                         const Progress& progress, std::stop_token stop) {
  if (Status near = checkNear(open.near); !near) return tl::unexpected(near.error());
  std::vector<int> which = cameras;
  if (!options.captures)
    which.clear();
  else if (which.empty())
    for (std::size_t c = 0; c < open.layout->cameras.size(); ++c) which.push_back(int(c));
  for (const int camera : which)
    if (camera < 0 || camera >= int(open.layout->cameras.size()))
      return fail(ErrorKind::invalidArgument, fmt::format("there is no camera {}; the layout has {}", camera,
                                                          open.layout->cameras.size()));
  std::error_code unknown;  // a project that is in no file lies nowhere
  const fs::path beside =
      open.file.empty() ? fs::temp_directory_path(unknown) : fs::absolute(open.file, unknown).parent_path();
  const auto folder = TrialFolder::make(beside);
  if (!folder) return tl::unexpected(folder.error());
  try {
    ProjectProber prober(open, which, runner, stop, *folder, options);
    std::vector<double> pixels;
    for (std::size_t c = 0; c < which.size(); ++c) {
      const ColumnCamera columns = prober.columnsOf(int(c));
      pixels.push_back(double(columns.columns) * columns.rows);
    }
    return estimateBake(pixels, options, prober, progress, stop);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for an estimate; lower the samples per degree",
                open.file.string());
  } catch (const fs::filesystem_error& error) {
    return fail(ErrorKind::unreadable, error.what(), folder->path().string());
  }
}

}  // namespace acentric
