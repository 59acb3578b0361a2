#pragma once
/// A pinhole view: where the eye is, where it looks, and the picture's size.

#include <glm/glm.hpp>

#include "engine/base/result.h"

namespace acentric {

/// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

struct PerspectiveView {
  glm::dvec3 eye{0};                       ///< world, metres
  double yawRadians = 0;                   ///< azimuth of the viewing direction
  double pitchRadians = 0;                 ///< in [-pi/2, pi/2]
  double fovRadians = 1.0471975511965976;  ///< horizontal field of view, in (0, pi)
  int width = 960;
  int height = 540;

  /// Finite, field of view in [0.1, 179.9] degrees, size in [1, 16384].
  Status check() const;
  PixelRect pixels() const { return {0, 0, width, height}; }

  /// Focal length in pixels: u = width/2 + focal * x/z, v = height/2 + focal * y/z.
  double focalPixels() const;
  /// Rows are the view axes right, down, forward in world coordinates: view = viewFromWorld * (p - eye).
  glm::dmat3 viewFromWorld() const;
  /// Unit world direction through image position (u, v) in pixels.
  glm::dvec3 rayThrough(double u, double v) const;
};

/// Azimuths that a view's frustum touches: [low, low + width], width <= 2 pi. A pitched frustum touches more
/// than its field of view; one that holds the zenith or nadir touches all.
struct AzimuthRange {
  double low = 0;
  double width = 0;
};
AzimuthRange azimuthRange(const PerspectiveView& view);

}  // namespace acentric
