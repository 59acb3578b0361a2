#pragma once
/// The geometry near a region with its baked light (gltf_region.h).

#include "engine/export/gltf_region.h"

namespace acentric {

class Glb;

Status addLocal(Glb& glb, const WalkScene& walk, const LocalGeometry& local, GltfRegionReport& report);

}  // namespace acentric
