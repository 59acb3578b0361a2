#pragma once
/// How densely a camera samples a surface, and how densely an eye would have to see it sampled: both as
/// linear maps from metres on the surface to samples or pixels, so that a slant counts in the direction in
/// which it is.

#include <glm/glm.hpp>

#include "engine/geometry/column_camera.h"

namespace acentric {

/// Two unit vectors that span the surface of this normal.
struct SurfaceAxes {
  glm::dvec3 first{1, 0, 0}, second{0, 1, 0};
};
SurfaceAxes axesOf(const glm::dvec3& normal);

/// Columns and rows per metre along the axes, at a point. Maps a step on the surface (metres) to samples.
glm::dmat2 samplesPerMetre(const ColumnCamera& camera, const glm::dvec3& point, const SurfaceAxes& axes);

/// Pixels per metre, where an eye looks straight at the point with a focal length in pixels.
glm::dmat2 pixelsPerMetre(const glm::dvec3& eye, double focalPixels, const glm::dvec3& point,
                          const SurfaceAxes& axes);

/// Samples and pixels per metre in that direction on the surface in which there are fewest samples per pixel.
struct RateAndNeed {
  double rate = 0, need = 0;
  /// Samples per pixel; infinity where nothing is needed (the surface is seen edge on).
  double ratio() const;
};
RateAndNeed compareRates(const glm::dmat2& samples, const glm::dmat2& pixels);

}  // namespace acentric
