#include "engine/pipeline/bake_forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/pipeline/estimate_bake.h"

namespace acentric {
namespace {

double pixelsOf(const OpenProject& open, const std::vector<int>& cameras) {
  double pixels = 0;
  for (const int camera : cameras) {
    const ColumnCamera columns = columnCameraFor(open.layout->cameras[std::size_t(camera)], *open.layout,
                                                 open.scene->bounds, open.project.bake);
    pixels += double(columns.columns) * columns.rows;
  }
  return pixels;
}

/// `there`: by camera, is its capture on disk? `best`: of each, what is.
BakeShare shareOf(const OpenProject& open, const BakeRequest& request, const std::vector<bool>& there,
                  bool lightThere, const std::vector<std::optional<ContentKey>>& best) {
  BakeShare share{&open, {}, request.surfaceLight && !lightThere, 0};
  std::vector<int> wanted(open.keys.size());
  std::iota(wanted.begin(), wanted.end(), 0);
  if (request.cameras) wanted = *request.cameras;
  std::ranges::copy_if(wanted, std::back_inserter(share.cameras),
                       [&](int camera) { return !there[std::size_t(camera)]; });
  if (!request.coarseFirst || share.cameras.empty()) return share;
  std::vector<int> previews;
  std::ranges::copy_if(share.cameras, std::back_inserter(previews),
                       [&](int camera) { return best.empty() || !best[std::size_t(camera)]; });
  OpenProject coarse = open;
  coarse.project.bake = open.project.bake.at(Quality::preview);
  share.previews = pixelsOf(coarse, previews) / pixelsOf(open, share.cameras);
  return share;
}

std::string timeText(double seconds) {
  if (seconds < 100) return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
  return seconds < 6000 ? fmt::format("{:.1f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

BakeShare missingOf(const OpenProject& open, const BakeRequest& request) {
  std::error_code error;
  const auto folder = captureFolderFor(open.file);
  if (std::filesystem::is_directory(folder,
                                    error))  // nothing was ever baked otherwise: asking makes no folder
    if (const auto store = CaptureStore::open(folder)) return missingOf(open, request, *store);
  return shareOf(open, request, std::vector<bool>(open.keys.size(), false), false, {});
}

BakeShare missingOf(const OpenProject& open, const BakeRequest& request, const CaptureStore& store) {
  std::vector<bool> there;
  for (const ContentKey& key : open.keys) there.push_back(store.has(key));
  return shareOf(open, request, there, store.hasSurfaceLight(open.surfaceLightKey), bestKeys(open, store));
}

Result<BakeForecast> forecastBake(std::span<const BakeShare> shares, const BakeForecastOptions& options,
                                  TaskRunner& runner, const Progress& progress, std::stop_token stop) {
  BakeForecast forecast;
  forecast.threads = runner.threads();
  double deviation = 0;
  for (const BakeShare& share : shares) {
    if (!share.any()) continue;
    EstimateOptions estimating;
    estimating.brief = options.brief;
    estimating.effort = options.effort / double(shares.size());
    estimating.surfaceLight = share.light;
    estimating.memoryBytes = options.memoryBytes;
    const auto estimate = estimateProjectBake(*share.open, share.cameras, estimating, runner, progress, stop);
    if (!estimate) return tl::unexpected(estimate.error());
    forecast.memoryBytes = options.memoryBytes;
    forecast.probeSeconds += estimate->probeSeconds;
    if (!share.cameras.empty()) {
      const Figure& seconds = estimate->captureSeconds;
      forecast.cameras += int(share.cameras.size());
      forecast.captureSeconds += (1 + share.previews) * seconds.value;
      forecast.captureBytes += (1 + share.previews) * estimate->captureBytes.value;
      deviation = std::hypot(deviation, (1 + share.previews) * seconds.value * seconds.relativeError);
    }
    if (share.light) {
      const Figure& seconds = estimate->lightSeconds;
      ++forecast.lights;
      forecast.lightSeconds += seconds.value;
      forecast.lightBytes += estimate->lightBytes.value;
      deviation = std::hypot(deviation, seconds.value * seconds.relativeError);
    }
  }
  if (forecast.seconds() > 0) forecast.relativeError = deviation / forecast.seconds();
  return forecast;
}

std::string describe(const BakeForecast& forecast) {
  if (forecast.nothing()) return "nothing to bake: all of it is there";
  std::string what;
  if (forecast.cameras > 0)
    what = fmt::format("{} camera{}", forecast.cameras, forecast.cameras == 1 ? "" : "s");
  if (forecast.lights > 0) what += what.empty() ? "light on surfaces" : " and light on surfaces";
  return fmt::format(
      "{} to bake: about {} with {} thread{}, {:.1f} MB on disk, at most {:.0f} MB of memory besides the "
      "scene",
      what, timeText(forecast.seconds()), forecast.threads, forecast.threads == 1 ? "" : "s",
      forecast.bytes() / 1e6, double(forecast.memoryBytes) / 1e6);
}

}  // namespace acentric
