#pragma once
/// The captures of a region as textured meshes (gltf_region.h).

#include "engine/export/gltf_region.h"

namespace acentric {

class Glb;

Status addCaptures(Glb& glb, const WalkScene& walk, int region, const GltfOptions& options,
                   GltfRegionReport& report, TaskRunner& runner, const std::stop_token& stop);
/// What lies infinitely far: a sphere around the scene.
void addSky(Glb& glb, const WalkScene& walk, int region);

/// (x, y, z) with Z up as glTF has it, with Y up.
inline glm::vec3 gltfPosition(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

}  // namespace acentric
