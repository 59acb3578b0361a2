#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <set>
#include <thread>

#include "engine/base/physical_memory.h"
#include "engine/base/stopwatch.h"
#include "engine/bench/repeated_walk.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/stream_frames.h"
#include "engine/export/counted_ranges.h"
#include "engine/measure/statistics.h"
#include "engine/picture/chart.h"
#include "engine/picture/drawing.h"
#include "engine/pipeline/paged_walk.h"
#include "engine/pipeline/trial_folder.h"

namespace acentric::cli {
namespace {

constexpr double kStepSeconds = 1.0 / 30;
/// For captures, where nothing else is said: less than a page's take, so that they come and go.
constexpr double kUsualMegabytes = 128;
constexpr double kLongestWaitSeconds = 60;

double threadSeconds() {
  timespec time{};
  (void)::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// How often this thread waited for something, a lock for example.
long waits() {
  rusage usage{};
  (void)::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

/// Legs of whole cells along the lattice, straight on for most of the way, with turns to either side; where
/// the layout ends it goes back. Beside the middles of rings, where pillars stand.
std::vector<PerspectiveView> legsThrough(const RepeatedCell& cell, const glm::ivec2& cells, double metres,
                                         const PerspectiveView& like) {
  struct Leg {
    glm::ivec2 direction;
    int cells;
  };
  constexpr std::array<Leg, 4> kLegs{Leg{{1, 0}, 6}, Leg{{0, 1}, 2}, Leg{{1, 0}, 4}, Leg{{0, -1}, 2}};
  constexpr glm::dvec2 kBeside(-0.15, 0.2);
  const glm::ivec2 last = glm::max(cells - 2, glm::ivec2(0));  // the eye stays within the last cells' regions
  glm::ivec2 at = (last + 1) / 2;
  int forwards = 1;
  std::vector<PerspectiveView> views;
  const auto stand = [&](double yaw) {
    PerspectiveView view = like;
    const glm::dvec2 place = cell.spec().latticeOrigin + (at.x + kBeside.x) * cell.step(1, 0) +
                             (at.y + kBeside.y) * cell.step(0, 1);
    view.eye = {place, cell.spec().floorHeight + cell.spec().eyeHeight};
    view.yawRadians = yaw;
    views.push_back(view);
  };
  double walked = 0;
  for (std::size_t leg = 0; walked < metres && views.size() < 100000; ++leg) {
    const Leg& next = kLegs[leg % kLegs.size()];
    for (int n = 0; n < next.cells && walked < metres; ++n) {
      glm::ivec2 direction = next.direction * forwards;
      const auto inside = [&](const glm::ivec2& place) {
        return place.x >= std::min(1, last.x) && place.y >= 0 && place.x <= last.x && place.y <= last.y;
      };
      if (!inside(at + direction)) direction = -direction, forwards = -forwards;
      if (!inside(at + direction)) break;
      const glm::dvec2 way = cell.step(direction.x, direction.y);
      const double yaw = std::atan2(way.y, way.x);
      if (views.empty() || views.back().yawRadians != yaw) stand(yaw);
      at += direction;
      stand(yaw);
      walked += glm::length(way);
    }
  }
  if (views.empty()) stand(0);
  return views;
}

class WalkGrowth {
 public:
  WalkGrowth(const BenchWalkGrowthOptions& options, const Common& common, PictureSize size,
             const ViewSettings& settings, std::shared_ptr<const RepeatedCell> cell, TaskRunner& runner)
      : options_(options),
        common_(common),
        size_(size),
        settings_(settings),
        cell_(std::move(cell)),
        runner_(runner) {}

  Result<Json> walk(std::uint64_t regions) {
    const Stopwatch making;
    auto made = RepeatedWalk::make(cell_, {regions, options_.regionsPerPage}, runner_, common_.progress,
                                   common_.stop);
    if (!made) return tl::unexpected(made.error());
    const double makingSeconds = making.seconds();
    PerspectiveView like;
    like.width = size_.width, like.height = size_.height;
    like.fovRadians = radians(60.0);
    const double metres = options_.frames * kStepSeconds * options_.metresPerSecond;
    const TimedPath path(legsThrough(*cell_, (*made)->cells(), metres, like), options_.metresPerSecond);
    forgetPeakResident();
    auto json = along(*made, path);
    if (!json) return json;
    (*json)["indexBytes"] = (*made)->indexBytes();
    (*json)["fileBytes"] = *(*made)->size();
    (*json)["makingSeconds"] = makingSeconds;
    return json;
  }

 private:
  Result<Json> along(const std::shared_ptr<const RepeatedWalk>& made, const TimedPath& path) {
    auto drawing = StreamRenderer::open(settings_, false, runner_);
    if (!drawing) return tl::unexpected(drawing.error());
    const std::uint64_t residentBefore = peakResidentBytes();
    const auto ranges = std::make_shared<CountedRanges>(made);
    WalkStreamOptions streaming;
    streaming.memoryBytes = memory();
    streaming.panoramas = settings_.secondaryCover;
    const auto start = path.at(0);
    streaming.where = {glm::dvec2(start.view.eye), start.view.yawRadians, start.velocity};

    const Stopwatch opening;
    auto pages = WalkPages::open(ranges, "walk");
    if (!pages) return tl::unexpected(pages.error());
    auto opened = PagedWalk::open(std::move(*pages), 0, "walk", streaming, runner_);
    if (!opened) return tl::unexpected(opened.error());
    const double openSeconds = opening.seconds();
    const std::uint64_t bytesToOpen = ranges->bytes(), requestsToOpen = ranges->requests();
    PagedWalk& walk = **opened;
    const auto needed = [&](const LoadedWalk& loaded, const PerspectiveView& view) {
      return camerasOf(*loaded.walk.layout, view, settings_);
    };
    const auto waitFor = [&](const auto& there) -> Status {
      while (!there(*walk.walk())) {
        if (common_.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
        if (opening.seconds() > kLongestWaitSeconds)
          return fail(ErrorKind::internal, "the first view does not come", "walk");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return {};
    };
    const auto captures = [&](const LoadedWalk& loaded) {
      return capturesOf(loaded, needed(loaded, start.view));
    };
    if (Status came = waitFor([&](const LoadedWalk& loaded) { return !captures(loaded).missing; }); !came)
      return tl::unexpected(came.error());
    const auto firstDrawn = drawing->draw(walk.walk()->walk, start.view);
    if (!firstDrawn) return tl::unexpected(firstDrawn.error());
    const double firstFrameSeconds = opening.seconds();
    const std::uint64_t bytesToFirstFrame = ranges->bytes();
    if (Status came = waitFor([&](const LoadedWalk& loaded) {
          const auto [missing, standIn] = captures(loaded);
          return !missing && !standIn;
        });
        !came)
      return tl::unexpected(came.error());
    const double firstFullSeconds = opening.seconds();

    WalkTally tally;
    std::vector<double> threadMs;
    const double processorBefore = processorSeconds();
    std::set<int> walked;
    int waited = 0;  // frames that waited to take their captures
    for (int step = 0; step < options_.frames; ++step) {
      if (common_.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
      if (common_.progress) common_.progress({double(step), double(options_.frames), "walking"});
      const Stopwatch frameTime;
      const double threadBefore = threadSeconds();
      const double now = step * kStepSeconds;
      const auto [view, velocity] = path.at(now);
      const long before = waits();
      walk.go({glm::dvec2(view.eye), view.yawRadians, velocity});
      const auto snapshot = walk.walk();
      waited += waits() > before ? 1 : 0;
      tally.takeMs.push_back(frameTime.seconds() * 1e3);
      const auto drawn = drawing->draw(snapshot->walk, view);
      if (!drawn) return tl::unexpected(drawn.error());
      tally.frameMs.push_back(frameTime.seconds() * 1e3);
      threadMs.push_back((threadSeconds() - threadBefore) * 1e3);
      const ViewCameras cameras = needed(*snapshot, view);
      tally.count(*snapshot, cameras, now);
      tally.count(*drawn);
      if (cameras.region >= 0)
        walked.insert(snapshot->walk.layout->regions[std::size_t(cameras.region)].id.i);
      const double rest = kStepSeconds - frameTime.seconds();
      if (rest > 0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
    }
    const double processorMs = (processorSeconds() - processorBefore) / options_.frames * 1e3;

    const Spread frames = spreadOf(tally.frameMs), takes = spreadOf(tally.takeMs),
                 thread = spreadOf(threadMs);
    const PagedWalkStats stats = walk.stats();
    return Json{{"regions", made->regions()},
                {"cameras", made->cameras()},
                {"pages", made->pages()},
                {"openSeconds", openSeconds},
                {"openBytes", bytesToOpen},
                {"openRequests", requestsToOpen},
                {"firstFrameSeconds", firstFrameSeconds},
                {"firstFrameBytes", bytesToFirstFrame},
                {"firstFullSeconds", firstFullSeconds},
                {"frames", options_.frames},
                {"regionsWalked", walked.size()},
                {"frameMsMedian", frames.median},
                {"frameMsP99", frames.p99},
                {"frameMsMax", frames.max},
                {"threadMsMedian", thread.median},
                {"threadMsP99", thread.p99},
                {"snapshotMsMax", takes.max},
                {"waitingFrames", waited},
                {"processorMs", processorMs},
                {"incompleteFrames", tally.incomplete},
                {"coarseFrames", tally.coarse},
                {"limitBytes", stats.captures.limitBytes},
                {"peakBytes", stats.captures.peakBytes},
                {"beyondLimitBytes", stats.captures.beyondLimit},
                {"residentBytesBefore", residentBefore},
                {"residentBytesPeak", peakResidentBytes()},
                {"loads", stats.captures.loads},
                {"coarseLoads", stats.captures.coarseLoads},
                {"evictions", stats.captures.evictions},
                {"pageChanges", stats.changes},
                {"pageChangeSecondsMax", stats.longestChange},
                {"pageRegions", stats.regions},
                {"indexBytesRead", stats.index.bytes},
                {"bytesRead", ranges->bytes()},
                {"warnings", walk.takeWarnings()}};
  }

  std::size_t memory() const { return std::size_t(common_.walkMegabytes.value_or(kUsualMegabytes) * 1e6); }

  const BenchWalkGrowthOptions& options_;
  const Common& common_;
  const PictureSize size_;
  const ViewSettings settings_;
  const std::shared_ptr<const RepeatedCell> cell_;
  TaskRunner& runner_;
};

Chart chartOf(const Json& report) {
  Chart chart;
  chart.title = "A walk as its layout grows";
  const Json& first = report["walks"].front();
  chart.subtitle = fmt::format("{}x{} pixels, {}, {} threads; {} steps at {:.1f} m/s, {} for captures",
                               report["width"].get<int>(), report["height"].get<int>(),
                               report["processor"].get<std::string>(), report["threads"].get<int>(),
                               first["frames"].get<int>(), report["metresPerSecond"].get<double>(),
                               bytesText(first["limitBytes"].get<std::uint64_t>()));
  chart.across = "regions of the layout";
  chart.up = "milliseconds, megabytes or kilobytes, as the lines say";
  struct Line {
    const char *name, *key;
    double factor;
  };
  for (const Line& line :
       {Line{"memory, MB", "residentBytesPeak", 1e-6}, Line{"read to open, kB", "openBytes", 1e-3},
        Line{"to open, ms", "openSeconds", 1e3}, Line{"frame, 99 %, ms", "frameMsP99", 1},
        Line{"processor a frame, ms", "processorMs", 1}, Line{"frame, median, ms", "frameMsMedian", 1}}) {
    ChartLine drawn{line.name, {}};
    for (const Json& walk : report["walks"])
      drawn.points.emplace_back(walk["regions"].get<double>(), line.factor * walk[line.key].get<double>());
    chart.lines.push_back(std::move(drawn));
  }
  return chart;
}

std::string lineOf(const Json& walk) {
  const auto number = [&](const char* key) { return walk[key].get<double>(); };
  const auto bytes = [&](const char* key) { return bytesText(walk[key].get<std::uint64_t>()); };
  return fmt::format(
      "{:>9.0f} regions, {:.0f} cameras, {:.0f} pages ({:.0f} s to make)\n"
      "  open after {:.0f} ms and {}, first frame after {:.0f} ms and {}, in full after {:.2f} s\n"
      "  {:.0f} frames through {:.0f} regions and {:.0f} changes of page ({:.0f} ms at most): {:.0f} with "
      "coarse "
      "captures, {:.0f} with captures missing\n"
      "  frame {:.2f} ms median, {:.2f} ms p99, {:.2f} ms max; {:.2f} ms of processor time a frame; {:.0f} "
      "waited for their captures\n"
      "  captures {} of {} at most; {:.0f} loads, {:.0f} coarse, {:.0f} evictions; {} resident at most ({} "
      "before)\n",
      number("regions"), number("cameras"), number("pages"), number("makingSeconds"),
      1e3 * number("openSeconds"), bytes("openBytes"), 1e3 * number("firstFrameSeconds"),
      bytes("firstFrameBytes"), number("firstFullSeconds"), number("frames"), number("regionsWalked"),
      number("pageChanges"), 1e3 * number("pageChangeSecondsMax"), number("coarseFrames"),
      number("incompleteFrames"), number("frameMsMedian"), number("frameMsP99"), number("frameMsMax"),
      number("processorMs"), number("waitingFrames"), bytes("peakBytes"), bytes("limitBytes"),
      number("loads"), number("coarseLoads"), number("evictions"), bytes("residentBytesPeak"),
      bytes("residentBytesBefore"));
}

}  // namespace

Result<Report> runBenchWalkGrowth(const BenchWalkGrowthOptions& options, const Common& common) {
  if (!options.chart.empty())
    if (Status possible = checkDrawingPath(options.chart); !possible) return tl::unexpected(possible.error());
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  const auto renderer = parseRenderer(options.renderer);
  if (!renderer) return tl::unexpected(renderer.error());
  const auto configuration = parseConfiguration(options.configuration);
  if (!configuration) return tl::unexpected(configuration.error());
  ViewSettings settings;
  settings.renderer = *renderer;
  giveBackLargeMemory();
  const auto runner = common.runner();
  const auto folder = TrialFolder::make(std::filesystem::temp_directory_path());
  if (!folder) return tl::unexpected(folder.error());
  auto cell = RepeatedCell::make({*configuration, options.cellSize, options.samplesPerDegree}, folder->path(),
                                 *runner, common.progress, common.stop);
  if (!cell) return tl::unexpected(cell.error());

  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"configuration", nameOf(*configuration)},
                      {"cellSize", options.cellSize},
                      {"samplesPerDegree", options.samplesPerDegree},
                      {"regionsPerPage", options.regionsPerPage},
                      {"renderer", options.renderer},
                      {"width", size->width},
                      {"height", size->height},
                      {"metresPerSecond", options.metresPerSecond},
                      {"walks", Json::array()}});
  report.text = fmt::format("{}, {} threads, {}x{}, {} steps of {:.0f} ms at {:.2f} m/s\n", processorName(),
                            runner->threads(), size->width, size->height, options.frames, kStepSeconds * 1e3,
                            options.metresPerSecond);
  WalkGrowth growth(options, common, *size, settings, std::move(*cell), *runner);
  std::vector<std::uint64_t> regions = options.regions;
  std::ranges::sort(regions);
  for (const std::uint64_t count : regions) {
    auto walk = growth.walk(count);
    if (!walk) return tl::unexpected(walk.error());
    report.text += lineOf(*walk);
    report.json["walks"].push_back(std::move(*walk));
  }
  if (!options.chart.empty())
    if (Status written = writeChart(chartOf(report.json), options.chart); !written)
      return tl::unexpected(written.error());
  return report;
}

}  // namespace acentric::cli
