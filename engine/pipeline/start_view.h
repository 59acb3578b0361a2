#pragma once
/// Where a walk begins: a place with room around it, looking along the richest view there is. Never at a wall
/// a step away, and not up into an empty sky.

#include "engine/bake/ray_scene.h"
#include "engine/layout/layout.h"
#include "engine/pipeline/project.h"

namespace acentric {

/// What one sees in one direction.
struct ViewWorth {
  double depth = 0;    ///< metres, the geometric mean over the view, each ray counted to 40 m
  double near = 0;     ///< share of the view nearer than 1.5 m
  double sky = 0;      ///< share of the view without a surface
  double variety = 0;  ///< kinds of surface in it (mesh and material), from 0 (one) to 1 (eight and more)

  double score() const;
};

/// Of a view 60 degrees wide and about 35 high.
ViewWorth worthOf(const RayScene& rays, const glm::dvec3& eye, double yawRadians);

/// The best of a storey's regions and directions. The same for the same scene and layout.
Spawn chooseStart(const Layout& layout, const RayScene& rays);

}  // namespace acentric
