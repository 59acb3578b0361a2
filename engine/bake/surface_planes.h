#pragma once
/// The plane of a surface as a capture's samples keep it (image/capture.h).

#include "engine/bake/ray_scene.h"
#include "engine/image/capture.h"
#include "engine/scene/flat_mirrors.h"

namespace acentric {

/// Of the triangle that a ray from `centre` in `direction` (unit) hits; the same bits for each of the
/// triangle's hits. A triangle that is seen nearly edge on (below 0.06 degrees) says nothing about its
/// neighbourhood: it gets the plane that faces the ray.
SurfacePlane planeOf(const Scene& scene, const Hit& hit, const glm::dvec3& centre, const glm::vec3& direction,
                     bool away);

/// Of the virtual image of a hit that a plane mirror shows at centre + `way`; as often the same bits.
SurfacePlane imagePlaneOf(const Scene& scene, const Hit& hit, const FlatMirror& mirror,
                          const glm::dvec3& centre, const glm::dvec3& way, bool away);

/// Each plane once, in the order in which the samples meet them; rounded, for bytes' sake, by less than
/// distances are that are `distanceStep` apart (0: as they are).
void numberPlanes(CaptureSamples& samples, double distanceStep);

}  // namespace acentric
