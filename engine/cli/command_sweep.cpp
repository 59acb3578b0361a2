/// acentric sweep: settings of a project against each other, and what is worth having of them.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/commit.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/sweep_run.h"
#include "engine/measure/sweep_report.h"
#include "engine/measure/sweep_search.h"
#include "engine/pipeline/bake_presets.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

/// Of the time, kept for combinations while choices are tried one at a time.
constexpr double kSearchShare = 0.3;
/// That the qualities of a bake may take of it, at most.
constexpr double kPresetShare = 0.3;

/// All that figures may only be compared within.
std::string fingerprintOf(const Sweep& sweep, const PathWalk& walk, const BakeSettings& truthBake) {
  const OpenProject& open = walk.storeys.front();
  Hasher hasher;
  hasher.text(sweep.version).text(sweep.processor).text(formatProject(open.project));
  hasher.value(sweep.threads).value(sweep.frames).value(sweep.repeats).value(sweep.truthSamples);
  for (const ContentKey& key : open.keys) hasher.value(key.high).value(key.low);
  for (const PerspectiveView& view : walk.views) {
    for (int k = 0; k < 3; ++k) hasher.value(view.eye[k]);
    hasher.value(view.yawRadians).value(view.pitchRadians).value(view.fovRadians);
    hasher.value(view.width).value(view.height);
  }
  truthBake.addTo(hasher);
  return hasher.finish().toHex();
}

/// The truth is one for all settings: it has as many rays as the best of them.
BakeSettings truthBakeOf(const Project& project, const std::vector<KnobRange>& ranges) {
  BakeSettings bake = project.bake;
  for (const KnobRange& range : ranges)
    for (const std::string& value : range.values) {
      Project tried = project;
      if (!range.knob->set(tried, value)) continue;
      bake.shadowRays = std::max(bake.shadowRays, tried.bake.shadowRays);
      bake.ambientRays = std::max(bake.ambientRays, tried.bake.ambientRays);
      bake.bounces = std::max(bake.bounces, tried.bake.bounces);
    }
  return bake;
}

/// A sweep under way: what is known, and the files that say so.
class Sweeping {
 public:
  Sweeping(const SweepOptions& options, fs::path folder, Sweep sweep, Project project)
      : options_(options),
        folder_(std::move(folder)),
        sweep_(std::move(sweep)),
        project_(std::move(project)) {}

  void use(SweepRun& run) { run_ = &run; }
  const Sweep& sweep() const { return sweep_; }
  double keptForSearch() const { return options_.search ? kSearchShare * 60 * options_.budgetMinutes : 0; }
  double secondsLeft() const { return 60 * options_.budgetMinutes - watch_.seconds(); }
  int measuredNow() const { return measuredNow_; }

  /// Measured before, or now if `seconds` suffice; else skipped, with the reason.
  Result<const SweepPoint*> measure(const SweepSetting& setting, double seconds) {
    const SweepPoint* known = sweep_.find(setting);
    if (known && known->measured()) return known;
    const auto prospect = run_->foretell(setting, sweep_);
    if (!prospect) return tl::unexpected(prospect.error());
    const double needed = prospect->missingSeconds + measureSeconds_;
    SweepPoint point;
    if (prospect->open && !setting.empty() && needed > seconds) {
      point.setting = setting;
      point.skipped = fmt::format("would take about {}, of {} that were left", timeText(needed),
                                  timeText(std::max(seconds, 0.0)));
    } else {
      auto measured = run_->measure(setting, *prospect, sweep_);
      if (!measured) return tl::unexpected(measured.error());
      point = std::move(*measured);
      point.commit = commitName();
      if (setting.empty()) sweep_.referenceMs = run_->referenceMs();
    }
    if (setting.empty() && !point.measured()) return fail(ErrorKind::invalidArgument, point.skipped);
    if (point.measured()) measureSeconds_ = point.measureSeconds, ++measuredNow_;
    SweepPoint* place = sweep_.find(setting);
    if (place)
      *place = std::move(point);
    else
      sweep_.points.push_back(std::move(point)), place = &sweep_.points.back();
    if (Status written = write(); !written) return tl::unexpected(written.error());
    return place;
  }

  /// What the editor offers as qualities of a bake.
  Status tryPresets() {
    const double until = std::max(0.0, secondsLeft() - kPresetShare * 60 * options_.budgetMinutes);
    for (const BakePreset preset : kBakePresets) {
      const SweepSetting setting = settingOf(project_, preset);
      if (setting.empty()) continue;
      if (const auto point = measure(setting, secondsLeft() - until); !point)
        return tl::unexpected(point.error());
    }
    return {};
  }

  /// One choice at a time.
  Status trySingles(const std::vector<KnobRange>& ranges) {
    for (const bool bakes : {false, true})
      for (const KnobRange& range : ranges) {
        if (range.knob->bakes != bakes) continue;
        for (const std::string& value : range.values)
          if (const auto point = measure({{range.knob->name, value}}, secondsLeft() - keptForSearch());
              !point)
            return tl::unexpected(point.error());
      }
    return {};
  }

  Status tryCombinations() {
    std::map<SweepSetting, Objectives> known;
    for (const SweepPoint& point : sweep_.points)
      if (point.measured()) known[point.setting] = objectivesOf(point);
    SearchHost host;
    host.inOrder = [&](SweepSetting setting) {
      auto ordered = inOrder(setting, project_);
      return ordered ? std::move(*ordered) : std::move(setting);
    };
    host.goOn = [&] { return secondsLeft() > measureSeconds_; };
    host.measure = [&](const SweepSetting& setting) -> Result<std::optional<Objectives>> {
      const auto point = measure(setting, secondsLeft());
      if (!point) return tl::unexpected(point.error());
      return (*point)->measured() ? std::optional(objectivesOf(**point)) : std::nullopt;
    };
    const auto found = searchCombinations(std::move(known), host);
    if (!found) return tl::unexpected(found.error());
    return {};
  }

  /// Of the project as it is, unless an earlier call has done so.
  Status measureNumerics() {
    if (!sweep_.numerics.empty()) return {};
    auto numerics = run_->numerics();
    if (!numerics) return tl::unexpected(numerics.error());
    sweep_.numerics = std::move(*numerics);
    return write();
  }

  /// The report too.
  Status writeAll() const {
    if (Status written = write(); !written) return written;
    const auto html = sweepReport(sweep_, folder_);
    if (!html) return tl::unexpected(html.error());
    return writeTextAtomically(folder_ / "sweep.html", *html);
  }

 private:
  Status write() const {
    if (Status written = writeTextAtomically(folder_ / kSweepFile, toJson(sweep_)); !written) return written;
    if (Status written = writeTextAtomically(folder_ / "sweep.csv", toCsv(sweep_)); !written) return written;
    if (sweep_.numerics.empty()) return {};
    return writeTextAtomically(folder_ / "numerics.csv", toCsv(sweep_.numerics));
  }

  const SweepOptions& options_;
  fs::path folder_;
  Sweep sweep_;
  Project project_;
  SweepRun* run_ = nullptr;
  Stopwatch watch_;
  double measureSeconds_ = 0;  ///< that the last point has taken
  int measuredNow_ = 0;
};

/// What an earlier call has measured, if it may be gone on with.
Result<Sweep> resume(Sweep sweep, const fs::path& folder, bool again) {
  const fs::path file = folder / kSweepFile;
  std::error_code error;
  if (again || !fs::exists(file, error)) return sweep;
  const auto text = readText(file);
  if (!text) return tl::unexpected(text.error());
  auto before = parseSweep(*text, file.string());
  if (!before) return tl::unexpected(before.error());
  if (before->fingerprint != sweep.fingerprint)
    return fail(ErrorKind::invalidArgument,
                "is of another state of the project, other frames or another machine; choose another folder, "
                "or begin anew with --again",
                file.string());
  before->commit = sweep.commit;
  return before;
}

std::string lineOf(const SweepPoint& point) {
  if (!point.measured()) return fmt::format("  {:<40} skipped: {}\n", textOf(point.setting), point.skipped);
  return fmt::format("  {:<40} {:6.2f} dB {:8.4f} {:7.2f} % {:9.2f} ms {:9.2f} ms {:9.1f} MB {:>10}{}\n",
                     textOf(point.setting), point[Measure::psnr].median, point[Measure::msSsim].median,
                     100 * point[Measure::holeShare].median, point[Measure::frameMs].median,
                     point[Measure::frameP99Ms].median, point[Measure::bytes].median / 1e6,
                     timeText(point[Measure::bakeSeconds].median), point.bakeEstimated ? " foretold" : "");
}

Report reportOf(const Sweep& sweep, const fs::path& folder, int measuredNow) {
  Report report;
  report.json = parseJson<Json>(toJson(sweep)).value_or(Json());
  report.text =
      fmt::format("{}, {} threads, {}x{}, {} frames x {}; {} settings measured now\n", sweep.processor,
                  sweep.threads, sweep.width, sweep.height, sweep.frames, sweep.repeats, measuredNow);
  report.text += fmt::format("  {:<40} {:>9} {:>8} {:>9} {:>12} {:>12} {:>12} {:>10}\n", "medians", "PSNR",
                             "MS-SSIM", "holes", "frame", "p99", "on disk", "bake");
  for (const SweepPoint& point : sweep.points) report.text += lineOf(point);
  report.text += "worth having (nothing else has less error, quicker frames and fewer bytes at once):\n";
  for (const std::size_t i : frontOf(sweep)) report.text += lineOf(sweep.points[i]);
  for (const SweepPreset& preset : presetsOf(sweep))
    report.text += fmt::format("{:<9} {}\n", preset.name, textOf(preset.setting));
  report.text += toText(sweep.numerics);
  report.text += fmt::format("report: {}; captures of all settings: {}\n", (folder / "sweep.html").string(),
                             captureFolderFor(folder / "sweep.acentric.json").string());
  return report;
}

Result<std::vector<KnobRange>> rangesOf(const SweepOptions& options, const Project& project) {
  std::vector<std::string> names = options.knobs;
  if (names.empty())
    for (const Knob& knob : knobs()) names.push_back(knob.name);
  std::vector<KnobRange> ranges;
  for (const std::string& name : names) {
    auto range = parseKnobRange(name, project);
    if (!range) return tl::unexpected(range.error());
    ranges.push_back(std::move(*range));
  }
  return ranges;
}

Report knobList() {
  Report report;
  report.json["knobs"] = Json::array();
  for (const Knob& knob : knobs()) {
    report.json["knobs"].push_back({{"name", knob.name}, {"what", knob.what}, {"bakes", knob.bakes}});
    report.text += fmt::format("  {:<20} {}{}\n", knob.name, knob.what, knob.bakes ? " (bakes)" : "");
  }
  return report;
}

}  // namespace

Result<Report> runSweep(const SweepOptions& options, const Common& common) {
  if (options.list) return knobList();
  auto walk =
      openAlong(options.project, options.path, options.size, 0, kTourFrames, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  const Project project = walk->storeys.front().project;
  const auto ranges = rangesOf(options, project);
  if (!ranges) return tl::unexpected(ranges.error());
  const BakeSettings truthBake = truthBakeOf(project, *ranges);
  const fs::path folder = options.output.empty() ? sweepFolderFor(options.project) : options.output;
  const auto runner = common.runner();

  Sweep sweep;
  sweep.version = ACENTRIC_VERSION, sweep.commit = commitName(), sweep.processor = processorName(),
  sweep.threads = runner->threads();
  sweep.project = options.project.filename().string(), sweep.scene = walk->storeys.front().scene->name;
  sweep.path = options.path.empty() ? "a tour" : options.path.filename().string();
  sweep.width = walk->size.width, sweep.height = walk->size.height;
  sweep.frames = std::min(options.frames, int(walk->views.size()));
  sweep.repeats = options.repeats, sweep.truthSamples = options.truthSamples;
  sweep.truthPictures = "pictures";
  sweep.fingerprint = fingerprintOf(sweep, *walk, truthBake);
  auto resumed = resume(std::move(sweep), folder, options.again);
  if (!resumed) return tl::unexpected(resumed.error());

  Sweeping sweeping(options, folder, std::move(*resumed), project);
  const SweepRunOptions run{folder, options.frames, options.repeats, options.truthSamples, options.crossings};
  auto started = SweepRun::start(std::move(*walk), truthBake, run, common, *runner);
  if (!started) return tl::unexpected(started.error());
  sweeping.use(**started);
  Status done;
  if (const auto base = sweeping.measure({}, 0); !base) done = tl::unexpected(base.error());
  if (done && options.numerics) done = sweeping.measureNumerics();
  if (done && options.knobs.empty()) done = sweeping.tryPresets();
  if (done) done = sweeping.trySingles(*ranges);
  if (done && options.search) done = sweeping.tryCombinations();
  if (Status written = sweeping.writeAll(); !written) return tl::unexpected(written.error());
  if (!done && done.error().kind == ErrorKind::cancelled)
    return fail(ErrorKind::cancelled, "stopped; what is measured is kept: the same command goes on",
                (folder / kSweepFile).string());
  if (!done) return tl::unexpected(done.error());
  return reportOf(sweeping.sweep(), folder, sweeping.measuredNow());
}

}  // namespace acentric::cli
