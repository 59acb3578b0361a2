#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
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

Result<Report> bakeStorey(const OpenProject& open, const BakeOptions& options, const Common& common,
                          TaskRunner& runner) {
  const auto baked = bakeProject(open, {options.only, true}, runner, common.progress, common.stop);
  if (!baked) return tl::unexpected(baked.error());

  const auto present = bakedCameras(open);
  const auto wanted = [&](std::size_t camera) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), int(camera)) != options.only.end();
  };
  for (std::size_t i = 0; i < present.size(); ++i)
    if (wanted(i) && !present[i])
      return fail(ErrorKind::unreadable, fmt::format("camera {} was baked but is not on disk", i),
                  captureFolderFor(open.file).string());

  const BakeReport& captures = baked->captures;
  Report report;
  Json cameras = Json::array();
  for (const BakedCamera& camera : captures.cameras)
    cameras.push_back({{"camera", camera.camera},
                       {"key", camera.key.toHex()},
                       {"reused", camera.reused},
                       {"seconds", camera.seconds},
                       {"samples", camera.samples}});
  report.json = {
      {"baked", captures.baked},
      {"reused", captures.reused},
      {"seconds", captures.seconds},
      {"samples", captures.samples},
      {"rays", toJson(captures.rays)},
      {"surfaceLight", {{"baked", baked->surfaceLightBaked}, {"seconds", baked->surfaceLightSeconds}}},
      {"bytes", baked->bytes},
      {"cameras", std::move(cameras)}};
  report.text = fmt::format(
      "baked {} cameras{} in {:.1f} s ({} samples), {} were there already; light on local geometry {}; {} in "
      "{}\n",
      captures.baked, storeyText(open.project), captures.seconds, countText(captures.samples),
      captures.reused,
      baked->surfaceLightBaked ? fmt::format("{:.1f} s", baked->surfaceLightSeconds) : "was there already",
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
  auto storeys = openStoreys(options.project, common);
  if (!storeys) return tl::unexpected(storeys.error());
  if (!options.only.empty() && storeys->size() > 1)
    return fail(ErrorKind::invalidArgument,
                "each storey numbers its cameras for itself: say with --storey whose are meant", "--only");
  if (options.prune && !common.storey.empty())
    return fail(ErrorKind::invalidArgument, "what one storey does not use another may: leave --storey away",
                "--prune");
  const auto runner = common.runner();
  std::vector<Report> reports;
  for (const OpenProject& open : *storeys) {
    if (options.dryRun) {
      reports.push_back(dryRun(open));
      continue;
    }
    auto report = bakeStorey(open, options, common, *runner);
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
