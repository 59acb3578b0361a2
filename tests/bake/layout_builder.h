#pragma once
/// Capture cameras and layouts made by hand, without a lattice.

#include "engine/bake/bake.h"
#include "engine/geometry/conventions.h"
#include "engine/layout/layout.h"

namespace acentric::test {

inline ConvexPolygon square(double halfSize, glm::dvec2 centre = glm::dvec2(0)) {
  const double h = halfSize;
  return {{centre + glm::dvec2(-h, -h), centre + glm::dvec2(h, -h), centre + glm::dvec2(h, h),
           centre + glm::dvec2(-h, h)}};
}

/// At a place, looking along +x, 60 degrees wide.
inline LayoutCamera cameraAt(glm::dvec2 position, std::vector<ConvexPolygon> served) {
  LayoutCamera camera;
  camera.position = position;
  camera.lowAzimuth = radians(-30);
  camera.fovRadians = radians(60);
  for (ConvexPolygon& polygon : served) {
    const int number = int(camera.roles.size());
    camera.roles.push_back({{number, 0, 0}, polygon, std::move(polygon)});
  }
  return camera;
}

inline Layout layoutOf(std::vector<LayoutCamera> cameras) {
  Layout layout;
  layout.cameras = std::move(cameras);
  for (std::size_t i = 0; i < layout.cameras.size(); ++i) layout.cameras[i].id.i = int(i);
  return layout;
}

}  // namespace acentric::test
