#pragma once
/// One acentric panorama view APV(o, d, v, c) (paper section 2, apv.md section 1): n = 360 / v cameras whose
/// centres of projection are the corners of a regular n-gon, and whose sectors tile the plane outside it
/// exactly once. With d = 0 it is a traditional panorama view (TPV).

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/base/result.h"
#include "engine/geometry/convex_polygon.h"

namespace acentric {

struct Cover;

enum class Hand : std::uint8_t { counterClockwise, clockwise };

struct Apv {
  glm::dvec2 centre{0};     ///< o, plan, metres
  glm::dvec2 offset{1, 0};  ///< d: from the centre to the first camera's centre of projection, metres
  double fovDegrees = 60;   ///< v of each camera; 360 is a whole multiple of it, at least three times
  Hand hand = Hand::counterClockwise;  ///< c

  /// Finite, and v * n closes to 360 degrees with n in 3..360.
  Status check() const;
  int cameraCount() const;  ///< n
  bool traditional() const { return offset == glm::dvec2(0); }
  /// Cameras wider than 60 degrees are captured by this many equal sub-cameras.
  int subCameras() const;
  bool operator==(const Apv&) const = default;
};

/// Corners P_i = o + R(i v) d, counter-clockwise; none for a traditional panorama.
ConvexPolygon polygonOf(const Apv& apv);

/// The sectors, counter-clockwise by centre of projection; Piece::camera is the camera's number i.
Cover coverOf(const Apv& apv);
/// The same by sub-cameras: Piece::camera is i * subCameras() + part, parts counter-clockwise.
Cover captureCoverOf(const Apv& apv);

}  // namespace acentric
