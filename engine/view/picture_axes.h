#pragma once
/// View axes with the focal length and the picture's centre multiplied in: the point in direction d lies at
/// (u . d / z . d, v . d / z . d) on the picture, in pixels. Linear in d, so that a sample's place follows
/// from parts that are computed once per column (ProjectColumn).

#include <glm/glm.hpp>

#include "engine/geometry/perspective_view.h"

namespace acentric {

struct PictureAxes {
  glm::dvec3 u, v, z;

  explicit PictureAxes(const PerspectiveView& view) {
    const glm::dmat3 worldFromView = glm::transpose(view.viewFromWorld());
    const double focal = view.focalPixels();
    z = worldFromView[2];
    u = focal * worldFromView[0] + 0.5 * view.width * z;
    v = focal * worldFromView[1] + 0.5 * view.height * z;
  }
  glm::dvec3 project(const glm::dvec3& direction) const {
    return {glm::dot(u, direction), glm::dot(v, direction), glm::dot(z, direction)};
  }
  template <class T>
  void project(const glm::dvec3& direction, T* out) const {
    const glm::dvec3 q = project(direction);
    for (int i = 0; i < 3; ++i) out[i] = static_cast<T>(q[i]);
  }
};

}  // namespace acentric
