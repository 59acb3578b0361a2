#include <fmt/format.h>

#include <numeric>

#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

/// Milliseconds of frames, by part.
struct Timings {
  std::vector<double> total, processor, plan, warp, local, fill;
  double samplesRead = 0, samplesDrawn = 0, localTriangles = 0;

  void add(const FrameStats& stats, double processorSeconds) {
    processor.push_back(processorSeconds * 1e3);
    total.push_back(stats.totalSeconds * 1e3), plan.push_back(stats.planSeconds * 1e3);
    warp.push_back(stats.warpSeconds * 1e3), local.push_back(stats.localSeconds * 1e3);
    fill.push_back(stats.fillSeconds * 1e3);
    samplesRead += double(stats.samplesRead), samplesDrawn += double(stats.samplesDrawn);
    localTriangles += double(stats.localTriangles);
  }
};

/// Bytes that are read of a sample.
constexpr double kBytesPerSample = sizeof(PackedSample) + sizeof(Rgba8);

/// Bytes per second that all threads together read from memory, one after the other: no warp can be faster.
double streamingReadRate(TaskRunner& runner) {
  constexpr std::size_t kWords = std::size_t(32) << 20, kParts = 64;
  const std::vector<std::uint64_t> memory(kWords, 1);
  std::vector<std::uint64_t> sums(kParts);
  double best = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Stopwatch watch;
    runner.parallelFor(kParts, [&](std::size_t part) {
      const auto from = memory.begin() + std::ptrdiff_t(part * (kWords / kParts));
      sums[part] = std::accumulate(from, from + std::ptrdiff_t(kWords / kParts), std::uint64_t(0));
    });
    if (std::accumulate(sums.begin(), sums.end(), std::uint64_t(0)) == kWords)
      best = std::max(best, double(kWords * sizeof(std::uint64_t)) / watch.seconds());
  }
  return best;
}

Json spreadJson(const std::vector<double>& values) {
  const Spread spread = spreadOf(values);
  return {{"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
}

}  // namespace

Result<Report> runBench(const BenchOptions& options, const Common& common) {
  if (options.stream) return runBenchStream(options, common);
  const auto walk = openAlong(options.project, options.path, options.size, 0, options.frames, common);
  if (!walk) return tl::unexpected(walk.error());
  const std::vector<PerspectiveView> views = spreadAlong(*walk, options.frames);
  const auto runner = common.runner();

  std::vector<std::unique_ptr<FrameMaker>> makers;
  std::vector<std::string> names;  // of the makers
  Json leftOut = Json::array();
  double loadSeconds = 0;
  for (const std::string& name : options.renderers) {
    const Stopwatch watch;
    auto maker = FrameMaker::create(walk->storeys, name, common, *runner, options.look);
    if (!maker) return tl::unexpected(maker.error());
    if (!makers.empty()) (*maker)->shareWalksOf(*makers.front());
    if (Status loaded = (*maker)->load(views.front()); !loaded) {
      if (!options.leaveOut || loaded.error().kind != ErrorKind::tooLarge)
        return tl::unexpected(loaded.error());
      leftOut.push_back({{"renderer", name}, {"why", loaded.error().message}});
      continue;
    }
    if (makers.empty()) loadSeconds = watch.seconds();
    makers.push_back(std::move(*maker));
    names.push_back(name);
  }
  if (makers.empty())
    return fail(ErrorKind::tooLarge, "no renderer can hold the scene", options.project.string());
  // Renderers take turns frame by frame, so that a change of the machine's speed meets them all.
  std::vector<Timings> timings(makers.size());
  for (int repeat = 0; repeat < options.repeats + 1; ++repeat)
    for (std::size_t v = 0; v < views.size(); ++v)
      for (std::size_t m = 0; m < makers.size(); ++m) {
        if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
        if (common.progress)
          common.progress({double(repeat) * double(views.size()) + double(v),
                           double(options.repeats + 1) * double(views.size()), "timing"});
        const double before = processorSeconds();
        auto frame = makers[m]->render(views[v]);
        const double took = processorSeconds() - before;
        if (!frame) return tl::unexpected(frame.error());
        const FrameStats stats = frame->stats;
        makers[m]->recycle(std::move(*frame));
        if (repeat == 0) continue;  // warms caches and uploads
        timings[m].add(stats, took);
      }
  const double readRate = streamingReadRate(*runner);
  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"triangles", walk->storeys.front().imported->shownTriangleCount()},
                      {"width", walk->size.width},
                      {"height", walk->size.height},
                      {"frames", views.size()},
                      {"repeats", options.repeats},
                      {"reconstruction", nameOf(makers.front()->settings.reconstruction)},
                      {"loadSeconds", loadSeconds},
                      {"readGigabytesPerSecond", readRate / 1e9},
                      {"renderers", Json::array()},
                      {"leftOut", leftOut}});
  report.text = fmt::format("{}, {} threads, {}x{}, {} frames x {}; the first captures loaded in {:.2f} s\n",
                            processorName(), runner->threads(), walk->size.width, walk->size.height,
                            views.size(), options.repeats, loadSeconds);
  report.text += fmt::format("  memory is read at {:.1f} GB/s\n", readRate / 1e9);
  for (std::size_t m = 0; m < makers.size(); ++m) {
    const Timings& t = timings[m];
    const double frames = double(t.total.size());
    const double warpSeconds = std::accumulate(t.warp.begin(), t.warp.end(), 0.0) / 1e3;
    const double rate = warpSeconds > 0 ? t.samplesRead / warpSeconds : 0;
    const Spread total = spreadOf(t.total), warp = spreadOf(t.warp);
    report.json["renderers"].push_back({{"renderer", names[m]},
                                        {"frameMs", spreadJson(t.total)},
                                        {"processorMs", spreadJson(t.processor)},
                                        {"planMs", spreadJson(t.plan)},
                                        {"warpMs", spreadJson(t.warp)},
                                        {"localMs", spreadJson(t.local)},
                                        {"fillMs", spreadJson(t.fill)},
                                        {"samplesReadPerFrame", t.samplesRead / frames},
                                        {"samplesDrawnPerFrame", t.samplesDrawn / frames},
                                        {"localTrianglesPerFrame", t.localTriangles / frames},
                                        {"megasamplesPerSecond", rate / 1e6},
                                        {"shareOfReadRate", rate * kBytesPerSample / readRate}});
    report.text +=
        fmt::format("  {:<11} frame {:8.2f} ms median, {:8.2f} p99", names[m], total.median, total.p99);
    if (rate > 0)
      report.text += fmt::format(
          "; plan {:.2f}, warp {:.2f} (p99 {:.2f}), local {:.2f}, fill {:.2f}; {:.0f} M samples/s",
          spreadOf(t.plan).median, warp.median, warp.p99, spreadOf(t.local).median, spreadOf(t.fill).median,
          rate / 1e6);
    report.text += "\n";
  }
  for (const Json& each : leftOut)
    report.text += fmt::format("  {:<11} left out: {}\n", each["renderer"].get<std::string>(),
                               each["why"].get<std::string>());
  return report;
}

}  // namespace acentric::cli
