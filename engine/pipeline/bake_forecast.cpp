#include "engine/pipeline/bake_forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "engine/base/stopwatch.h"
#include "engine/pipeline/estimate_bake.h"

namespace acentric {
namespace {

/// Of a sample that is ready to be drawn.
constexpr double kShownSampleBytes = sizeof(PackedSample) + sizeof(Rgba8);

/// `there`: by camera, is its capture on disk? `best`: of each, what is.
BakeShare shareOf(const OpenProject& open, const BakeRequest& request, const std::vector<bool>& there,
                  bool lightThere, const std::vector<std::optional<ContentKey>>& best) {
  BakeShare share{&open, {}, request.surfaceLight && !lightThere, 0};
  const std::vector<int> wanted = request.cameras ? *request.cameras : allCamerasOf(*open.layout);
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

/// By how much more a bake takes whose packs are to have so many bytes: both grow with the square of the
/// resolution.
double growthTo(double packedBytes, const BakeShare& share, const BakeEstimate& estimate) {
  const auto squared = [&](double samplesPerDegree) {
    return std::pow(samplesPerDegree / share.open->project.bake.samplesPerDegree, 2);
  };
  return std::clamp(packedBytes / std::max(estimate.captureBytes.value, 1.0), squared(kLeastSamplesPerDegree),
                    squared(kMostSamplesPerDegree));
}

BakeForecast forecastOf(const BakeShare& share, const BakeEstimate& estimate) {
  const TrialBake trial = share.trial.value_or(TrialBake{});
  const bool onDisk = trial.kept == TrialBake::Kept::onDisk;
  const double growth = trial.packedBytes ? growthTo(*trial.packedBytes, share, estimate) : 1;
  BakeForecast forecast;
  forecast.probeSeconds = estimate.probeSeconds;
  double deviation = 0;
  if (!share.cameras.empty()) {
    const double whole = estimate.captureSeconds.value, gathering = std::min(whole, estimate.gatherSeconds);
    forecast.cameras = trial.bakes * int(share.cameras.size());
    forecast.bakes = share.trial ? trial.bakes : 0;
    forecast.captureSeconds = growth * trial.times * (1 + share.previews) * (whole - gathering);
    if (trial.gathers) forecast.captureSeconds += (1 + share.previews) * gathering;
    forecast.packedBytes = growth * estimate.captureBytes.value;
    if (onDisk) forecast.captureBytes = growth * (1 + share.previews) * estimate.captureBytes.value;
    deviation = forecast.captureSeconds * estimate.captureSeconds.relativeError;
  }
  if (share.light) {
    const Figure& seconds = estimate.lightSeconds;
    forecast.lights = 1;
    forecast.lightSeconds = seconds.value;
    if (onDisk) forecast.lightBytes = estimate.lightBytes.value;
    deviation = std::hypot(deviation, seconds.value * seconds.relativeError);
  }
  if (forecast.seconds() > 0) forecast.relativeError = deviation / forecast.seconds();
  return forecast;
}

/// Those of which something is to be baked: the first, then the others by their cameras, the most first.
std::vector<const BakeShare*> inOrder(std::span<const BakeShare> shares) {
  std::vector<const BakeShare*> order;
  for (const BakeShare& share : shares)
    if (share.any()) order.push_back(&share);
  if (!order.empty())
    std::ranges::stable_sort(std::span(order).subspan(1), std::ranges::greater(),
                             [](const BakeShare* share) { return share->cameras.size(); });
  return order;
}

std::string timeText(double seconds) {
  if (seconds < 100) return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
  return seconds < 6000 ? fmt::format("{:.1f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

double pixelsOf(const OpenProject& open, std::span<const int> cameras) {
  double pixels = 0;
  for (const int camera : cameras) {
    const ColumnCamera columns = columnCameraFor(open.layout->cameras[std::size_t(camera)], *open.layout,
                                                 open.scene->bounds, open.project.bake);
    pixels += double(columns.columns) * columns.rows;
  }
  return pixels;
}

std::vector<int> allCamerasOf(const Layout& layout) {
  std::vector<int> all(layout.cameras.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

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

BakeForecast BakeForecast::ofSoManyCameras(int others) const {
  BakeForecast scaled = *this;
  if (cameras == 0) return scaled;
  const double share = double(others) / cameras;
  scaled.cameras = others;
  for (double BakeForecast::*part :
       {&BakeForecast::captureSeconds, &BakeForecast::lightSeconds, &BakeForecast::captureBytes,
        &BakeForecast::lightBytes, &BakeForecast::packedBytes})
    scaled.*part *= share;
  return scaled;
}

BakeForecast& BakeForecast::operator+=(const BakeForecast& next) {
  const double deviation = std::hypot(relativeError * seconds(), next.relativeError * next.seconds());
  cameras += next.cameras, bakes += next.bakes, lights += next.lights;
  threads = std::max(threads, next.threads);
  captureSeconds += next.captureSeconds, lightSeconds += next.lightSeconds;
  captureBytes += next.captureBytes, lightBytes += next.lightBytes, packedBytes += next.packedBytes;
  relativeError = seconds() > 0 ? deviation / seconds() : 0;
  memoryBytes = std::max(memoryBytes, next.memoryBytes);
  probeSeconds += next.probeSeconds;
  return *this;
}

Result<BakeForecast> forecastBake(std::span<const BakeShare> shares, const BakeForecastOptions& options,
                                  TaskRunner& runner, const Progress& progress, std::stop_token stop) {
  BakeForecast forecast;
  forecast.threads = runner.threads();
  double inMemory = 0;
  const Stopwatch watch;
  int cameras = 0, lights = 0;
  for (const BakeShare* next : inOrder(shares)) {
    const BakeShare& share = *next;
    cameras += int(share.cameras.size()), lights += int(share.light);
    if (options.brief && forecast.cameras > 0 && watch.seconds() > options.enoughSeconds) continue;
    EstimateOptions estimating;
    estimating.brief = options.brief;
    estimating.glance = options.glance;
    estimating.effort = options.effort / double(shares.size());
    estimating.captures = !share.cameras.empty();
    estimating.surfaceLight = share.light;
    estimating.memoryBytes = options.memoryBytes;
    const auto estimate = estimateProjectBake(*share.open, share.cameras, estimating, runner, progress, stop);
    if (!estimate) return tl::unexpected(estimate.error());
    forecast += forecastOf(share, *estimate);
    forecast.memoryBytes = options.memoryBytes;
    if (share.trial && share.trial->kept == TrialBake::Kept::inMemory)
      inMemory += kShownSampleBytes * estimate->samples.value;
  }
  if (forecast.cameras < cameras) forecast = forecast.ofSoManyCameras(cameras);
  forecast.lights = lights;
  forecast.memoryBytes += std::size_t(inMemory);
  return forecast;
}

std::string describe(const BakeForecast& forecast) {
  if (forecast.nothing()) return "nothing to bake: all of it is there";
  std::string what;
  if (forecast.cameras > 0)
    what = fmt::format("{} camera{}", forecast.cameras, forecast.cameras == 1 ? "" : "s");
  if (forecast.bakes > 0 && forecast.cameras > 0)
    what += fmt::format(" in {} bake{}", forecast.bakes, forecast.bakes == 1 ? "" : "s");
  if (forecast.lights > 0) what += what.empty() ? "light on surfaces" : " and light on surfaces";
  const std::string bytes =
      forecast.bytes() > 0 ? fmt::format("{:.1f} MB", forecast.bytes() / 1e6) : "nothing";
  return fmt::format(
      "{} to bake: about {} with {} thread{}, {} on disk, at most {:.0f} MB of memory besides the scene",
      what, timeText(forecast.seconds()), forecast.threads, forecast.threads == 1 ? "" : "s", bytes,
      double(forecast.memoryBytes) / 1e6);
}

}  // namespace acentric
