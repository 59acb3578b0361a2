#pragma once
/// What a bake will take, told before it is run: cameras, megapixels, samples, rays, bytes and seconds.
/// Nothing is assumed about the machine or the scene: a spread of cameras is probed for a second or so, by
/// the very routines of the bake, and the rates found are carried over to all of them.
///
/// Many cameras are probed in part, to see how they differ; a few of them also whole, since parts are slower:
/// rays that lie apart share less in the caches, small pictures pack worse.
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
  double pixels = 0;   ///< traced
  double samples = 0;  ///< that came of it
  double rays = 0;     ///< of all purposes
  double traceSeconds = 0;
  double writtenSamples = 0;  ///< encoded and written, of which the next two
  double bytes = 0;
  double writeSeconds = 0;
};

/// What part of the surfaces' own light cost, beyond the overhead.
struct LightProbe {
  double samples = 0, bytes = 0, seconds = 0;
};
struct LightOverhead {
  double bytes = 0, seconds = 0;
  /// Samples by kind of triangle, exactly. Small triangles lie where much is in the way of the light, large
  /// ones on bare walls: each kind has rates of its own.
  std::vector<double> samplesOfKind;
};

/// Bakes in small. Writing goes on behind the tracing, as in a bake, so that both are measured while they
/// compete for the processors.
class BakeProber {
 public:
  virtual ~BakeProber() = default;
  virtual Result<CaptureOverhead> captureOverhead() = 0;
  virtual Status probeCapture(int camera) = 0;
  /// Waits until all is written: one entry per probed camera, in order.
  virtual Result<std::vector<CaptureProbe>> finishCaptures() = 0;
  /// Bakes these cameras whole, one after another as a bake does; seconds of each, from its beginning to that
  /// of the next, of the last until all is written.
  virtual Result<std::vector<double>> bakeWhole(const std::vector<int>& cameras) = 0;
  /// Seconds to find out what the regions of all cameras see; by the views of the cameras probed so far.
  virtual double sightSeconds() = 0;
  virtual Result<LightOverhead> lightOverhead() = 0;
  /// Another part each time; nothing probed once all of that kind has been.
  virtual Result<LightProbe> probeLight(int kind) = 0;
};

struct EstimateOptions {
  double captureSeconds =
      2.6;                    ///< spent on parts of captures; a few cameras are probed however long it takes
  double lightSeconds = 1.4;  ///< the same for surface light
  bool surfaceLight = true;
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
  Figure samples, rays;  ///< rays without those from the regions' eyes
  Figure captureBytes;
  Figure traceSeconds, writeSeconds;  ///< they overlap ...
  Figure captureSeconds;              ///< ... in this, with `sightSeconds`
  double sightSeconds = 0;            ///< looking what the regions see
  Figure lightSamples, lightBytes, lightSeconds;
  Figure bytes, seconds;  ///< captures and surface light
  int probedCameras = 0;
  double probeSeconds = 0;  ///< that the estimate itself took
};

/// Cameras in an order of which every beginning is spread evenly over [0, count).
std::vector<int> spreadOrder(int count);

/// `pixels[i]`: of camera i. An empty list: there is nothing to bake but the light.
Result<BakeEstimate> estimateBake(const std::vector<double>& pixels, const EstimateOptions& options,
                                  BakeProber& prober, const Progress& progress = {},
                                  std::stop_token stop = {});

}  // namespace acentric
