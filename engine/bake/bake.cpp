#include "engine/bake/bake.h"

#include <fmt/format.h>

#include <chrono>
#include <new>

#include "engine/bake/capture_writer.h"

namespace acentric {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class BakeRun {
 public:
  BakeRun(const RayScene& scene, const Layout& layout, const BakeSettings& settings, CaptureSink& sink,
          TaskRunner& runner, const std::stop_token& stop, std::size_t memoryBytes)
      : scene_(scene),
        layout_(layout),
        settings_(settings),
        sink_(sink),
        runner_(runner),
        stop_(stop),
        baker_(scene, settings),
        writer_(sink, memoryBytes, stop) {}

  Status bakeOne(int index) {
    const LayoutCamera& camera = layout_.cameras[std::size_t(index)];
    const EffectPlan& plan = scene_.plan();
    const ColumnCamera columns = columnCameraFor(camera, layout_, scene_.scene().bounds, settings_);
    BakedCamera baked;
    baked.camera = index;
    baked.key = captureKey(scene_.scene(), plan, settings_, camera, columns);
    if (sink_.has(baked.key)) {
      baked.reused = true;
      ++report_.reused;
      report_.cameras.push_back(baked);
      return {};
    }
    const auto start = Clock::now();
    CaptureCounts counts;
    auto capture = baker_.bake(camera, columns, runner_, counts, stop_);
    report_.counts += counts;
    if (!capture) return tl::unexpected(capture.error());
    baked.seconds = secondsSince(start);
    baked.samples = counts.samples;
    sink_.tell(baked.key, baked.samples);
    if (auto put = writer_.put(baked.key, std::move(*capture)); !put) return put;
    ++report_.baked;
    report_.cameras.push_back(baked);
    return {};
  }

  Status finish() { return writer_.finish(); }
  BakeReport takeReport() { return std::move(report_); }

 private:
  const RayScene& scene_;
  const Layout& layout_;
  const BakeSettings& settings_;
  CaptureSink& sink_;
  TaskRunner& runner_;
  std::stop_token stop_;
  BakeReport report_;
  CameraBaker baker_;
  CaptureWriter writer_;
};

}  // namespace

Result<BakeReport> bake(const RayScene& scene, const Layout& layout, const std::vector<int>& which,
                        const BakeSettings& settings, CaptureSink& sink, TaskRunner& runner,
                        const Progress& progress, std::stop_token stop, std::size_t memoryBytes) {
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  for (const int index : which)
    if (index < 0 || std::size_t(index) >= layout.cameras.size())
      return fail(ErrorKind::notFound, fmt::format("no camera {}: the layout has cameras 0..{}", index,
                                                   int(layout.cameras.size()) - 1));
  const auto start = Clock::now();
  try {
    BakeRun run(scene, layout, settings, sink, runner, stop, memoryBytes);
    Status outcome;
    for (std::size_t n = 0; n < which.size() && outcome; ++n) {
      if (progress)
        progress({double(n), double(which.size()),
                  fmt::format("baking camera {} ({} of {})", which[n], n + 1, which.size())});
      if (stop.stop_requested())
        outcome = fail(ErrorKind::cancelled, "the bake was stopped");
      else
        outcome = run.bakeOne(which[n]);
    }
    // Whatever ended the run, what was finished before is written; the sink's own error comes first.
    if (auto written = run.finish(); !written) return tl::unexpected(written.error());
    if (!outcome) return tl::unexpected(outcome.error());
    if (progress) progress({double(which.size()), double(which.size()), "baked"});
    BakeReport report = run.takeReport();
    report.seconds = secondsSince(start);
    return report;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to bake; lower the samples per degree",
                scene.scene().name);
  }
}

}  // namespace acentric
