#include "engine/cli/sweeping.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/cli/machine/commit.h"
#include "engine/cli/machine/machine.h"
#include "engine/measure/sweep_report.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

/// All that figures may only be compared within.
std::string fingerprintOf(const Sweep& sweep, const PathWalk& walk, const BakeSettings& truthBake,
                          bool viewsOnly) {
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
  if (viewsOnly) hasher.text("captures of the frames alone");
  return hasher.finish().toHex();
}

}  // namespace

Result<const SweepPoint*> Sweeping::measure(const SweepSetting& setting, double seconds) {
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

Status Sweeping::write() const {
  if (Status written = writeTextAtomically(folder_ / kSweepFile, toJson(sweep_)); !written) return written;
  if (Status written = writeTextAtomically(folder_ / "sweep.csv", toCsv(sweep_)); !written) return written;
  if (sweep_.numerics.empty()) return {};
  return writeTextAtomically(folder_ / "numerics.csv", toCsv(sweep_.numerics));
}

Status Sweeping::writeAll() const {
  if (Status written = write(); !written) return written;
  const auto html = sweepReport(sweep_, folder_);
  if (!html) return tl::unexpected(html.error());
  return writeTextAtomically(folder_ / "sweep.html", *html);
}

Sweep sweepOf(const PathWalk& walk, const fs::path& project, const fs::path& path,
              const BakeSettings& truthBake, const SweepRunOptions& options, const TaskRunner& runner) {
  Sweep sweep;
  sweep.version = ACENTRIC_VERSION, sweep.commit = commitName(), sweep.processor = processorName(),
  sweep.threads = runner.threads();
  sweep.project = project.filename().string(), sweep.scene = walk.storeys.front().scene->name;
  sweep.path = path.empty() ? "a tour" : path.filename().string();
  sweep.width = walk.size.width, sweep.height = walk.size.height;
  sweep.frames = std::min(options.frames, int(walk.views.size()));
  sweep.repeats = options.repeats, sweep.truthSamples = options.truthSamples;
  sweep.truthPictures = "pictures";
  sweep.fingerprint = fingerprintOf(sweep, walk, truthBake, options.viewsOnly);
  return sweep;
}

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

Result<std::vector<KnobRange>> rangesOf(const std::vector<std::string>& names, const Project& project) {
  std::vector<KnobRange> ranges;
  for (const std::string& name : names) {
    auto range = parseKnobRange(name, project);
    if (!range) return tl::unexpected(range.error());
    ranges.push_back(std::move(*range));
  }
  return ranges;
}

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

std::string lineOf(const SweepPoint& point) {
  if (!point.measured()) return fmt::format("  {:<40} skipped: {}\n", textOf(point.setting), point.skipped);
  const Spread& bake = point[Measure::bakeSeconds];
  return fmt::format("  {:<40} {:6.2f} dB {:8.4f} {:7.2f} % {:9.2f} ms {:9.2f} ms {:9.1f} MB {:>10}{}\n",
                     textOf(point.setting), point[Measure::psnr].median, point[Measure::msSsim].median,
                     100 * point[Measure::holeShare].median, point[Measure::frameMs].median,
                     point[Measure::frameP99Ms].median, point[Measure::bytes].median / 1e6,
                     bake.count > 0 ? timeText(bake.median) : std::string("-"),
                     point.bakeEstimated ? " predicted" : "");
}

Report reportOf(const Sweep& sweep, int measuredNow) {
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
  return report;
}

Status withWayOn(const Status& done, const fs::path& folder) {
  if (done || done.error().kind != ErrorKind::cancelled) return done;
  return fail(ErrorKind::cancelled, "stopped; what is measured is kept: the same command goes on",
              (folder / kSweepFile).string());
}

}  // namespace acentric::cli
