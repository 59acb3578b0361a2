#pragma once
/// Placement by coverage: the next place is where most of the surface that no place sees yet is seen
/// (the greedy answer to the set-cover problem: each place gains the most that one can).

#include <vector>

#include "engine/base/task_runner.h"
#include "engine/inspect/opaque_tracer.h"
#include "engine/inspect/random_poses.h"
#include "engine/inspect/surface_points.h"

namespace acentric {

/// Does place i see point j? sights[i][j] != 0.
using Sights = std::vector<std::vector<char>>;
Sights sightsOf(const std::vector<glm::dvec3>& eyes, const std::vector<glm::dvec3>& points,
                const OpaqueTracer& tracer, TaskRunner& runner);

/// Numbers of `count` places (fewer if there are not so many), in order of choice. When all that can be seen
/// is, points that the fewest of the chosen see count; ties go to the first.
std::vector<std::size_t> chooseGreedily(const Sights& sights, std::size_t count);

struct GreedyOptions {
  int points = 4000;             ///< on surfaces
  int eyes = 64;                 ///< at random: a point that none of them sees does not count
  std::size_t candidates = 400;  ///< places of a grid
  std::uint64_t seed = 1;
};

/// Chosen among the points of a grid and `others`; eyes and places at height `eyeZ`.
Result<std::vector<glm::dvec2>> greedyPlaces(const StandingArea& area, double eyeZ, const ScenePtr& scene,
                                             const OpaqueTracer& tracer, std::size_t count,
                                             const std::vector<glm::dvec2>& others, TaskRunner& runner,
                                             const GreedyOptions& options = {});

}  // namespace acentric
