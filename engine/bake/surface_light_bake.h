#pragma once
/// Bakes light to the surfaces that some region draws as local geometry.

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/scene/drawn_scene.h"
#include "engine/scene/surface_light.h"
#include "engine/scene/surface_light_part.h"

namespace acentric {

/// Of which sides of a triangle light is wanted. Double-sided and clear materials have it on both in any
/// case.
enum class LightSides : std::uint8_t { none, front, both };

/// Lets a bake be resumed. The light is the same, bit for bit, as without.
struct SurfaceLightParts {
  std::vector<SurfaceLightPart>
      known;  ///< of an earlier bake of the very same light; what does not fit is baked
  /// Stores what was baked since it was called last; threads call it one at a time. A failure ends the bake.
  std::function<Status(const SurfaceLightPart&)> keep;
  double secondsBetween = 2;  ///< at least, between two calls of `keep`; the first is at once
  std::uint64_t resumed = 0;  ///< out: samples taken from `known`
  /// Bakes the runs that hold one of these triangles, and no others: those stay black, and none is made finer
  /// at the edges of shadows. Empty: all of them.
  std::vector<std::uint8_t> only = {};
};

/// `wanted` and `viewer` are by drawn triangle; `viewer` is an eye position for view-dependent light
/// (mirrors), frozen there. `drawn`: of the scene that is traced. Fails only when cancelled or too large.
Result<SurfaceLight> bakeSurfaceLight(const RayScene& scene, const DrawnScene& drawn,
                                      const std::vector<LightSides>& wanted,
                                      const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                                      TaskRunner& runner, const Progress& progress = {},
                                      std::stop_token stop = {}, SurfaceLightParts* parts = nullptr);

/// Where the samples of each triangle would lie, all of them black: no ray is traced. Fails only when too
/// large.
Result<SurfaceLight> layOutSurfaceLight(const RayScene& scene, const DrawnScene& drawn,
                                        const std::vector<LightSides>& wanted, const BakeSettings& settings);

}  // namespace acentric
