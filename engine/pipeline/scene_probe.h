#pragma once
/// Wires inspect's probe to the ray tracer.

#include "engine/bake/ray_scene.h"
#include "engine/inspect/surface_probe.h"

namespace acentric {

/// Refers to `rays`, which must live as long as the probe. Safe from several threads.
SurfaceProbe probeFor(const RayScene& rays);

}  // namespace acentric
