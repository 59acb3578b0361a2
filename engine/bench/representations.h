#pragma once
/// Ways of keeping a scene for a walk against each other, on the same work: the same scene and walkable area,
/// as many bytes, the same eyes, ray tracing as the truth. Each is made, measured and let go.

#include "engine/bench/make_representation.h"
#include "engine/measure/compare.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric {

struct RepresentationBenchOptions {
  int poses = 500;
  std::uint64_t seed = 1;
  int width = 640, height = 360;
  double fovDegrees = 0;  ///< 0 = the project's
  int truthSamples = 1;
  double tolerance = 0.1;  ///< share that bytes may be off
  /// On the grid, and where most is unseen; half as many head boxes. 0 = as many as the sectors of the
  /// project's cameras add up to.
  std::size_t panoramas = 0;
  std::vector<std::string> only;  ///< of representationNames(); empty = all
  BakeTeller tell;                ///< none: nothing is foretold
  Status check() const;
};

/// Eyes that belong together.
struct ViewSet {
  std::string name;
  std::vector<PerspectiveView> views;
};

/// Of one representation on one set of views, by view.
struct ViewSetResult {
  std::vector<Comparison> comparisons;
  std::vector<double> frameSeconds;
};

struct RepresentationResult {
  std::string name, description;
  RepresentationCost cost;
  std::vector<ViewSetResult> sets;  ///< as RepresentationBench::sets
};

struct RepresentationBench {
  std::vector<ViewSet> sets;                  ///< the random poses first
  std::vector<RepresentationResult> results;  ///< the project's own first
};

/// In the order in which they are made; the first is the project's own, whose bytes the others are given.
std::vector<std::string> representationNames();

/// Views at random within the walkable area, at eye height. Fails without an outline.
Result<ViewSet> randomViews(const OpenProject& open, const RepresentationBenchOptions& options);

/// `paths`: measured besides the random poses; eyes off the walkable area are left out. Bakes into `folder`,
/// and takes from there what an earlier run baked.
Result<RepresentationBench> benchRepresentations(const OpenProject& open, const std::vector<ViewSet>& paths,
                                                 const std::filesystem::path& folder,
                                                 const RepresentationBenchOptions& options,
                                                 TaskRunner& runner, const Progress& progress = {},
                                                 std::stop_token stop = {});

}  // namespace acentric
