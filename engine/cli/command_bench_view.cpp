#include <fmt/format.h>

#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
Result<Report> runBench(const BenchOptions& options, const Common& common) {
  const auto walk = openAlong(options.project, options.path, options.size, 0, options.frames, common);
  if (!walk) return tl::unexpected(walk.error());
  const std::vector<PerspectiveView> views = evenly(walk->views, options.frames);
  const auto runner = common.runner();

  std::vector<std::unique_ptr<FrameMaker>> makers;
  double loadSeconds = 0;
  for (const std::string& name : options.renderers) {
    const Stopwatch watch;
    auto maker = FrameMaker::create(walk->storeys, name, common, *runner, options.reconstruction);
    if (!maker) return tl::unexpected(maker.error());
    if (!makers.empty()) (*maker)->shareWalksOf(*makers.front());
    if (Status loaded = (*maker)->load(views.front().eye); !loaded) return tl::unexpected(loaded.error());
    if (makers.empty()) loadSeconds = watch.seconds();
    makers.push_back(std::move(*maker));
  }
  // Renderers take turns frame by frame, so that a change of the machine's speed meets them all.
  std::vector<std::vector<double>> totals(makers.size()), warps(makers.size());
  std::vector<std::uint64_t> samples(makers.size(), 0);
  for (int repeat = 0; repeat < options.repeats + 1; ++repeat)
    for (std::size_t v = 0; v < views.size(); ++v)
      for (std::size_t m = 0; m < makers.size(); ++m) {
        if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
        if (common.progress)
          common.progress({double(repeat) * double(views.size()) + double(v),
                           double(options.repeats + 1) * double(views.size()), "timing"});
        auto frame = makers[m]->render(views[v]);
        if (!frame) return tl::unexpected(frame.error());
        const FrameStats stats = frame->stats;
        makers[m]->recycle(std::move(*frame));
        if (repeat == 0) continue;  // warms caches and uploads
        totals[m].push_back(stats.totalSeconds * 1e3);
        warps[m].push_back(stats.warpSeconds * 1e3);
        samples[m] += stats.samplesRead;
      }
  Report report;
  report.json = {{"version", ACENTRIC_VERSION},
                 {"processor", processorName()},
                 {"threads", runner->threads()},
                 {"project", options.project.string()},
                 {"width", walk->size.width},
                 {"height", walk->size.height},
                 {"frames", views.size()},
                 {"repeats", options.repeats},
                 {"reconstruction", nameOf(makers.front()->settings.reconstruction)},
                 {"loadSeconds", loadSeconds},
                 {"renderers", Json::array()}};
  report.text = fmt::format("{}, {} threads, {}x{}, {} frames x {}; captures loaded in {:.2f} s\n",
                            processorName(), runner->threads(), walk->size.width, walk->size.height,
                            views.size(), options.repeats, loadSeconds);
  for (std::size_t m = 0; m < makers.size(); ++m) {
    const Spread total = spreadOf(totals[m]), warp = spreadOf(warps[m]);
    double warpMs = 0;
    for (double value : warps[m]) warpMs += value;
    const double rate = warpMs > 0 ? double(samples[m]) / warpMs / 1e3 : 0;
    report.json["renderers"].push_back({{"renderer", options.renderers[m]},
                                        {"frameMsMedian", total.median},
                                        {"frameMsP99", total.p99},
                                        {"warpMsMedian", warp.median},
                                        {"megasamplesPerSecond", rate}});
    report.text +=
        fmt::format("  {:<8} frame {:7.2f} ms median, {:7.2f} ms p99; warp {:7.2f} ms; {:6.0f} M samples/s\n",
                    options.renderers[m], total.median, total.p99, warp.median, rate);
  }
  return report;
}

}  // namespace acentric::cli
