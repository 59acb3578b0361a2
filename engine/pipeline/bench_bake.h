#pragma once
/// What a bake spends its time on, against what the ray tracer alone would take: a ring of cameras at the
/// spawn, baked with more and more effects, all in one run.

#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

struct BakeBenchOptions {
  int cameras = 8;  ///< of the ring, 6..72, each of 360 degrees / cameras
  int side = 1024;  ///< columns, and rows, of each, 8..16384
  int repeats = 3;  ///< each set is baked so often; the fastest counts
  Status check() const;
};

/// One set of effects.
struct BakeBenchSet {
  std::string name;
  std::string effects;  ///< that are on
  double seconds = 0;   ///< tracing and shading, without files
  CaptureCounts counts;
  double primaryShare = 0;  ///< primary rays per second, against the ray tracer's own on the same first rays
};

struct BakeBench {
  int cameras = 0, side = 0, threads = 0;
  double firstRays = 0;      ///< one per pixel
  double tracerSeconds = 0;  ///< the ray tracer alone, for these
  std::vector<BakeBenchSet> sets;
  /// Of the set `everything`: what each part takes.
  double shadingSeconds = 0, pruningSeconds = 0;
  double encodingSeconds = 0,
         writingSeconds = 0;  ///< one thread, on which the bake does it behind the tracing
  double packBytes = 0, exrBytes = 0;
  /// The set `one shadow ray`, files written, from start to end.
  double ringSeconds = 0;
  double oneThreadSeconds = 0;  ///< `everything` on one thread; 0 if there is only one
};

/// Writes trial files beside the project and removes them.
Result<BakeBench> benchBake(const OpenProject& open, const BakeBenchOptions& options, TaskRunner& runner,
                            const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
