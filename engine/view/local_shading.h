#pragma once
/// What a point of local geometry looks like: base colour times baked light, plus emission. What the effect
/// plan does not call for is decided once per material, not per pixel.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/scene/texture_lookup.h"
#include "engine/view/surface_kernel.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// A material under one effect plan.
struct LocalMaterial {
  const Material* material = nullptr;
  bool textured = false;
  bool vertexColours = false;
  bool masked = false;        ///< cut out where alpha < alphaCutoff
  bool blended = false;       ///< alpha from the base colour
  bool transmissive = false;  ///< glass: alpha from the viewing angle
  bool emits = false;
  bool emissionTextured = false;
  bool unlit = false;
  bool clear() const { return blended || transmissive; }
};

/// A point of a scene triangle.
struct LocalPoint {
  std::uint32_t mesh = 0;
  std::uint32_t triangle = 0;  ///< within the mesh
  glm::vec2 barycentric{0};    ///< weights of the 2nd and 3rd corner
  bool back = false;           ///< seen from the side that winds clockwise
};

class LocalShading {
 public:
  /// For points of the scene's meshes.
  explicit LocalShading(const WalkScene& scene);
  /// For points of `local`: of the surfaces that it has of its own, if any. Refers to both.
  LocalShading(const WalkScene& scene, const LocalGeometry& local);

  const LocalMaterial& materialOf(std::uint32_t mesh) const {
    return materials_[static_cast<std::size_t>((*meshes_)[mesh].material)];
  }
  const std::vector<LocalMaterial>& materials() const { return materials_; }  ///< by scene material
  /// Does an alpha-tested surface exist at this point?
  bool survivesMask(const LocalPoint& point) const;
  /// Its alpha, unless the effect plan leaves the material opaque: then 1. Not of glass.
  float alphaAt(const LocalPoint& point) const;
  /// Display-linear colour; alpha 1 unless the material is clear. Without baked light: the base colour.
  glm::vec4 shownAt(const LocalPoint& point, const glm::vec3& eye) const;
  /// The same as sRGB codes.
  Rgba8 colourAt(const LocalPoint& point, const glm::vec3& eye) const;
  /// The same for all points of an opaque triangle with these corners; nothing where that needs more than
  /// kernels know. Refers to the scene and its light.
  std::optional<SurfaceShade> triangle(const std::array<LocalPoint, 3>& corners) const;
  /// The same of a clear one.
  std::optional<ClearShade> clearTriangle(const std::array<LocalPoint, 3>& corners,
                                          const glm::vec3& eye) const;

  /// Samples a side of its light, of a triangle of a mesh; 0: none.
  int lightResolution(std::uint32_t mesh, std::uint32_t triangle) const;
  /// Where there is none, the front's light serves both sides.
  bool hasLightOnBack(std::uint32_t mesh, std::uint32_t triangle) const;

 private:
  std::optional<SurfaceShade> surfaceOf(const std::array<LocalPoint, 3>& corners) const;
  glm::vec4 baseColourAt(const LocalMaterial& material, const Mesh& mesh, const LocalPoint& point) const;

  const Scene* scene_;
  const std::vector<Mesh>* meshes_;
  const SurfaceLight* light_;
  float exposure_;
  std::vector<LocalMaterial> materials_;       ///< by scene material
  std::vector<std::uint32_t> firstTriangles_;  ///< by mesh
};

}  // namespace acentric
