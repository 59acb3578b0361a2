#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/pipeline/simplified_regions.h"

namespace acentric::cli {
namespace {

Report dryRun(const OpenProject& open, const std::vector<bool>& baked) {
  Report report;
  Json missing = Json::array();
  for (std::size_t i = 0; i < baked.size(); ++i)
    if (!baked[i]) missing.push_back({{"camera", i}, {"key", open.keys[i].toHex()}});
  report.text = fmt::format("{} of {} cameras would be baked\n", missing.size(), baked.size());
  for (const Json& entry : missing)
    report.text +=
        fmt::format("  camera {} {}\n", entry["camera"].get<std::size_t>(), entry["key"].get<std::string>());
  report.json = {{"dryRun", true}, {"of", baked.size()}, {"missing", std::move(missing)}};
  return report;
}

}  // namespace

Result<Report> runBake(const BakeOptions& options, const Common& common) {
  const auto open = openProject(options.project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  if (options.dryRun) return dryRun(*open, bakedCameras(*open));

  const auto runner = common.runner();
  const auto baked = bakeProject(*open, {options.only, true}, *runner, common.progress, common.stop);
  if (!baked) return tl::unexpected(baked.error());

  const auto present = bakedCameras(*open);
  const auto wanted = [&](std::size_t camera) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), int(camera)) != options.only.end();
  };
  for (std::size_t i = 0; i < present.size(); ++i)
    if (wanted(i) && !present[i])
      return fail(ErrorKind::unreadable, fmt::format("camera {} was baked but is not on disk", i),
                  captureFolderFor(open->file).string());
  std::uint64_t freed = 0;
  if (options.prune) {
    const auto store = CaptureStore::open(captureFolderFor(open->file));
    if (!store) return tl::unexpected(store.error());
    std::vector<ContentKey> used = open->keys;
    used.push_back(open->surfaceLightKey);
    std::ranges::copy(simplifiedKeys(*open), std::back_inserter(used));
    freed = store->prune(used);
  }

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
      {"prunedBytes", freed},
      {"folder", captureFolderFor(open->file).string()},
      {"cameras", std::move(cameras)}};
  report.text = fmt::format(
      "baked {} cameras in {:.1f} s ({} samples), {} were there already; light on local geometry {}; {} in "
      "{}\n",
      captures.baked, captures.seconds, countText(captures.samples), captures.reused,
      baked->surfaceLightBaked ? fmt::format("{:.1f} s", baked->surfaceLightSeconds) : "was there already",
      bytesText(baked->bytes), captureFolderFor(open->file).string());
  if (options.prune)
    report.text += fmt::format("pruned {} of captures that this project no longer uses\n", bytesText(freed));
  return report;
}

}  // namespace acentric::cli
