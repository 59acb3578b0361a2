#include <fmt/format.h>

#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"

namespace acentric::cli {
namespace {

double perSecond(double count, double seconds) { return seconds > 0 ? count / seconds / 1e6 : 0; }

Json toJson(const BakeBenchSet& set) {
  return {{"name", set.name},
          {"effects", set.effects},
          {"seconds", set.seconds},
          {"megapixelsPerSecond", perSecond(set.firstRays, set.seconds)},
          {"primaryMegaraysPerSecond", perSecond(double(set.counts.rays.primary), set.seconds)},
          {"megaraysPerSecond", perSecond(double(set.counts.rays.total()), set.seconds)},
          {"shareOfTracer", set.primaryShare},
          {"tracerShare", set.tracerShare},
          {"gatherSeconds", set.gatherSeconds},
          {"parts", cli::toJson(set.counts.seconds)},
          {"rays", cli::toJson(set.counts.rays)},
          {"samples", cli::toJson(set.counts.samples)}};
}

}  // namespace

Result<Report> runBenchBake(const BenchBakeOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  BakeBenchOptions benching = options.bench;
  benching.tell = tellerTo(common);
  const auto bench = benchBake(*open, benching, *runner, common.progress, common.stop);
  if (!bench) return tl::unexpected(bench.error());
  const double scaling =
      bench->oneThreadSeconds > 0 ? bench->oneThreadSeconds / bench->sets.back().seconds : 1;
  const BakeBenchBytes& bytes = bench->bytes;
  const double cameras = bench->cameras;
  const auto perCamera = [&](double all) { return bytesText(std::uint64_t(all / cameras)); };
  const BakeBenchSet& final = bench->sets.back();
  const CaptureSeconds& parts = final.counts.seconds;
  Report report;
  report.json = measuredOn(bench->threads);
  report.json.update({{"project", options.project.string()},
                      {"cameras", bench->cameras},
                      {"side", bench->side},
                      {"tracer",
                       {{"seconds", bench->tracerSeconds},
                        {"megaraysPerSecond", perSecond(bench->firstRays, bench->tracerSeconds)}}},
                      {"sets", Json::array()},
                      {"ringToFilesSeconds", bench->ringSeconds},
                      {"oneThreadSeconds", bench->oneThreadSeconds},
                      {"scaling", scaling},
                      {"seconds",
                       {{"tracing", bench->sets.front().seconds},
                        {"shading", bench->shadingSeconds},
                        {"encoding", bench->encodingSeconds},
                        {"writing", bench->writingSeconds}}},
                      {"bytesPerCamera",
                       {{"everySurface", bytes.everySurface / cameras},
                        {"pruned", bytes.pruned / cameras},
                        {"surfaces", bytes.surfaces / cameras},
                        {"quantised", bytes.quantised / cameras},
                        {"pack", bytes.pack / cameras}}}});
  report.text = fmt::format(
      "{}, {} threads: a ring of {} cameras of {} x {} pixels\n  {:<16} {:7.2f} s, {:6.1f} M rays/s\n",
      processorName(), bench->threads, bench->cameras, bench->side, bench->side, "tracer alone",
      bench->tracerSeconds, perSecond(bench->firstRays, bench->tracerSeconds));
  for (const BakeBenchSet& set : bench->sets) {
    report.json["sets"].push_back(toJson(set));
    report.text += fmt::format(
        "  {:<16} {:7.2f} s, {:6.1f} M rays/s, {:6.1f} M primary ({:.0f} %); tracer {:.0f} %; {} "
        "samples\n",
        set.name, set.seconds, perSecond(double(set.counts.rays.total()), set.seconds),
        perSecond(double(set.counts.rays.primary), set.seconds), 100 * set.primaryShare,
        100 * set.tracerShare, countText(set.counts.samples.keptInAll()));
  }
  report.text += fmt::format(
      "  one shadow ray, files written: {:.2f} s\n"
      "  one layer: tracing {:.2f} s, shading {:.2f} s\n"
      "  final: choosing test eyes {:.2f} s, what they see {:.2f} s, march {:.2f} s, silhouettes {:.2f} s, "
      "facets edge on {:.2f} s, rounding {:.2f} s; gathering light, once, {:.2f} s; encoding {:.2f} s and "
      "writing {:.2f} s on one thread behind them\n"
      "  bytes a camera, final: every surface {}, what some region sees {}, the background "
      "as runs of rows {}, distances of 16 bits {}; packed {}\n"
      "  1 to {} threads: {:.2f} times as fast\n",
      bench->ringSeconds, bench->sets.front().seconds, bench->shadingSeconds, parts.testEyes, parts.eyeViews,
      parts.march, parts.silhouettes, parts.edgeOn, parts.rounding, final.gatherSeconds,
      bench->encodingSeconds, bench->writingSeconds, perCamera(bytes.everySurface), perCamera(bytes.pruned),
      perCamera(bytes.surfaces), perCamera(bytes.quantised), perCamera(bytes.pack), bench->threads, scaling);
  return report;
}

}  // namespace acentric::cli
