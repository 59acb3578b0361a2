#pragma once
/// Which triangles of the scene some region draws as local geometry: those get light of their own.

#include <cstdint>
#include <glm/glm.hpp>
#include <stop_token>
#include <vector>

#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

/// By scene-wide triangle number.
struct LocalTriangles {
  std::vector<std::uint8_t> wanted;
  std::vector<glm::vec3> viewer;  ///< an eye in the first region (in layout order) that draws the triangle
};

/// Those that this region draws.
std::vector<std::uint8_t> localTrianglesOf(const Scene& scene, const Region& region,
                                           const std::stop_token& stop = {});
/// Stopped, it knows of some of them only.
LocalTriangles localTrianglesOf(const Scene& scene, const Layout& layout, const std::stop_token& stop = {});

}  // namespace acentric
