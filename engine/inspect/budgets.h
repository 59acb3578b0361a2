#pragma once
/// Triangles of local geometry per region, and estimates of what a bake will take.

#include <vector>

#include "engine/layout/layout.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Triangles of the scene clipped to each region's grown polygon, in order of Layout::regions.
std::vector<std::size_t> countLocalTriangles(const Scene& scene, const Layout& layout);

}  // namespace acentric
