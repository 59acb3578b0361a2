#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/cli/bake_notice.h"
#include "engine/cli/bake_requests.h"
#include "engine/cli/path_frames.h"
#include "engine/pipeline/bake_guard.h"
#include "engine/pipeline/simplified_regions.h"
#include "engine/view/view_cameras.h"

namespace acentric::cli {
namespace {

/// "12: 812,345 samples in 4 layers (620,100, 150,200, 40,045, 2,000), background in 90,500 pixels, dropped:
/// 301,000 hidden, 12 over the limit; 7.9 MB".
std::string cameraText(int camera, const std::optional<SampleCounts>& samples, std::uint64_t bytes) {
  if (!samples) return fmt::format("  {:>4}: {}\n", camera, bytesText(bytes));
  std::vector<std::string> layers;
  for (const std::uint64_t kept : samples->kept)
    if (kept > 0) layers.push_back(countText(kept));
  return fmt::format(
      "  {:>4}: {} samples in {} layers ({}), background in {} pixels, dropped: {} hidden, {} over the "
      "limit; {}\n",
      camera, countText(samples->keptInAll()), layers.size(), fmt::join(layers, ", "),
      countText(samples->background), countText(samples->hidden), countText(samples->overLimit),
      bytesText(bytes));
}

Json eyesJson(const TestEyeSummary& eyes) {
  return {{"regions", eyes.regions},  {"eyes", eyes.eyes},      {"mostInARegion", eyes.most},
          {"looks", eyes.loss.looks}, {"lost", eyes.loss.lost}, {"worstRegionAtMost", eyes.worstLimit}};
}

std::string pruningText(const TestEyeSummary& eyes) {
  if (eyes.loss.looks == 0) return {};
  return fmt::format(
      "pruning: {:.1f} test eyes a region, {} at most; with 95 % confidence no region loses more than {:.2g} "
      "% "
      "of what is seen from it\n",
      double(eyes.eyes) / double(eyes.regions), eyes.most, 100 * eyes.worstLimit);
}

void addRefused(const ProjectBakeReport& baked, Report& report) {
  report.success = baked.refused.empty();
  for (const std::string& refused : baked.refused) report.text += fmt::format("not written: {}\n", refused);
}

Report bakeReport(const ProjectBakeReport& baked, const BakeRequest& request, const BakeOptions& options,
                  const BakePlan& plan, const StoreyPlan& storey, const CaptureStore& store) {
  const BakeReport& captures = baked.captures;
  Report report;
  Json cameras = Json::array();
  std::string list;
  for (const BakedCamera& camera : captures.cameras) {
    std::optional<SampleCounts> samples = camera.samples;
    if (camera.reused) {
      const auto record = store.record(camera.key);
      samples = record ? record->samples : std::nullopt;
    }
    const std::uint64_t bytes = store.bytesOf(camera.key);
    cameras.push_back({{"camera", camera.camera},
                       {"key", camera.key.toHex()},
                       {"reused", camera.reused},
                       {"seconds", camera.seconds},
                       {"samples", samples ? toJson(*samples) : Json()},
                       {"bytes", bytes}});
    if (options.list) list += cameraText(camera.camera, samples, bytes);
  }
  report.json = {
      {"baked", captures.baked},
      {"reused", captures.reused},
      {"seconds", captures.seconds},
      {"peakBytes", captures.peakBytes},
      {"samples", toJson(captures.counts.samples)},
      {"reflections", captures.counts.reflections},
      {"rays", toJson(captures.counts.rays)},
      {"eyeViews", {{"traced", captures.counts.eyeViews}, {"seconds", captures.counts.seconds.sight()}}},
      {"parts", toJson(captures.counts.seconds)},
      {"testEyes", eyesJson(captures.testEyes)},
      {"surfaceLight",
       {{"asked", request.surfaceLight},
        {"baked", baked.surfaceLightBaked},
        {"resumedSamples", baked.surfaceLightResumed},
        {"seconds", baked.surfaceLightSeconds}}},
      {"damaged", baked.damaged},
      {"refused", baked.refused},
      {"bytes", baked.bytes},
      {"neededBytes", baked.neededBytes},
      {"freeBytes", baked.freeBytes},
      {"cameras", std::move(cameras)}};
  for (const std::string& damaged : baked.damaged) report.text += fmt::format("written again: {}\n", damaged);
  addRefused(baked, report);
  report.text += fmt::format(
      "baked {} cameras{} in {:.1f} s ({} samples), {} were there already; light on local geometry {}; {} in "
      "{}\n",
      captures.baked, plan.storeys.size() > 1 ? fmt::format(" ({})", storey.storey) : "", captures.seconds,
      countText(captures.counts.samples.keptInAll()), captures.reused,
      !request.surfaceLight     ? std::string("was not asked for")
      : baked.surfaceLightBaked ? fmt::format("{:.1f} s", baked.surfaceLightSeconds)
                                : std::string("was there already"),
      bytesText(baked.bytes), captureFolderFor(plan.file).string());
  report.text += pruningText(captures.testEyes);
  report.text += list;
  return report;
}

/// Of a storey of which everything asked for is on disk.
Report nothingToDo(const BakeRequest& request, const BakeOptions& options, const BakePlan& plan,
                   const StoreyPlan& storey, const CaptureStore& store) {
  ProjectBakeReport report;
  report.surfaceLightReused = request.surfaceLight;
  for (const int camera : *request.cameras) {
    BakedCamera& reused = report.captures.cameras.emplace_back();
    reused.camera = camera;
    reused.key = storey.cameras[std::size_t(camera)].key;
    reused.reused = true;
  }
  report.captures.reused = int(request.cameras->size());
  for (const PlannedCapture& camera : storey.cameras) report.bytes += store.bytesOf(camera.key);
  return bakeReport(report, request, options, plan, storey, store);
}

Result<Report> bakeStorey(std::size_t number, const BakeRequest& request, const BakeOptions& options,
                          const BakePlan& plan, const CaptureStore& store, const Common& common,
                          TaskRunner& runner) {
  const OpenProject& open = plan.open[number];
  const auto baked = bakeProject(open, request, store, runner, common.progress, common.stop);
  if (!baked) return tl::unexpected(baked.error());
  for (const int camera : *request.cameras)
    if (baked->refused.empty() && !store.has(open.keys[std::size_t(camera)]))
      return fail(ErrorKind::unreadable, fmt::format("camera {} was baked but is not on disk", camera),
                  store.folder().string());
  return bakeReport(*baked, request, options, plan, plan.storeys[number], store);
}

/// Of all storeys, before the first of them is baked.
Result<BakeForecast> foretell(std::span<const OpenProject> storeys, const std::vector<BakeRequest>& requests,
                              const CaptureStore& store, const Common& common, TaskRunner& runner) {
  std::vector<BakeShare> shares;
  for (std::size_t s = 0; s < storeys.size(); ++s)
    shares.push_back(missingOf(storeys[s], requests[s], store));
  return foretellBake(shares, requests.front().memoryBytes, common, runner);
}

/// Captures alone, of a lower quality than the project's.
Result<Report> bakeLower(BakePlan& plan, const std::vector<BakeRequest>& requests, Quality quality,
                         const Common& common) {
  const auto store = openCaptures(plan.file);
  if (!store) return tl::unexpected(store.error());
  const auto runner = common.runner();
  std::vector<OpenProject> lower;
  std::vector<BakeRequest> captures = requests;
  for (const OpenProject& open : plan.open) lower.push_back(atQuality(open, quality));
  for (BakeRequest& request : captures) request.surfaceLight = request.coarseFirst = false;
  const auto forecast = foretell(lower, captures, *store, common, *runner);
  if (!forecast) return tl::unexpected(forecast.error());
  ProjectBakeReport all;
  for (std::size_t s = 0; s < lower.size(); ++s) {
    const auto baked = bakeProject(lower[s], captures[s], *store, *runner, common.progress, common.stop);
    if (!baked) return tl::unexpected(baked.error());
    all.add(*baked);
  }
  Report report;
  report.json = {{"quality", nameOf(quality)},      {"forecast", toJson(*forecast)},
                 {"baked", all.captures.baked},     {"reused", all.captures.reused},
                 {"seconds", all.captures.seconds}, {"samples", toJson(all.captures.counts.samples)},
                 {"refused", all.refused},          {"bytes", all.bytes}};
  addRefused(all, report);
  report.text += fmt::format("baked {} cameras as {} in {:.1f} s, {} were there already; {} in all\n",
                             all.captures.baked, nameOf(quality), all.captures.seconds, all.captures.reused,
                             bytesText(all.bytes));
  return report;
}

/// Deletes what none of the storeys uses.
std::uint64_t prune(std::span<const OpenProject> storeys, const CaptureStore& store) {
  std::vector<ContentKey> used;
  for (const OpenProject& open : storeys) {
    std::ranges::copy(open.keys, std::back_inserter(used));
    for (const auto& best : bestKeys(open, store))
      if (best) used.push_back(*best);
    used.push_back(open.surfaceLightKey);
    if (!store.hasSurfaceLight(open.surfaceLightKey)) used.push_back(firstLightKey(open.surfaceLightKey));
    std::ranges::copy(simplifiedKeys(open), std::back_inserter(used));
  }
  return store.prune(used);
}

/// Opens what is to be baked, with the locks that keep other bakes away and an eye on the model.
/// `began`: before the plan was made.
Result<BakeGuard> beginBake(BakePlan& plan, const BakeOptions& options, const Shard& shard,
                            const Common& common, std::filesystem::file_time_type began) {
  using Kind = BakePart::Kind;
  BakeGuardOptions how;
  how.takeOver = options.takeOver;
  how.part.shard = shard;
  how.part.kind = !shard.whole()               ? Kind::shard
                  : options.light == "only"    ? Kind::light
                  : options.light == "without" ? Kind::cameras
                                               : Kind::all;
  auto guard = BakeGuard::begin(plan.file, how);
  if (!guard) return guard;
  if (Status open = openStoreysOf(plan, common); !open) return tl::unexpected(open.error());
  guard->watch(modelFiles(plan.file, plan.open.front().project, common.host, began));
  if (Status sound = guard->check(); !sound) return tl::unexpected(sound.error());
  return guard;
}

/// What is refused whatever the project holds.
Status checkOptions(const BakeOptions& options, const Common& common) {
  const auto bad = [](const char* message, const char* where) {
    return fail(ErrorKind::invalidArgument, message, where);
  };
  if (options.prune && !options.shard.empty())
    return bad("leave it to one command when all shares are baked", "--prune");
  if (options.prune && !common.storey.empty())
    return bad("what one storey does not use another may: leave --storey away", "--prune");
  if (options.prune && !common.preset.empty())
    return bad("would delete the captures of the project as it is: leave --preset away", "--prune");
  if (options.quality != nameOf(Quality::full) && (options.prune || options.dryRun))
    return bad("is about the captures of full quality: leave --quality away",
               options.prune ? "--prune" : "--dry-run");
  if (!options.only.empty() && (!options.shard.empty() || options.light == "only"))
    return bad("cameras are either named, or a share of them is taken, or none", "--only");
  return {};
}

/// Those that frames of 16:9 along a path are painted from.
Result<std::vector<int>> camerasAlong(const BakeOptions& options, const Common& common) {
  const auto walk = openAlong(options.project, options.along, "1280x720", 0, 0, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  const OpenProject& open = walk->storeys.front();
  std::set<int> cameras;
  for (const PerspectiveView& view : evenly(walk->views, options.frames))
    for (const int camera : camerasOf(*open.layout, view, open.project.view).cameras) cameras.insert(camera);
  return std::vector<int>(cameras.begin(), cameras.end());
}

/// The plan of the storey chosen, or of all.
Result<BakePlan> planFor(const BakeOptions& options, const Common& common) {
  std::optional<int> storey;
  std::optional<Project> preset;
  if (!common.storey.empty() || !common.preset.empty()) {
    auto project = loadChosen(options.project, common);
    if (!project) return tl::unexpected(project.error());
    if (!common.storey.empty()) storey = project->storey;
    if (!common.preset.empty()) preset = std::move(*project);
  }
  auto plan = preset ? planBake(options.project, *preset, storey, common.host, common.progress, common.stop)
                     : planBake(options.project, storey, common.host, common.progress, common.stop);
  if (!plan || options.only.empty()) return plan;
  if (plan->storeys.size() > 1)
    return fail(ErrorKind::invalidArgument,
                "each storey numbers its cameras for itself: say with --storey whose are meant", "--only");
  const int cameras = int(plan->storeys.front().cameras.size());
  for (const int camera : options.only)
    if (camera < 0 || camera >= cameras)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("there is no camera {}; the layout has {}", camera, cameras), "--only");
  return plan;
}

}  // namespace

Result<Report> runBake(const BakeOptions& asked, const Common& common) {
  BakeOptions options = asked;
  if (!asked.along.empty()) {
    auto cameras = camerasAlong(asked, common);
    if (!cameras) return tl::unexpected(cameras.error());
    options.only = std::move(*cameras);
  }
  const auto shard = options.shard.empty() ? Shard{} : parseShard(options.shard);
  if (!shard) return tl::unexpected(shard.error());
  if (Status sound = checkOptions(options, common); !sound) return tl::unexpected(sound.error());
  const auto began = std::filesystem::file_time_type::clock::now();
  auto plan = planFor(options, common);
  if (!plan) return tl::unexpected(plan.error());
  std::vector<BakeRequest> requests = bakeRequests(*plan, options, *shard);
  if (options.dryRun) return dryRun(*plan, requests, common);

  const Quality quality =
      *std::ranges::find_if(kQualities, [&](Quality q) { return nameOf(q) == options.quality; });
  bool idle = false;
  if (quality == Quality::full) {
    const auto states = stateOf(*plan);
    if (!states) return tl::unexpected(states.error());
    idle = !options.verify && allDone(requests, *states);
  }
  std::optional<BakeGuard> guard;
  if (!idle || options.prune) {
    auto begun = beginBake(*plan, options, *shard, common, began);
    if (!begun) return tl::unexpected(begun.error());
    guard.emplace(std::move(*begun));
    for (BakeRequest& request : requests) request.mayGoOn = [&] { return guard->check(); };
  }
  if (quality != Quality::full) return bakeLower(*plan, requests, quality, common);
  const auto store = openCaptures(plan->file);
  if (!store) return tl::unexpected(store.error());
  const auto runner = common.runner();
  std::vector<Report> reports;
  std::vector<std::string> names;
  const auto forecast =
      idle ? foretellBake({}, 0, common, *runner) : foretell(plan->open, requests, *store, common, *runner);
  if (!forecast) return tl::unexpected(forecast.error());
  for (std::size_t s = 0; s < plan->storeys.size(); ++s) {
    auto report = idle ? Result<Report>(nothingToDo(requests[s], options, *plan, plan->storeys[s], *store))
                       : bakeStorey(s, requests[s], options, *plan, *store, common, *runner);
    if (!report) return report;
    reports.push_back(std::move(*report));
    names.push_back(plan->storeys[s].storey);
  }
  Report report = byStorey(names, std::move(reports));
  report.json["forecast"] = toJson(*forecast);
  if (guard && !guard->note().empty()) report.text += guard->note() + "\n";
  std::uint64_t freed = 0;
  if (options.prune) {
    freed = prune(plan->open, *store);
    report.text += fmt::format("pruned {} of captures that this project no longer uses\n", bytesText(freed));
  }
  report.json["prunedBytes"] = freed;
  report.json["folder"] = captureFolderFor(plan->file).string();
  return report;
}

}  // namespace acentric::cli
