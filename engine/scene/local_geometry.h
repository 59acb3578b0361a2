#pragma once
/// The scene's triangles near the eye: clipped exactly, in plan, to a region grown by the near band (apv.md
/// section 4).

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/geometry/convex_polygon.h"
#include "engine/scene/scene.h"

namespace acentric {

/// One corner of a clipped triangle. Attributes of the source triangle follow from the barycentric weights.
struct LocalVertex {
  glm::vec3 position;     ///< relative to the project origin, metres
  glm::vec2 barycentric;  ///< weights of the source triangle's 2nd and 3rd corner
};

struct LocalTriangle {
  glm::uvec3 vertices;     ///< into LocalGeometry::vertices
  std::uint32_t mesh;      ///< Scene mesh
  std::uint32_t triangle;  ///< within that mesh
};

struct LocalGeometry {
  ConvexPolygon polygon;  ///< what it was clipped to
  std::vector<LocalVertex> vertices;
  std::vector<LocalTriangle> triangles;
};

LocalGeometry clipToPolygon(const Scene& scene, const ConvexPolygon& polygon);

}  // namespace acentric
