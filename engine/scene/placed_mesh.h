#pragma once
/// A mesh where it stands: one of the scene's own as it is, an instance's prototype through its transform.
/// Positions and normals are those that the instance placed as a mesh of its own would have (instances.h), to
/// the last bit; only the order of a mirrored triangle's corners stays the prototype's, so that barycentric
/// weights mean the same.

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace acentric {

class PlacedMesh {
 public:
  /// `placed`: below scene.placedCount().
  PlacedMesh(const Scene& scene, std::uint32_t placed)
      : PlacedMesh(scene.meshOf(placed),
                   scene.isInstance(placed)
                       ? &scene.instances[placed - scene.meshes.size()].worldFromPrototype
                       : nullptr) {}
  /// Null: as it is.
  PlacedMesh(const Mesh& mesh, const glm::mat4x3* worldFromMesh)
      : mesh_(mesh), isInstance_(worldFromMesh != nullptr) {
    if (!isInstance_) return;
    linear_ = glm::dmat3(glm::dvec3((*worldFromMesh)[0]), glm::dvec3((*worldFromMesh)[1]),
                         glm::dvec3((*worldFromMesh)[2]));
    shift_ = glm::dvec3((*worldFromMesh)[3]);
  }

  const Mesh& mesh() const { return mesh_; }
  bool isInstance() const { return isInstance_; }

  glm::vec3 position(std::uint32_t vertex) const {
    const glm::vec3& own = mesh_.positions[vertex];
    return isInstance_ ? glm::vec3(linear_ * glm::dvec3(own) + shift_) : own;
  }
  /// In the order in which the prototype has them.
  std::array<glm::vec3, 3> corners(std::uint32_t triangle) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    return {position(t.x), position(t.y), position(t.z)};
  }
  /// Unit; not of a mesh without normals.
  glm::vec3 normal(std::uint32_t vertex) const {
    const glm::vec3& own = mesh_.normals[vertex];
    return isInstance_ ? unitOr(turned(glm::dvec3(own)), own) : own;
  }
  glm::vec4 tangent(std::uint32_t vertex) const {
    const glm::vec4& own = mesh_.tangents[vertex];
    if (!isInstance_) return own;
    return {unitOr(linear_ * glm::dvec3(own), glm::vec3(own)), mirrored() ? -own.w : own.w};
  }
  /// Does its transform turn the winding round?
  bool mirrored() const {
    return isInstance_ && glm::dot(linear_[0], glm::cross(linear_[1], linear_[2])) < 0;
  }
  /// A normal of a surface, from the mesh's frame into the world, of any length: towards its front.
  glm::dvec3 turned(const glm::dvec3& normal) const {
    if (!isInstance_) return normal;
    const glm::dmat3 cofactor(glm::cross(linear_[1], linear_[2]), glm::cross(linear_[2], linear_[0]),
                              glm::cross(linear_[0], linear_[1]));
    const double handedness = glm::dot(linear_[0], cofactor[0]) < 0 ? -1 : 1;
    return handedness * (cofactor * normal);
  }

  /// How far along `normal` (unit) a ray that is carried into the mesh's frame and back may be off at a point
  /// of it, metres, generously: 0 where it stands as it is, or is only moved along axes that the normal lies
  /// across. Rays that leave the surface begin farther off.
  float rounding(const glm::vec3& at, const glm::vec3& normal) const {
    if (!isInstance_) return 0;
    constexpr double kRounding = 16.0 / (1 << 24);
    const glm::dmat3 inverse = glm::inverse(linear_);
    glm::dvec3 own(0);  // magnitudes summed on the way into the frame
    for (int axis = 0; axis < 3; ++axis)
      own += glm::abs(inverse[axis]) * (std::abs(double(at[axis])) + std::abs(shift_[axis]));
    double sum = 0;
    for (int row = 0; row < 3; ++row) {
      double out = 0;
      for (int axis = 0; axis < 3; ++axis) out += std::abs(linear_[axis][row]) * own[axis];
      sum += std::abs(double(normal[row])) * out;
    }
    return static_cast<float>(kRounding * sum);
  }

 private:
  static glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : otherwise;
  }

  const Mesh& mesh_;
  bool isInstance_;
  glm::dmat3 linear_{1};
  glm::dvec3 shift_{0};
};

}  // namespace acentric
