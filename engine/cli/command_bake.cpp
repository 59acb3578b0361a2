#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/pipeline/shard.h"
#include "engine/pipeline/simplified_regions.h"

namespace acentric::cli {
namespace {

Report dryRun(const OpenProject& open) {
  const std::vector<bool> baked = bakedCameras(open);
  Report report;
  Json missing = Json::array();
  for (std::size_t i = 0; i < baked.size(); ++i)
    if (!baked[i]) missing.push_back({{"camera", i}, {"key", open.keys[i].toHex()}});
  report.text = fmt::format("{} of {} cameras would be baked{}\n", missing.size(), baked.size(),
                            storeyText(open.project));
  for (const Json& entry : missing)
    report.text +=
        fmt::format("  camera {} {}\n", entry["camera"].get<std::size_t>(), entry["key"].get<std::string>());
  report.json = {{"dryRun", true}, {"of", baked.size()}, {"missing", std::move(missing)}};
  return report;
}

/// What of each storey is to be baked.
std::vector<BakeRequest> requestsFor(std::span<const OpenProject> storeys, const BakeOptions& options,
                                     const Shard& shard) {
  std::size_t first = 0, light = 0;  // numbers of what is to be baked, as the shard counts
  for (const OpenProject& open : storeys) light += open.keys.size();
  std::vector<BakeRequest> requests;
  for (const OpenProject& open : storeys) {
    BakeRequest request;
    if (options.light == "only") {
      request.cameras.emplace();
    } else if (!options.only.empty()) {
      request.cameras = options.only;
    } else if (!shard.whole()) {
      request.cameras = bakingOrder(open);
      std::erase_if(*request.cameras, [&](int camera) { return !shard.takes(first + std::size_t(camera)); });
    }
    request.verify = options.verify;
    request.surfaceLight = options.light != "without" && shard.takes(light++);
    first += open.keys.size();
    requests.push_back(std::move(request));
  }
  return requests;
}

Result<Report> bakeStorey(const OpenProject& open, const BakeRequest& request, const Common& common,
                          TaskRunner& runner) {
  const auto baked = bakeProject(open, request, runner, common.progress, common.stop);
  if (!baked) return tl::unexpected(baked.error());

  const auto present = bakedCameras(open);
  for (const int camera : request.cameras ? *request.cameras : bakingOrder(open))
    if (!present[std::size_t(camera)])
      return fail(ErrorKind::unreadable, fmt::format("camera {} was baked but is not on disk", camera),
                  captureFolderFor(open.file).string());

  const BakeReport& captures = baked->captures;
  Report report;
  Json cameras = Json::array();
  for (const BakedCamera& camera : captures.cameras)
    cameras.push_back({{"camera", camera.camera},
                       {"key", camera.key.toHex()},
                       {"reused", camera.reused},
                       {"seconds", camera.seconds},
                       {"samples", toJson(camera.samples)}});
  report.json = {{"baked", captures.baked},
                 {"reused", captures.reused},
                 {"seconds", captures.seconds},
                 {"samples", toJson(captures.samples)},
                 {"rays", toJson(captures.rays)},
                 {"eyeViews", {{"traced", captures.eyeViews}, {"seconds", captures.eyeViewSeconds}}},
                 {"surfaceLight",
                  {{"asked", request.surfaceLight},
                   {"baked", baked->surfaceLightBaked},
                   {"seconds", baked->surfaceLightSeconds}}},
                 {"damaged", baked->damaged},
                 {"bytes", baked->bytes},
                 {"cameras", std::move(cameras)}};
  for (const std::string& damaged : baked->damaged)
    report.text += fmt::format("damaged, set aside and baked again: {}\n", damaged);
  report.text += fmt::format(
      "baked {} cameras{} in {:.1f} s ({} samples), {} were there already; light on local geometry {}; {} in "
      "{}\n",
      captures.baked, storeyText(open.project), captures.seconds, countText(captures.samples.keptInAll()),
      captures.reused,
      !request.surfaceLight      ? std::string("was not asked for")
      : baked->surfaceLightBaked ? fmt::format("{:.1f} s", baked->surfaceLightSeconds)
                                 : std::string("was there already"),
      bytesText(baked->bytes), captureFolderFor(open.file).string());
  return report;
}

/// Deletes what none of the storeys uses.
Result<std::uint64_t> prune(std::span<const OpenProject> storeys) {
  const auto store = CaptureStore::open(captureFolderFor(storeys.front().file));
  if (!store) return tl::unexpected(store.error());
  std::vector<ContentKey> used;
  for (const OpenProject& open : storeys) {
    std::ranges::copy(open.keys, std::back_inserter(used));
    used.push_back(open.surfaceLightKey);
    std::ranges::copy(simplifiedKeys(open), std::back_inserter(used));
  }
  return store->prune(used);
}

}  // namespace

Result<Report> runBake(const BakeOptions& options, const Common& common) {
  const auto shard = options.shard.empty() ? Shard{} : parseShard(options.shard);
  if (!shard) return tl::unexpected(shard.error());
  if (options.prune && !options.shard.empty())
    return fail(ErrorKind::invalidArgument, "leave it to one command when all shares are baked", "--prune");
  if (!options.only.empty() && (!options.shard.empty() || options.light == "only"))
    return fail(ErrorKind::invalidArgument, "cameras are either named, or a share of them is taken, or none",
                "--only");
  auto storeys = openStoreys(options.project, common);
  if (!storeys) return tl::unexpected(storeys.error());
  if (!options.only.empty() && storeys->size() > 1)
    return fail(ErrorKind::invalidArgument,
                "each storey numbers its cameras for itself: say with --storey whose are meant", "--only");
  if (options.prune && !common.storey.empty())
    return fail(ErrorKind::invalidArgument, "what one storey does not use another may: leave --storey away",
                "--prune");
  const std::vector<BakeRequest> requests = requestsFor(*storeys, options, *shard);
  const auto runner = common.runner();
  std::vector<Report> reports;
  for (std::size_t s = 0; s < storeys->size(); ++s) {
    const OpenProject& open = (*storeys)[s];
    if (options.dryRun) {
      reports.push_back(dryRun(open));
      continue;
    }
    auto report = bakeStorey(open, requests[s], common, *runner);
    if (!report) return report;
    reports.push_back(std::move(*report));
  }
  Report report = byStorey(*storeys, std::move(reports));
  if (options.dryRun) return report;
  std::uint64_t freed = 0;
  if (options.prune) {
    const auto pruned = prune(*storeys);
    if (!pruned) return tl::unexpected(pruned.error());
    freed = *pruned;
    report.text += fmt::format("pruned {} of captures that this project no longer uses\n", bytesText(freed));
  }
  report.json["prunedBytes"] = freed;
  report.json["folder"] = captureFolderFor(storeys->front().file).string();
  return report;
}

}  // namespace acentric::cli
