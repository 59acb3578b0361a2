#pragma once
/// Bakes light to the surfaces that some region draws as local geometry.

#include <stop_token>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/scene/surface_light.h"

namespace acentric {

/// `wanted[sceneTriangle]` != 0: bake that triangle. `viewer[sceneTriangle]` is an eye position for
/// view-dependent light (mirrors), frozen there. Fails only when cancelled or too large.
Result<SurfaceLight> bakeSurfaceLight(const RayScene& scene, const std::vector<std::uint8_t>& wanted,
                                      const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                                      TaskRunner& runner, const Progress& progress = {},
                                      std::stop_token stop = {});

/// Where the samples of each triangle would lie, all of them black: no ray is traced. Fails only when too
/// large.
Result<SurfaceLight> layOutSurfaceLight(const RayScene& scene, const std::vector<std::uint8_t>& wanted,
                                        const BakeSettings& settings);

}  // namespace acentric
