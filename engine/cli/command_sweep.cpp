/// acentric sweep: settings of a project against each other, and what is worth having of them.

#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/sweeping.h"
#include "engine/measure/sweep_search.h"
#include "engine/pipeline/bake_presets.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

/// Of the time, kept for combinations while choices are tried one at a time.
constexpr double kSearchShare = 0.3;
/// That the qualities of a bake may take of it, at most.
constexpr double kPresetShare = 0.3;

/// What the editor offers as qualities of a bake.
Status tryPresets(Sweeping& sweeping, const SweepOptions& options, const Project& project) {
  const double until = std::max(0.0, sweeping.secondsLeft() - kPresetShare * 60 * options.budgetMinutes);
  for (const BakePreset preset : kBakePresets) {
    const SweepSetting setting = settingOf(project, preset);
    if (setting.empty()) continue;
    if (const auto point = sweeping.measure(setting, sweeping.secondsLeft() - until); !point)
      return tl::unexpected(point.error());
  }
  return {};
}

/// One choice at a time.
Status trySingles(Sweeping& sweeping, const SweepOptions& options, const std::vector<KnobRange>& ranges) {
  const double kept = options.search ? kSearchShare * 60 * options.budgetMinutes : 0;
  for (const bool bakes : {false, true})
    for (const KnobRange& range : ranges) {
      if (range.knob->bakes != bakes) continue;
      for (const std::string& value : range.values)
        if (const auto point = sweeping.measure({{range.knob->name, value}}, sweeping.secondsLeft() - kept);
            !point)
          return tl::unexpected(point.error());
    }
  return {};
}

Status tryCombinations(Sweeping& sweeping, const Project& project) {
  std::map<SweepSetting, Objectives> known;
  for (const SweepPoint& point : sweeping.sweep().points)
    if (point.measured()) known[point.setting] = objectivesOf(point);
  SearchHost host;
  host.inOrder = [&](SweepSetting setting) {
    auto ordered = inOrder(setting, project);
    return ordered ? std::move(*ordered) : std::move(setting);
  };
  host.goOn = [&] { return sweeping.goesOn(); };
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<Objectives>> {
    const auto point = sweeping.measure(setting, sweeping.secondsLeft());
    if (!point) return tl::unexpected(point.error());
    return (*point)->measured() ? std::optional(objectivesOf(**point)) : std::nullopt;
  };
  const auto found = searchCombinations(std::move(known), host);
  if (!found) return tl::unexpected(found.error());
  return {};
}

/// Of the project as it is, unless an earlier call has done so.
Status measureNumerics(Sweeping& sweeping, SweepRun& run) {
  if (!sweeping.sweep().numerics.empty()) return {};
  auto numerics = run.numerics();
  if (!numerics) return tl::unexpected(numerics.error());
  sweeping.sweep().numerics = std::move(*numerics);
  return sweeping.write();
}

std::vector<std::string> knobNames(const SweepOptions& options) {
  if (!options.knobs.empty()) return options.knobs;
  std::vector<std::string> names;
  for (const Knob& knob : knobs()) names.push_back(knob.name);
  return names;
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
  const auto ranges = rangesOf(knobNames(options), project);
  if (!ranges) return tl::unexpected(ranges.error());
  const BakeSettings truthBake = truthBakeOf(project, *ranges);
  const fs::path folder = options.output.empty() ? sweepFolderFor(options.project) : options.output;
  const auto runner = common.runner();
  const SweepRunOptions run{folder, options.frames, options.repeats, options.truthSamples, options.crossings};
  auto resumed =
      resume(sweepOf(*walk, options.project, options.path, truthBake, run, *runner), folder, options.again);
  if (!resumed) return tl::unexpected(resumed.error());

  Sweeping sweeping(folder, std::move(*resumed), options.budgetMinutes);
  auto started = SweepRun::start(std::move(*walk), truthBake, run, common, *runner);
  if (!started) return tl::unexpected(started.error());
  sweeping.use(**started);
  Status done;
  if (const auto base = sweeping.measure({}, 0); !base) done = tl::unexpected(base.error());
  if (done && options.numerics) done = measureNumerics(sweeping, **started);
  if (done && options.knobs.empty()) done = tryPresets(sweeping, options, project);
  if (done) done = trySingles(sweeping, options, *ranges);
  if (done && options.search) done = tryCombinations(sweeping, project);
  if (Status written = sweeping.writeAll(); !written) return tl::unexpected(written.error());
  if (Status ended = withWayOn(done, folder); !ended) return tl::unexpected(ended.error());
  Report report = reportOf(sweeping.sweep(), sweeping.measuredNow());
  report.text += fmt::format("report: {}; captures of all settings: {}\n", (folder / "sweep.html").string(),
                             captureFolderFor(folder / "sweep.acentric.json").string());
  return report;
}

}  // namespace acentric::cli
