#pragma once
/// Which triangles of a scene are plane mirrors, and which of them make one mirror. In a plane mirror what is
/// seen has one virtual place for all eyes, so that captures can keep it there; in a curved or bumpy one it
/// has not.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/bake/ray_scene.h"

namespace acentric {

/// One side of a plane with mirrors on it. Where on the plane they are is known by a rectangle around them
/// all; a ray tells the rest.
struct FlatMirror {
  std::uint8_t number = 0;  ///< as FlatMirrors::at
  glm::dvec3 point{0};      ///< on the plane
  glm::dvec3 normal{0};     ///< unit, towards those who see it
  glm::dvec3 right{0}, up{0};
  glm::dvec2 low{0}, high{0};  ///< metres from `point` along right and up

  /// Metres before the plane; negative behind it.
  double height(const glm::dvec3& place) const { return glm::dot(normal, place - point); }
  glm::dvec2 inPlane(const glm::dvec3& way) const { return {glm::dot(right, way), glm::dot(up, way)}; }
  glm::dvec3 imageOf(const glm::dvec3& place) const { return place - 2 * height(place) * normal; }
  glm::dvec3 reflected(const glm::dvec3& way) const { return way - 2 * glm::dot(normal, way) * normal; }
};

class FlatMirrors {
 public:
  /// None where the plan has no mirrors. Of more planes than can be numbered those with the largest
  /// triangles.
  FlatMirrors(const Scene& scene, const EffectPlan& plan);

  /// Coplanar triangles are one plane, whatever they belong to; each of its sides is a mirror.
  static constexpr std::size_t kMaxPlanes = 127;

  bool any() const { return !planes_.empty(); }
  /// Number of the mirror whose side is seen at a hit, 1..255; 0: it is no plane mirror.
  std::uint8_t at(const Hit& hit, const glm::vec3& toViewer) const {
    const std::vector<std::uint8_t>& planes = planeOf_[hit.mesh];
    const std::uint8_t plane = planes.empty() ? kNoPlane : planes[hit.triangle];
    if (plane == kNoPlane) return 0;
    return std::uint8_t(1 + 2 * plane + (glm::dot(planes_[plane].normal, toViewer) < 0 ? 1 : 0));
  }
  /// Both sides of all planes, by number.
  std::vector<FlatMirror> sides() const;
  /// Metres: how far a mirror may lie off its plane.
  float slack() const { return slack_; }

 private:
  static constexpr std::uint8_t kNoPlane = 0xff;
  struct Plane {
    glm::vec3 normal{0};  ///< unit
    glm::vec3 point{0};
    glm::vec3 right{0}, up{0};
    glm::vec2 low{0}, high{0};
  };
  float slack_ = 0;
  std::vector<Plane> planes_;
  std::vector<std::vector<std::uint8_t>> planeOf_;  ///< by mesh and triangle; empty: none of the mesh
};

}  // namespace acentric
