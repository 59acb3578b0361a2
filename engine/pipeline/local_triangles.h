#pragma once
/// Which of the triangles that are drawn some region draws as local geometry: those get light of their own.

#include <cstdint>
#include <glm/glm.hpp>
#include <stop_token>
#include <vector>

#include "engine/bake/ray_scene.h"
#include "engine/bake/surface_light_bake.h"
#include "engine/layout/layout.h"
#include "engine/scene/drawn_scene.h"

namespace acentric {

/// By scene-wide number of drawn triangles.
struct LocalTriangles {
  std::vector<LightSides> wanted;  ///< `both` where an eye of a region that draws the triangle sees the back
                                   ///< of a single-sided surface
  std::vector<glm::vec3> viewer;   ///< an eye in the first region (in layout order) that draws the triangle
};

/// Those that this region draws.
std::vector<std::uint8_t> localTrianglesOf(const DrawnScene& drawn, const Region& region,
                                           const std::stop_token& stop = {});
/// Stopped, it knows of some of them only.
LocalTriangles localTrianglesOf(const RayScene& rays, const DrawnScene& drawn, const Layout& layout,
                                TaskRunner& runner, const std::stop_token& stop = {});

}  // namespace acentric
