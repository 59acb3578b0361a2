#pragma once
/// The two sides of a surface that a ray of a camera meets, straight or by way of a mirror. The eyes of the
/// served regions may see the other side than the ray meets, as of the backs of columns and doors: a capture
/// keeps the sides that eyes see, each for the roles that see it (RegionSight::sideSeen tells which).

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/bake/ray_scene.h"

namespace acentric {

enum class Side : std::uint8_t { none, met, other };

class MetSurface {
 public:
  /// The hit lies at `point`; `direction` is the ray's (unit).
  MetSurface(const Hit& hit, const glm::dvec3& point, const glm::vec3& direction)
      : MetSurface(hit.geometricNormal(), point, direction) {}
  MetSurface(const glm::vec3& normal, const glm::dvec3& point, const glm::vec3& direction)
      : point_(point), toViewer_(-direction), normal_(normal) {
    fromWithin_ = glm::dot(normal_, direction) > 0;
    if (fromWithin_) normal_ = -normal_;
  }

  const glm::dvec3& point() const { return point_; }
  /// Does the ray meet its back, as where it leaves a body?
  bool fromWithin() const { return fromWithin_; }
  /// Which side an eye is on.
  Side sideOf(const glm::dvec3& eye) const {
    return glm::dot(glm::dvec3(normal_), eye - point_) >= 0 ? Side::met : Side::other;
  }
  /// Towards one who sees that side (unit): back along the ray, or the image of that way behind the surface.
  glm::vec3 toViewer(Side side) const {
    return side == Side::met ? toViewer_ : glm::reflect(toViewer_, normal_);
  }

 private:
  glm::dvec3 point_;
  glm::vec3 toViewer_, normal_;
  bool fromWithin_ = false;
};

}  // namespace acentric
