#pragma once
/// The scene's triangles near the eye: clipped exactly, in plan, to a region grown by the near band (apv.md
/// section 4).

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/convex_polygon.h"
#include "engine/scene/scene.h"
#include "engine/scene/surface_light.h"

namespace acentric {

class DrawnScene;

/// One corner of a clipped triangle. Attributes of the source triangle follow from the barycentric weights.
struct LocalVertex {
  glm::vec3 position;     ///< relative to the project origin, metres
  glm::vec2 barycentric;  ///< weights of the source triangle's 2nd and 3rd corner
};

struct LocalTriangle {
  glm::uvec3 vertices;     ///< into LocalGeometry::vertices
  std::uint32_t mesh;      ///< Scene mesh, or LocalSurfaces mesh
  std::uint32_t triangle;  ///< within that mesh
};

/// Meshes that replace the scene's for one region, with their own light: what simplification makes.
struct LocalSurfaces {
  std::vector<Mesh> meshes;  ///< of the scene's materials
  SurfaceLight light;        ///< triangles numbered through the meshes in order; empty: not baked
  /// By mesh and triangle the mirror's plane (flat_mirrors.h); empty: their shape tells, or of a mesh: none.
  std::vector<std::vector<std::uint8_t>> mirrorPlanes;
};

struct LocalGeometry {
  ConvexPolygon polygon;  ///< what it was clipped to
  std::vector<LocalVertex> vertices;
  std::vector<LocalTriangle> triangles;
  std::shared_ptr<const LocalSurfaces>
      surfaces;  ///< what the triangles are parts of; null: the scene's meshes

  const std::vector<Mesh>& meshes(const Scene& scene) const {
    return surfaces ? surfaces->meshes : scene.meshes;
  }
};

/// `boxes`: around each of the scene's meshes, so that those beside the polygon are not looked at; empty: all
/// are.
LocalGeometry clipToPolygon(const Scene& scene, const ConvexPolygon& polygon,
                            std::span<const Bounds> boxes = {});
LocalGeometry clipToPolygon(const DrawnScene& drawn, const ConvexPolygon& polygon);

}  // namespace acentric
