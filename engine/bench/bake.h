#pragma once
/// What a bake spends its time on, against what the ray tracer alone would take: a ring of cameras at the
/// spawn, baked with more and more effects and in each quality, all in one run.

#include <string>
#include <vector>

#include "engine/pipeline/bake_forecast.h"

namespace acentric {

struct BakeBenchOptions {
  int cameras = 8;  ///< of the ring, 6..72, each of 360 degrees / cameras
  int side = 1024;  ///< columns, and rows, of each, 8..16384
  int repeats = 3;  ///< each set is baked so often; the fastest counts
  BakeTeller tell;  ///< none: nothing is foretold
  Status check() const;
};

/// One set of effects, or one quality.
struct BakeBenchSet {
  std::string name;
  double firstRays = 0;  ///< one per pixel
  std::string effects;   ///< that are on
  double seconds = 0;    ///< tracing and shading, without files
  CaptureCounts counts;  ///< of the last repeat
  /// Gathering the light that all cameras share, once, on all threads together; not in `seconds` where there
  /// are repeats.
  double gatherSeconds = 0;
  /// Of one camera on one thread, where what cameras share is known already: the part of its time that the
  /// ray tracer alone takes for the same rays, of all kinds.
  double tracerShare = 0;
  double primaryShare = 0;  ///< primary rays per second, against the ray tracer's own on the same first rays
};

/// What the ring takes, from all that its rays meet to its files.
struct BakeBenchBytes {
  double everySurface = 0;  ///< in memory, up to the limit of layers
  double pruned = 0;        ///< in memory, what some region sees
  double surfaces = 0;      ///< the same with the background as runs of rows
  double quantised = 0;     ///< the same with distances of 16 significant bits
  double pack = 0;
};

struct BakeBench {
  int cameras = 0, side = 0, threads = 0;
  double firstRays = 0;            ///< one per pixel
  double tracerSeconds = 0;        ///< the ray tracer alone, for these
  std::vector<BakeBenchSet> sets;  ///< the last: final quality
  double shadingSeconds = 0;       ///< of all effects, with one layer
  /// Of the last set, one thread, on which the bake does it behind the tracing.
  double encodingSeconds = 0, writingSeconds = 0;
  BakeBenchBytes bytes;
  /// The set `one shadow ray`, files written, from start to end.
  double ringSeconds = 0;
  double oneThreadSeconds = 0;  ///< the last set on one thread; 0 if there is only one
};

/// Writes trial files beside the project and removes them.
Result<BakeBench> benchBake(const OpenProject& open, const BakeBenchOptions& options, TaskRunner& runner,
                            const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
