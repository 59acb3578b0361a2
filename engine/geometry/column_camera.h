#pragma once
/// Column camera: an image whose columns are vertical half-planes through the centre of projection. A table
/// of horizontal column directions times a table of row tangents holds pinholes with a vertical image plane,
/// cylinders and spheres alike, and is what list priority in column order needs (McMillan's occlusion-
/// compatible order; every great circle through the epipole is monotone in azimuth).
///
/// Columns run counter-clockwise: column k covers azimuths [low + k*pitch, low + (k+1)*pitch).
/// Rows run downwards: row 0 is the highest. Rows are evenly spaced in elevation.
/// A sample at column direction c (unit, horizontal), row tangent t and inverse distance w lies at
/// P + (c + t z) / w; w = 0 is sky.

#include <glm/glm.hpp>

#include "engine/base/hash.h"
#include "engine/base/result.h"

namespace acentric {

struct ColumnCamera {
  glm::dvec3 centreOfProjection{0};  ///< P, world, metres
  double lowAzimuth = 0;             ///< radians, the clockwise border of the sector
  double fovRadians = 0;             ///< in (0, pi/3 + epsilon]: wider cameras are built of sub-cameras
  double topElevation = 0;           ///< radians, upper border of row 0
  double bottomElevation = 0;        ///< radians, lower border of the last row
  int columns = 0;
  int rows = 0;

  Status check() const;  ///< finite, 1..65535 columns and rows, elevations within +-89.9 degrees

  double columnPitch() const { return fovRadians / columns; }
  double rowPitch() const { return (topElevation - bottomElevation) / rows; }
  /// Azimuth and unit direction at column position x (x = k + 0.5 is the centre of column k).
  double azimuthAt(double x) const { return lowAzimuth + x * columnPitch(); }
  glm::dvec2 directionAt(double x) const;
  /// Tangent of the elevation at row position y (y = r + 0.5 is the centre of row r).
  double tangentAt(double y) const;
  double elevationAt(double y) const { return topElevation - y * rowPitch(); }
  /// By how much dot(normal, (c, t)) rises from one column to the next, and from one row to the next.
  glm::dvec2 risePerSample(const glm::dvec3& normal, const glm::dvec2& c, double t) const {
    return {columnPitch() * (normal.y * c.x - normal.x * c.y), -rowPitch() * (1 + t * t) * normal.z};
  }

  void addTo(Hasher& hasher) const;
  bool operator==(const ColumnCamera&) const = default;
};

}  // namespace acentric
