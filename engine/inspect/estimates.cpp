#include "engine/inspect/estimates.h"
#include "engine/base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace acentric {
namespace {

/// Fewer tell nothing about how cameras differ: some have ten times the samples of others.
constexpr std::size_t kFewestProbes = 32;
/// Of these, slices are baked densely too.
constexpr std::size_t kSlicedProbes = 8;
/// Rays for probing cameras, and samples of the surfaces' own light, at an effort of 1.
constexpr double kCaptureRays = 12e6, kLightSamples = 4e5;
/// The same where it is to be brief: a tenth of the cameras, within these bounds, as long as that takes no
/// more than kBriefSeconds.
constexpr double kBriefSeconds = 2;
constexpr std::size_t kFewestBriefProbes = 4, kBriefProbes = 10, kBriefSliced = 3, kGlanceSliced = 2;

/// Ratio estimate of `part` per `whole` over the probes that have any of it, with its standard error; `share`
/// of the population was probed.
template <class Probe>
Figure ratioOf(const std::vector<Probe>& probes, double Probe::*part, double Probe::*whole, double share) {
  double parts = 0, wholes = 0, n = 0;
  for (const Probe& probe : probes) parts += probe.*part, wholes += probe.*whole, n += probe.*whole > 0;
  if (!(wholes > 0)) return {};
  const double ratio = parts / wholes;
  if (n < 2 || !(ratio > 0)) return {ratio, n < 2 ? 1.0 : 0.0};
  double squares = 0;
  for (const Probe& probe : probes) {
    const double residual = probe.*part - ratio * (probe.*whole);
    squares += residual * residual;
  }
  const double deviation = std::sqrt(squares / (n - 1) / n) / (wholes / n);
  return {ratio, deviation * std::sqrt(std::max(0.0, 1 - share)) / ratio};
}

Figure times(const Figure& figure, double factor) { return {figure.value * factor, figure.relativeError}; }

/// The product; the errors of both add up, as if independent.
Figure product(const Figure& a, const Figure& b) {
  return {a.value * b.value, std::hypot(a.relativeError, b.relativeError)};
}

/// `exact` is known without error.
Figure sum(const Figure& a, const Figure& b, double exact = 0) {
  const double value = a.value + b.value + exact;
  const double error = std::hypot(a.value * a.relativeError, b.value * b.relativeError);
  return {value, value > 0 ? error / value : 0};
}

Error stopped() { return {ErrorKind::cancelled, "the estimate was stopped", "estimate"}; }

/// A slice's seconds as the camera's part foretells them, and as it took.
struct Pace {
  double foretold = 0, taken = 0;
};

/// How much of the time that parts foretell dense slices take.
Result<Figure> measurePace(const std::vector<double>& pixels, const std::vector<int>& order,
                           const std::vector<CaptureProbe>& probes, const CaptureOverhead& overhead,
                           const EstimateOptions& options, BakeProber& prober) {
  const std::size_t wanted = !options.brief ? kSlicedProbes : options.glance ? kGlanceSliced : kBriefSliced;
  const std::size_t count = std::min(wanted, probes.size());
  const auto slices = prober.bakeSlices({order.begin(), order.begin() + std::ptrdiff_t(count)});
  if (!slices) return tl::unexpected(slices.error());
  std::vector<Pace> tracing, writing;
  double traced = 0, written = 0, sliced = 0, all = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const CaptureProbe& probe = probes[p];
    const auto& [slicePixels, seconds] = (*slices)[p];
    const double times = probe.pixels > 0 ? slicePixels / probe.pixels : 0;
    const double perSample = probe.writtenSamples > 0 ? probe.writeSeconds / probe.writtenSamples : 0;
    tracing.push_back({overhead.traceSeconds + times * probe.traceSeconds, seconds});
    writing.push_back({overhead.writeSeconds + times * probe.samples * perSample, seconds});
    traced += tracing.back().foretold, written += writing.back().foretold;
    sliced += slicePixels, all += pixels[std::size_t(order[p])];
  }
  // The slower of the two over all of them, as for the whole bake: each waits for the other's queue only.
  const std::vector<Pace>& paces = traced >= written ? tracing : writing;
  const double share = double(count) / double(pixels.size()) * (all > 0 ? sliced / all : 1);
  return ratioOf(paces, &Pace::taken, &Pace::foretold, share);
}

/// Probes cameras until enough rays are traced.
Result<std::vector<CaptureProbe>> probeCaptures(const std::vector<int>& order, const EstimateOptions& options,
                                                BakeProber& prober, const Progress& progress,
                                                const std::stop_token& stop) {
  const double wanted = options.brief ? 0 : kCaptureRays * options.effort;
  const std::size_t fewestProbes = !options.brief
                                       ? kFewestProbes
                                       : std::clamp(order.size() / 10, kFewestBriefProbes,
                                                    options.glance ? kFewestBriefProbes : kBriefProbes);
  const Stopwatch watch;
  double rays = 0;
  for (std::size_t probed = 0; probed < order.size(); ++probed) {
    if (probed >= fewestProbes && rays >= wanted) break;
    if (options.brief && probed >= kFewestBriefProbes && watch.seconds() > kBriefSeconds) break;
    if (stop.stop_requested()) return tl::unexpected(stopped());
    if (progress) {
      const double fewest = double(probed) / double(std::min(fewestProbes, order.size()));
      progress({std::min(fewest, wanted > 0 ? rays / wanted : fewest), 1, "probing cameras"});
    }
    const auto traced = prober.probeCapture(order[probed]);
    if (!traced) return tl::unexpected(traced.error());
    rays += *traced;
  }
  return prober.finishCaptures();
}

Status estimateCaptures(const std::vector<double>& pixels, const EstimateOptions& options,
                        const GatherForecast& gathering, BakeProber& prober, const Progress& progress,
                        const std::stop_token& stop, BakeEstimate& estimate) {
  const auto overhead = prober.captureOverhead();
  if (!overhead) return tl::unexpected(overhead.error());
  const std::vector<int> order = shuffledOrder(int(pixels.size()));
  const auto probes = probeCaptures(order, options, prober, progress, stop);
  if (!probes) return tl::unexpected(probes.error());

  const double cameras = double(pixels.size());
  // Each camera counts by its own pixels, however many of them were traced.
  std::vector<CaptureProbe> whole = *probes;
  double probedPixels = 0;
  for (std::size_t p = 0; p < whole.size(); ++p) {
    CaptureProbe& probe = whole[p];
    probedPixels += probe.pixels;
    const double times = probe.pixels > 0 ? pixels[std::size_t(order[p])] / probe.pixels : 0;
    for (double CaptureProbe::*part :
         {&CaptureProbe::pixels, &CaptureProbe::samples, &CaptureProbe::rays, &CaptureProbe::traceSeconds})
      probe.*part *= times;
  }
  const double seenShare = std::min(double(probes->size()) / cameras, probedPixels / estimate.pixels);
  const auto ratio = [&](double CaptureProbe::*part, double CaptureProbe::*per) {
    return ratioOf(whole, part, per, seenShare);
  };
  const auto perPixel = [&](double CaptureProbe::*part) {
    return times(ratio(part, &CaptureProbe::pixels), estimate.pixels);
  };
  const auto perSample = [&](double CaptureProbe::*part) {
    return product(ratio(part, &CaptureProbe::writtenSamples), estimate.samples);
  };
  const Figure gathered{gathering.captureRays, gathering.relativeError};
  estimate.probedCameras = int(probes->size());
  estimate.samples = perPixel(&CaptureProbe::samples);
  estimate.gatheredRays = gathered.value;
  estimate.rays = sum(perPixel(&CaptureProbe::rays), gathered);
  estimate.captureBytes = sum(perSample(&CaptureProbe::bytes), {}, cameras * overhead->bytes);
  const Figure tracing = sum(perPixel(&CaptureProbe::traceSeconds), {}, cameras * overhead->traceSeconds);
  const Figure writing = sum(perSample(&CaptureProbe::writeSeconds), {}, cameras * overhead->writeSeconds);
  const auto pace = measurePace(pixels, order, *probes, *overhead, options, prober);
  if (!pace) return tl::unexpected(pace.error());
  estimate.gatherSeconds = gathered.value * gathering.secondsPerRay;
  estimate.traceSeconds = sum(product(tracing, *pace), times(gathered, gathering.secondsPerRay));
  estimate.writeSeconds = product(writing, *pace);
  estimate.sightSeconds = prober.sightSeconds();
  // One camera is written while the next is traced: the slower of the two sets the pace, and the other adds
  // its first or last camera.
  const bool traced = estimate.traceSeconds.value >= estimate.writeSeconds.value;
  const Figure& slower = traced ? estimate.traceSeconds : estimate.writeSeconds;
  const Figure& faster = traced ? estimate.writeSeconds : estimate.traceSeconds;
  estimate.captureSeconds = sum(slower, times(faster, 1 / cameras), estimate.sightSeconds);
  return {};
}

Status estimateLight(const EstimateOptions& options, const GatherForecast& gathering, BakeProber& prober,
                     const Progress& progress, const std::stop_token& stop, BakeEstimate& estimate) {
  if (progress) progress({0, 0, "finding local geometry"});
  const auto overhead = prober.lightOverhead();
  if (!overhead) return tl::unexpected(overhead.error());
  const std::vector<double>& samples = overhead->samplesOfKind;
  std::vector<std::vector<LightProbe>> probes(samples.size());
  std::vector<bool> exhausted(samples.size(), false);
  const double wanted = options.brief ? 0 : kLightSamples * options.effort;
  double all = 0;
  for (int round = 0; round < (options.brief ? 1 : 2) || all < wanted; ++round) {
    for (std::size_t kind = 0; kind < samples.size(); ++kind) {
      if (exhausted[kind]) continue;
      if (stop.stop_requested()) return tl::unexpected(stopped());
      if (progress) progress({std::min(all, wanted), wanted, "probing light on surfaces"});
      const auto probe = prober.probeLight(int(kind));
      if (!probe) return tl::unexpected(probe.error());
      exhausted[kind] = probe->samples == 0;
      if (!exhausted[kind]) probes[kind].push_back(*probe);
      all += probe->samples;
    }
    if (std::ranges::find(exhausted, false) == exhausted.end()) break;
  }
  estimate.lightBytes = {overhead->bytes, 0};
  estimate.lightSeconds =
      sum({overhead->seconds, 0}, {gathering.lightRays * gathering.secondsPerRay, gathering.relativeError});
  for (std::size_t kind = 0; kind < samples.size(); ++kind) {
    double probed = 0;
    for (const LightProbe& probe : probes[kind]) probed += probe.samples;
    const double share = samples[kind] > 0 ? probed / samples[kind] : 1;
    const auto whole = [&](double LightProbe::*part) {
      return times(ratioOf(probes[kind], part, &LightProbe::samples, share), samples[kind]);
    };
    estimate.lightSamples = sum(estimate.lightSamples, whole(&LightProbe::stored));
    estimate.lightBytes = sum(estimate.lightBytes, whole(&LightProbe::bytes));
    estimate.lightSeconds = sum(estimate.lightSeconds, whole(&LightProbe::seconds));
  }
  return {};
}

}  // namespace

Status EstimateOptions::check() const {
  if (!(effort >= 0 && effort <= 1000))
    return fail(ErrorKind::invalidArgument, "the effort must lie in 0..1000", "estimate");
  return {};
}

std::vector<int> shuffledOrder(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(1);
  for (std::size_t left = order.size(); left > 1; --left) std::swap(order[left - 1], order[random() % left]);
  return order;
}

Result<BakeEstimate> estimateBake(const std::vector<double>& pixels, const EstimateOptions& options,
                                  BakeProber& prober, const Progress& progress, std::stop_token stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const Stopwatch watch;
  BakeEstimate estimate;
  estimate.cameras = int(pixels.size());
  estimate.pixels = std::accumulate(pixels.begin(), pixels.end(), 0.0);
  if (progress && (!pixels.empty() || options.surfaceLight)) progress({0, 0, "asking what needs light"});
  const auto gathering = prober.forecastGathering(options.surfaceLight);
  if (!gathering) return tl::unexpected(gathering.error());
  if (!pixels.empty())
    if (Status done = estimateCaptures(pixels, options, *gathering, prober, progress, stop, estimate); !done)
      return tl::unexpected(done.error());
  if (options.surfaceLight)
    if (Status done = estimateLight(options, *gathering, prober, progress, stop, estimate); !done)
      return tl::unexpected(done.error());
  estimate.bytes = sum(estimate.captureBytes, estimate.lightBytes);
  estimate.seconds = sum(estimate.captureSeconds, estimate.lightSeconds);
  estimate.probeSeconds = watch.seconds();
  return estimate;
}

}  // namespace acentric
