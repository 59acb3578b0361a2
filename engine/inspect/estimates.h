#pragma once
/// What a bake will take, told before it is run: cameras, megapixels, samples, rays, bytes and seconds.
/// Nothing is assumed about the machine or the scene: a spread of cameras is probed by the very routines of
/// the bake, and the rates found are carried over to all of them. How much is probed is a matter of rays, not
/// of time: what is foretold of samples, rays and bytes does not depend on what else the machine does.
///
/// Many cameras are probed in part, to see how they differ; slices of a few of them also as densely as a bake
/// does, since parts are slower: rays that lie apart share less in the caches, small pictures pack worse.
/// Light that is gathered once for all who read it is foretold apart from the rest: a part finds none of it
/// there, the whole bake most of it.
///
/// Each figure comes with its standard error: cameras differ, and a probe sees some of them. Probing is
/// injected, since inspect neither traces nor writes; engine/pipeline wires it.

#include <functional>
#include <stop_token>
#include <vector>

#include "engine/base/memory_budget.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace acentric {

/// What a capture costs however few samples it has.
struct CaptureOverhead {
  double traceSeconds = 0, writeSeconds = 0;
  double bytes = 0;
};

/// What part of one camera's capture cost, beyond the overhead.
struct CaptureProbe {
  double pixels = 0;          ///< traced
  double samples = 0;         ///< that came of it
  double rays = 0;            ///< of all purposes but gathering light and the regions' sight
  double traceSeconds = 0;    ///< where all light is gathered already
  double writtenSamples = 0;  ///< encoded and written, which the next two are of
  double bytes = 0;           ///< on disk
  double writeSeconds = 0;
};

/// A dense slice of a camera's capture.
struct SliceProbe {
  double pixels = 0;   ///< traced
  double seconds = 0;  ///< from its beginning to that of the next, less gathering
};

/// Rays that light is gathered with, once for all who read it.
struct GatherForecast {
  double captureRays = 0;
  double lightRays = 0;  ///< for the surfaces' own light, which is baked after the captures
  double relativeError = 0;
  double secondsPerRay = 0;
};

/// What part of the surfaces' own light cost, beyond the overhead.
struct LightProbe {
  double samples = 0;  ///< before grids are made finer at the edges of shadows
  double bytes = 0;
  double seconds = 0;  ///< where all light is gathered already
  double stored = 0;   ///< samples as they are stored
};
struct LightOverhead {
  double bytes = 0, seconds = 0;
  /// Samples by kind of triangle, exactly, before grids are made finer. Small triangles lie where much is in
  /// the way of the light, large ones on bare walls: each kind has rates of its own.
  std::vector<double> samplesOfKind;
};

/// Bakes in small. Writing goes on behind the tracing, as in a bake, so that both are measured while they
/// compete for the processors.
class BakeProber {
 public:
  virtual ~BakeProber() = default;
  /// With or without the surfaces' own light.
  virtual Result<GatherForecast> forecastGathering(bool surfaceLight) = 0;
  virtual Result<CaptureOverhead> captureOverhead() = 0;
  /// How many rays it took, of all purposes.
  virtual Result<double> probeCapture(int camera) = 0;
  /// Waits until all is written: one entry per probed camera, in order.
  virtual Result<std::vector<CaptureProbe>> finishCaptures() = 0;
  /// Bakes slices of these cameras, one after another as a bake does; the last ends when all is written.
  virtual Result<std::vector<SliceProbe>> bakeSlices(const std::vector<int>& cameras) = 0;
  /// Seconds to find out what the regions of all cameras see; by the views of the cameras probed so far.
  virtual double sightSeconds() = 0;
  virtual Result<LightOverhead> lightOverhead() = 0;
  /// Another part each time; nothing probed once all of that kind has been.
  virtual Result<LightProbe> probeLight(int kind) = 0;
};

struct EstimateOptions {
  /// Of the rays that cameras and light are probed with. However small, a few are probed; four times as many
  /// halve the error. 0..1000.
  double effort = 1;
  bool captures = true, surfaceLight = true;  ///< what is to be baked
  /// A tenth of the probes, whatever the effort: good to within a factor of two or so, in seconds.
  bool brief = false;
  /// With brief: a few probes, for a first idea.
  bool glance = false;
  std::size_t memoryBytes = MemoryBudget::kUsual;  ///< as for the bake
  Status check() const;
};

struct Figure {
  double value = 0;
  double relativeError = 0;  ///< one standard deviation over the value, as far as the probes tell
};

struct BakeEstimate {
  int cameras = 0;
  double pixels = 0;
  Figure samples, rays;     ///< rays without those from the regions' eyes and for the surfaces' own light
  double gatheredRays = 0;  ///< of these, to gather light
  Figure captureBytes;      ///< on disk
  Figure traceSeconds, writeSeconds;  ///< they overlap ...
  Figure captureSeconds;              ///< ... in this, with `sightSeconds`
  double sightSeconds = 0;            ///< looking what the regions see
  double gatherSeconds = 0;           ///< of tracing: what need not be done again for the same light
  Figure lightSamples, lightBytes, lightSeconds;
  Figure bytes, seconds;  ///< captures and surface light
  int probedCameras = 0;
  double probeSeconds = 0;  ///< that the estimate itself took
};

/// [0, count) in an order by chance, the same each time. One that is spread evenly would fall in step with
/// the cameras of regions, which come in groups.
std::vector<int> shuffledOrder(int count);

/// `pixels[i]`: of camera i. An empty list: there is nothing to bake but the light.
Result<BakeEstimate> estimateBake(const std::vector<double>& pixels, const EstimateOptions& options,
                                  BakeProber& prober, const Progress& progress = {},
                                  std::stop_token stop = {});

}  // namespace acentric
