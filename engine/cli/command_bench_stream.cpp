#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/base/physical_memory.h"
#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/cli/stream_frames.h"
#include "engine/measure/statistics.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric::cli {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;
}  // namespace

Result<Report> runBenchStream(const BenchOptions& options, const Common& common) {
  giveBackLargeMemory();
  const auto walk =
      openAlong(options.project, options.path, options.size, 0, options.frames, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  const OpenProject& open = walk->storeys.front();
  ViewSettings settings = open.project.view;
  const auto renderer = parseRenderer(options.renderers.front());
  if (!renderer) return tl::unexpected(renderer.error());
  settings.renderer = *renderer;
  if (Status applied = apply(options.look, settings); !applied) return tl::unexpected(applied.error());
  const auto runner = common.runner();
  auto drawing = StreamRenderer::open(settings, options.waitForCaptures, *runner);
  if (!drawing) return tl::unexpected(drawing.error());
  const std::uint64_t residentBefore = peakResidentBytes();

  const Stopwatch clock;
  auto start = startWalk(open, nullptr);
  if (!start) return tl::unexpected(start.error());
  const TimedPath path(walk->views, options.metresPerSecond);
  WalkStreamOptions streaming;
  streaming.memoryBytes = common.walkBytes();
  streaming.panoramas = settings.secondaryCover;
  const auto first = path.at(0);
  streaming.where = {glm::dvec2(first.view.eye), first.view.yawRadians, first.velocity};
  WalkStream stream(std::move(*start), streaming);
  const double openSeconds = clock.seconds();

  WalkTally tally;
  const Stopwatch walking;
  for (bool last = false; !last;) {
    if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    const Stopwatch frameTime;
    const double now = walking.seconds();
    last = now >= path.seconds();
    auto [view, velocity] = path.at(now);
    view.eye = clampToLayout(*open.layout, view.eye);
    if (common.progress) common.progress({std::min(now, path.seconds()), path.seconds(), "walking"});
    const Stopwatch taking;
    stream.go({glm::dvec2(view.eye), view.yawRadians, velocity});
    const auto snapshot = stream.walk();
    tally.takeMs.push_back(taking.seconds() * 1e3);
    const auto drawn = drawing->draw(snapshot->walk, view);
    if (!drawn) return tl::unexpected(drawn.error());
    tally.frameMs.push_back(frameTime.seconds() * 1e3);
    tally.count(*snapshot, camerasOf(*open.layout, view, settings), now);
    tally.count(*drawn);
    const double rest = kFrameSeconds - frameTime.seconds();
    if (rest > 0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
  }

  const Spread frames = spreadOf(tally.frameMs), takes = spreadOf(tally.takeMs),
               sending = spreadOf(tally.sendMs);
  const WalkStreamStats stats = stream.stats();
  const auto count = tally.frameMs.size();
  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"renderer", options.renderers.front()},
                      {"width", walk->size.width},
                      {"height", walk->size.height},
                      {"metresPerSecond", options.metresPerSecond},
                      {"walkSeconds", path.seconds()},
                      {"openSeconds", openSeconds},
                      {"firstFullSeconds", tally.firstFullSeconds},
                      {"frames", count},
                      {"incompleteFrames", tally.incomplete},
                      {"coarseFrames", tally.coarse},
                      {"frameMsMedian", frames.median},
                      {"frameMsP99", frames.p99},
                      {"frameMsMax", frames.max},
                      {"snapshotMsMax", takes.max},
                      {"limitBytes", stats.limitBytes},
                      {"peakBytes", stats.peakBytes},
                      {"beyondLimitBytes", stats.beyondLimit},
                      {"residentBytesBefore", residentBefore},
                      {"residentBytesPeak", peakResidentBytes()},
                      {"loads", stats.loads},
                      {"coarseLoads", stats.coarseLoads},
                      {"evictions", stats.evictions},
                      {"warnings", stream.takeWarnings()}});
  report.text = fmt::format(
      "{}, {} threads, {}x{}, {:.1f} s walked at {:.2f} m/s; ready in {:.2f} s, all of a view there after "
      "{:.2f} s\n"
      "  {} frames: {} with coarse captures, {} with captures missing\n"
      "  frame {:.2f} ms median, {:.2f} ms p99, {:.2f} ms max; taking the captures {:.3f} ms max\n"
      "  captures {} of {} at most; {} loads, {} coarse, {} evictions; {} resident at most ({} before)\n",
      processorName(), runner->threads(), walk->size.width, walk->size.height, path.seconds(),
      options.metresPerSecond, openSeconds, tally.firstFullSeconds, count, tally.coarse, tally.incomplete,
      frames.median, frames.p99, frames.max, takes.max, bytesText(stats.peakBytes),
      bytesText(stats.limitBytes), stats.loads, stats.coarseLoads, stats.evictions,
      bytesText(peakResidentBytes()), bytesText(residentBefore));
  if (onOpenGl(settings.renderer)) {
    report.json["gl"] = {{"awaitingFrames", tally.awaiting}, {"unsentFrames", tally.unsent},
                         {"sendMsMedian", sending.median},   {"sendMsP99", sending.p99},
                         {"sendMsMax", sending.max},         {"mostBytesSent", tally.mostSent}};
    report.text += fmt::format(
        "  to the graphics card {:.2f} ms p99, {:.2f} ms max, {} at most in a frame; {} frames with captures "
        "on "
        "their way there, {} with nothing in their place\n",
        sending.p99, sending.max, bytesText(tally.mostSent), tally.awaiting, tally.unsent);
  }
  return report;
}

}  // namespace acentric::cli
