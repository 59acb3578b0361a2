#include "engine/cli/bake_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/file.h"
#include "engine/cli/bake_notice.h"

namespace acentric::cli {
namespace {

/// "0-3, 7, 9-11"
std::string rangesText(const std::vector<int>& sorted) {
  std::string text;
  for (std::size_t first = 0; first < sorted.size();) {
    std::size_t last = first;
    while (last + 1 < sorted.size() && sorted[last + 1] == sorted[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", sorted[first]);
    if (last > first) text += fmt::format("-{}", sorted[last]);
    first = last + 1;
  }
  return text;
}

Json stateJson(const CaptureState& state) {
  return {{"reason", nameOf(state.reason)}, {"changed", state.changed}, {"damage", state.damage}};
}

std::vector<int> staleOf(const BakeRequest& request, const StoreyState& state) {
  std::vector<int> stale;
  for (const int camera : *request.cameras)
    if (!state.cameras[std::size_t(camera)].baked()) stale.push_back(camera);
  std::ranges::sort(stale);
  return stale;
}

Report storeyReport(const StoreyPlan& plan, const BakeRequest& request, const StoreyState& state,
                    bool severalStoreys) {
  Report report;
  Json missing = Json::array();
  std::map<std::string, std::vector<int>> byReason;
  const std::vector<int> stale = staleOf(request, state);
  for (const int camera : stale) {
    const CaptureState& found = state.cameras[std::size_t(camera)];
    byReason[describe(found)].push_back(camera);
    Json entry = {{"camera", camera}, {"key", plan.cameras[std::size_t(camera)].key.toHex()}};
    entry.update(stateJson(found));
    missing.push_back(std::move(entry));
  }
  report.text = fmt::format("{} of {} cameras would be baked{}\n", stale.size(), request.cameras->size(),
                            severalStoreys ? fmt::format(" ({})", plan.storey) : "");
  for (const auto& [reason, cameras] : byReason)
    report.text +=
        fmt::format("  {}: camera{} {}\n", reason, cameras.size() > 1 ? "s" : "", rangesText(cameras));
  for (const int camera : stale)
    for (const std::string& damage : state.cameras[std::size_t(camera)].damage)
      report.text += fmt::format("  {}\n", damage);
  const bool light = request.surfaceLight && !state.light.baked();
  if (light) report.text += fmt::format("  the light on local geometry: {}\n", describe(state.light));
  report.json = {{"dryRun", true}, {"of", request.cameras->size()}, {"missing", std::move(missing)}};
  report.json["surfaceLight"] = request.surfaceLight ? stateJson(state.light) : Json(nullptr);
  return report;
}

}  // namespace

std::vector<BakeRequest> bakeRequests(const BakePlan& plan, const BakeOptions& options, const Shard& shard) {
  std::size_t first = 0, light = 0;  // numbers of what is to be baked, as the shard counts
  for (const StoreyPlan& storey : plan.storeys) light += storey.cameras.size();
  std::vector<BakeRequest> requests;
  for (const StoreyPlan& storey : plan.storeys) {
    BakeRequest request;
    request.cameras.emplace();
    if (options.light != "only") request.cameras = options.only.empty() ? storey.order : options.only;
    std::erase_if(*request.cameras, [&](int camera) { return !shard.takes(first + std::size_t(camera)); });
    request.surfaceLight = options.light != "without" && shard.takes(light++);
    request.verify = options.verify;
    request.coarseFirst = options.coarseFirst;
    request.memoryBytes = std::size_t(options.memoryMegabytes * 1e6);
    first += storey.cameras.size();
    requests.push_back(std::move(request));
  }
  return requests;
}

bool allDone(const std::vector<BakeRequest>& requests, const std::vector<StoreyState>& states) {
  const auto done = [](const CaptureState& state) { return state.baked() && state.recorded; };
  for (std::size_t s = 0; s < requests.size(); ++s) {
    for (const int camera : *requests[s].cameras)
      if (!done(states[s].cameras[std::size_t(camera)])) return false;
    if (requests[s].surfaceLight && !done(states[s].light)) return false;
  }
  return true;
}

Status openStoreysOf(BakePlan& plan, const Common& common) {
  if (!plan.open.empty()) return {};
  auto open = openStoreys(plan.file, common);
  if (!open) return tl::unexpected(open.error());
  plan.open = std::move(*open);
  return {};
}

Result<Report> dryRun(BakePlan& plan, const std::vector<BakeRequest>& requests, const Common& common) {
  const auto states = stateOf(plan);
  if (!states) return tl::unexpected(states.error());
  std::vector<std::string> names;
  std::vector<Report> reports;
  for (std::size_t s = 0; s < plan.storeys.size(); ++s) {
    names.push_back(plan.storeys[s].storey);
    reports.push_back(storeyReport(plan.storeys[s], requests[s], (*states)[s], plan.storeys.size() > 1));
  }
  std::vector<BakeShare> shares;
  for (std::size_t s = 0; s < plan.storeys.size(); ++s) {
    BakeShare share;
    share.cameras = staleOf(requests[s], (*states)[s]);
    share.light = requests[s].surfaceLight && !(*states)[s].light.baked();
    if (!share.any()) continue;
    if (Status open = openStoreysOf(plan, common); !open) return tl::unexpected(open.error());
    share.open = &plan.open[s];
    shares.push_back(std::move(share));
  }
  BakeForecastOptions options;
  options.brief = false;
  options.memoryBytes = requests.front().memoryBytes;
  const auto forecast = forecastBake(shares, options, *common.runner(), common.progress, common.stop);
  if (!forecast) return tl::unexpected(forecast.error());
  Report report = byStorey(names, std::move(reports));
  const auto space = freeSpace(captureFolderFor(plan.file));
  if (!space) return tl::unexpected(space.error());
  report.json["seconds"] = forecast->seconds();
  report.json["bytes"] = forecast->bytes();
  report.json["forecast"] = toJson(*forecast);
  report.json["freeBytes"] = *space;
  report.text += describe(*forecast);
  report.text += fmt::format("; {} free where the captures are kept\n", bytesText(*space));
  return report;
}

}  // namespace acentric::cli
