#pragma once
/// What lies infinitely far, as a sphere around the scene.

#include "engine/export/draw_model.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Around `middle`.
void addSky(const WalkScene& walk, const glm::dvec3& middle, DrawModel& model);

}  // namespace acentric
