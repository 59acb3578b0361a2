#include "engine/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>

#include "engine/bake/capture_writer.h"
#include "engine/base/stopwatch.h"

namespace acentric {
namespace {

/// Tells of cameras, from the thread that bakes and those that trace and write, one at a time.
class Teller {
 public:
  Teller(const Progress& progress, const BakeWatch& watch, std::size_t cameras)
      : progress_(progress), watch_(watch), cameras_(cameras) {}

  void begin(std::size_t number, int camera, int columns) {
    const std::lock_guard lock(mutex_);
    number_ = number;
    stage_ = fmt::format("baking camera {} ({} of {})", camera, number + 1, cameras_);
    began_ = Stopwatch();
    now_ = {camera, CameraStage::tracing, false, columns};
    tell();
  }
  void traced(int columns, std::uint64_t rays) {
    const std::lock_guard lock(mutex_);
    now_.columnsDone = std::max(now_.columnsDone, columns);
    now_.rays = std::max(now_.rays, rays);
    tell();
  }
  /// Of the camera last begun: what was told of it.
  CameraNews end(CameraStage stage, std::string error = {}) {
    const std::lock_guard lock(mutex_);
    now_.stage = stage;
    now_.error = std::move(error);
    now_.seconds = began_.seconds();
    if (watch_) watch_(now_);
    return now_;
  }
  void tell(const CameraNews& news) {
    const std::lock_guard lock(mutex_);
    if (watch_) watch_(news);
  }

 private:
  void tell() {
    now_.seconds = began_.seconds();
    if (watch_) watch_(now_);
    const double part = now_.columns > 0 ? double(now_.columnsDone) / now_.columns : 0;
    if (progress_) progress_({double(number_) + part, double(cameras_), stage_});
  }

  const Progress& progress_;
  const BakeWatch& watch_;
  std::size_t cameras_, number_ = 0;
  std::mutex mutex_;
  std::string stage_;
  Stopwatch began_;
  CameraNews now_;
};

/// Tells when captures are on disk, or why not.
class ToldSink final : public CaptureSink {
 public:
  ToldSink(CaptureSink& sink, Teller& teller) : sink_(sink), teller_(teller) {}

  bool has(const ContentKey& key) const override { return sink_.has(key); }
  void tell(const ContentKey& key, const SampleCounts& samples) override { sink_.tell(key, samples); }
  bool passesOver(const ContentKey& key, const Error& error) override { return sink_.passesOver(key, error); }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) override {
    Status done = sink_.put(key, capture, stop);
    CameraNews news = take(key);
    news.stage = done ? CameraStage::done : CameraStage::failed;
    if (!done) news.error = done.error().describe();
    if (done || done.error().kind != ErrorKind::cancelled) teller_.tell(news);
    return done;
  }
  void expect(const ContentKey& key, const CameraNews& news) {
    const std::lock_guard lock(mutex_);
    traced_.emplace(key, news);
  }

 private:
  CameraNews take(const ContentKey& key) {
    const std::lock_guard lock(mutex_);
    return std::move(traced_.extract(key).mapped());
  }

  CaptureSink& sink_;
  Teller& teller_;
  std::mutex mutex_;
  std::multimap<ContentKey, CameraNews> traced_;  ///< those on their way to the disk
};

class BakeRun {
 public:
  BakeRun(const RayScene& scene, const Layout& layout, const BakeSettings& settings, CaptureSink& sink,
          TaskRunner& runner, const std::stop_token& stop, std::size_t memoryBytes, Teller& teller)
      : scene_(scene),
        layout_(layout),
        settings_(settings),
        runner_(runner),
        stop_(stop),
        teller_(teller),
        sink_(sink, teller),
        budget_(memoryBytes),
        baker_(scene, settings, &budget_),
        writer_(sink_, budget_, stop) {}

  Status bakeOne(std::size_t number, int index) {
    const LayoutCamera& camera = layout_.cameras[std::size_t(index)];
    const EffectPlan& plan = scene_.plan();
    const ColumnCamera columns = columnCameraFor(camera, layout_, scene_.scene().bounds, settings_);
    BakedCamera baked;
    baked.camera = index;
    baked.key = captureKey(scene_.scene(), plan, settings_, camera, columns);
    teller_.begin(number, index, columns.columns);
    if (sink_.has(baked.key)) {
      baked.reused = true;
      ++report_.reused;
      report_.cameras.push_back(baked);
      teller_.end(CameraStage::reused);
      return {};
    }
    const Stopwatch watch;
    CaptureCounts counts;
    auto capture = baker_.bake(camera, columns, runner_, counts, stop_,
                               [this](int done, std::uint64_t rays) { teller_.traced(done, rays); });
    report_.counts += counts;
    if (!capture) {
      if (capture.error().kind != ErrorKind::cancelled)
        teller_.end(CameraStage::failed, capture.error().describe());
      return tl::unexpected(capture.error());
    }
    baked.seconds = watch.seconds();
    baked.samples = counts.samples;
    sink_.tell(baked.key, baked.samples);
    sink_.expect(baked.key, teller_.end(CameraStage::writing));
    if (auto put = writer_.put(baked.key, std::move(*capture)); !put) return put;
    ++report_.baked;
    report_.cameras.push_back(baked);
    return {};
  }

  Status finish() { return writer_.finish(); }
  BakeReport takeReport() {
    report_.peakBytes = budget_.peak();
    report_.testEyes = baker_.testEyes();
    return std::move(report_);
  }

 private:
  const RayScene& scene_;
  const Layout& layout_;
  const BakeSettings& settings_;
  TaskRunner& runner_;
  std::stop_token stop_;
  BakeReport report_;
  Teller& teller_;
  ToldSink sink_;
  MemoryBudget budget_;
  CameraBaker baker_;
  CaptureWriter writer_;
};

}  // namespace

Result<BakeReport> bake(const RayScene& scene, const Layout& layout, const std::vector<int>& which,
                        const BakeSettings& settings, CaptureSink& sink, TaskRunner& runner,
                        const Progress& progress, std::stop_token stop, std::size_t memoryBytes,
                        const BakeWatch& watch) {
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  for (const int index : which)
    if (index < 0 || std::size_t(index) >= layout.cameras.size())
      return fail(ErrorKind::notFound, fmt::format("no camera {}: the layout has cameras 0..{}", index,
                                                   int(layout.cameras.size()) - 1));
  const Stopwatch clock;
  try {
    Teller teller(progress, watch, which.size());
    BakeRun run(scene, layout, settings, sink, runner, stop, memoryBytes, teller);
    Status outcome;
    for (std::size_t n = 0; n < which.size() && outcome; ++n) {
      if (stop.stop_requested())
        outcome = fail(ErrorKind::cancelled, "the bake was stopped");
      else
        outcome = run.bakeOne(n, which[n]);
    }
    // Whatever ended the run, what was finished before is written; the sink's own error comes first.
    if (auto written = run.finish(); !written) return tl::unexpected(written.error());
    if (!outcome) return tl::unexpected(outcome.error());
    if (progress) progress({double(which.size()), double(which.size()), "baked"});
    BakeReport report = run.takeReport();
    report.seconds = clock.seconds();
    return report;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to bake; lower the samples per degree",
                scene.scene().name);
  }
}

}  // namespace acentric
