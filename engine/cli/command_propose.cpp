/// acentric propose: a layout and settings that keep to goals.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/bake/bake.h"
#include "engine/cli/sweeping.h"
#include "engine/measure/goal_search.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kResolution = "samples-per-degree";

/// What layouts and captures may be: what changes their light or how they are drawn is the designer's to say.
std::vector<std::string> usualKnobs(const Project& project) {
  std::string cells = "cell-size=";
  for (const double factor : {0.5, 0.7, 1.4, 2.0})
    cells += fmt::format("{}{:.4g}", cells.back() == '=' ? "" : "/", factor * project.layout().cellSize);
  return {"configuration", std::move(cells), "near-band", "layers", "colour-quality", "reconstruction"};
}

/// Of a setting what its captures depend on.
SweepSetting bakedPart(SweepSetting setting) {
  std::erase_if(setting, [](const KnobChoice& choice) { return !(*knobOf(choice.knob))->bakes; });
  return setting;
}

/// Of all captures of settings. Layouts are made once.
class PixelCount {
 public:
  explicit PixelCount(const OpenProject& base) : base_(base.project), bounds_(base.scene->bounds) {}

  double of(const SweepSetting& setting) {
    SweepSetting layout = bakedPart(setting);
    double resolution = base_.bake.samplesPerDegree;
    for (const KnobChoice& choice : layout)
      if (choice.knob == kResolution) resolution = std::strtod(choice.value.c_str(), nullptr);
    std::erase_if(layout, [](const KnobChoice& choice) { return choice.knob == kResolution; });
    const auto [known, fresh] = atUsual_.try_emplace(layout, 0);
    if (fresh) known->second = count(layout);
    const double finer = resolution / base_.bake.samplesPerDegree;
    return known->second * finer * finer;
  }

 private:
  double count(const SweepSetting& setting) const {
    const auto project = applySetting(base_, setting);
    const auto layout = project ? buildLayout(project->layout()) : tl::unexpected(project.error());
    if (!layout) return 0;
    double pixels = 0;
    for (const LayoutCamera& camera : layout->cameras) {
      const ColumnCamera columns = columnCameraFor(camera, *layout, bounds_, project->bake);
      pixels += double(columns.columns) * columns.rows;
    }
    return pixels;
  }

  Project base_;
  Bounds bounds_;
  std::map<SweepSetting, double> atUsual_;
};

Status search(Sweeping& sweeping, const SweepRun& run, const std::vector<KnobRange>& ranges,
              PixelCount& pixels, const Project& project) {
  std::map<SweepSetting, GoalFigures> known;
  for (const SweepPoint& point : sweeping.sweep().points)
    if (point.measured()) known[point.setting] = figuresOf(point);
  GoalChoices choices{
      {}, kResolution, project.bake.samplesPerDegree, kLeastSamplesPerDegree, kMostSamplesPerDegree};
  for (const KnobRange& range : ranges)
    for (const std::string& value : range.values)
      if (range.knob->name != kResolution) choices.choices.push_back({range.knob->name, value});
  GoalHost host;
  host.inOrder = [&](SweepSetting setting) {
    auto ordered = inOrder(setting, project);
    return ordered ? std::move(*ordered) : std::move(setting);
  };
  host.pixels = [&](const SweepSetting& setting) { return pixels.of(setting); };
  host.seconds = [&](const SweepSetting& setting) {
    const SweepSetting baked = bakedPart(setting);
    const bool there = std::ranges::any_of(sweeping.sweep().points, [&](const SweepPoint& point) {
      return point.measured() && bakedPart(point.setting) == baked;
    });
    const double seconds =
        sweeping.measureSeconds() + (there ? 0 : run.secondsPerPixel() * run.share() * pixels.of(setting));
    return seconds <= sweeping.secondsLeft() ? seconds : std::numeric_limits<double>::infinity();
  };
  host.goOn = [&] { return sweeping.goesOn(); };
  host.measure = [&](const SweepSetting& setting) -> Result<std::optional<GoalFigures>> {
    const auto point = sweeping.measure(setting, sweeping.secondsLeft());
    if (!point) return tl::unexpected(point.error());
    return (*point)->measured() ? std::optional(figuresOf(**point)) : std::nullopt;
  };
  const auto found = searchForGoals(std::move(known), *sweeping.sweep().goals, choices, host);
  if (!found) return tl::unexpected(found.error());
  return {};
}

Goals goalsOf(const ProposeOptions& options) {
  Goals goals;
  if (options.mostMegabytes > 0) goals.mostBytes = options.mostMegabytes * 1e6;
  if (options.mostMilliseconds > 0) goals.mostFrameMs = options.mostMilliseconds;
  if (options.leastPsnr > 0) goals.leastPsnr = options.leastPsnr;
  return goals;
}

Report proposalReport(Sweeping& sweeping) {
  const Sweep& sweep = sweeping.sweep();
  const SweepPoint& best = *proposalOf(sweep, *sweep.goals);
  const double miss = missOf(*sweep.goals, figuresOf(best));
  Report report = reportOf(sweep, sweeping.measuredNow());
  report.text +=
      fmt::format("{}: {}\n{}", textOf(*sweep.goals),
                  miss <= 0 ? "kept by" : "not kept by anything that was measured; nearest is", lineOf(best));
  report.text += "bytes and bake are extrapolated from the captures that the frames are painted from\n";
  report.json["met"] = miss <= 0;
  report.json["miss"] = miss;
  return report;
}

}  // namespace

Result<Report> runPropose(const ProposeOptions& options, const Common& common) {
  const Goals goals = goalsOf(options);
  if (Status sound = goals.check(); !sound) return tl::unexpected(sound.error());
  auto walk =
      openAlong(options.project, options.path, options.size, 0, kTourFrames, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  const Project project = walk->storeys.front().project;
  const auto ranges = rangesOf(options.knobs.empty() ? usualKnobs(project) : options.knobs, project);
  if (!ranges) return tl::unexpected(ranges.error());
  const BakeSettings truthBake = truthBakeOf(project, *ranges);
  const fs::path folder = options.output.empty() ? goalsFolderFor(options.project) : options.output;
  const auto runner = common.runner();
  constexpr int kCrossings = 0;
  const SweepRunOptions run{folder, options.frames, options.repeats, options.truthSamples, kCrossings, true};
  Sweep fresh = sweepOf(*walk, options.project, options.path, truthBake, run, *runner);
  // What was measured of another state of the project is of no use any more.
  Sweeping sweeping(folder, resume(fresh, folder, options.again).value_or(fresh), options.budgetMinutes);
  sweeping.sweep().goals = goals;
  PixelCount pixels(walk->storeys.front());
  auto started = SweepRun::start(std::move(*walk), truthBake, run, common, *runner);
  if (!started) return tl::unexpected(started.error());
  sweeping.use(**started);
  Status done;
  if (const auto base = sweeping.measure({}, 0); !base) done = tl::unexpected(base.error());
  if (done) done = search(sweeping, **started, *ranges, pixels, project);
  if (Status written = sweeping.writeAll(); !written) return tl::unexpected(written.error());
  if (Status ended = withWayOn(done, folder); !ended) return tl::unexpected(ended.error());
  Report report = proposalReport(sweeping);
  report.json["applied"] = false;
  if (!options.apply) {
    report.text += fmt::format("to take it: acentric preset {} proposal --from {} --apply\n",
                               options.project.string(), folder.string());
    return report;
  }
  const auto applied = runPreset({options.project, folder, "proposal", true}, common);
  if (!applied) return tl::unexpected(applied.error());
  report.json["applied"] = true;
  report.text += applied->text;
  return report;
}

}  // namespace acentric::cli
