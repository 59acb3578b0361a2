#include "engine/geometry/column_camera.h"

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {

Status ColumnCamera::check() const {
  const auto bad = [](const char* message) { return fail(ErrorKind::malformed, message, "column camera"); };
  for (double value : {centreOfProjection.x, centreOfProjection.y, centreOfProjection.z, lowAzimuth,
                       fovRadians, topElevation, bottomElevation})
    if (!std::isfinite(value)) return bad("position, directions and elevations must be finite");
  if (columns < 1 || rows < 1 || columns > 65535 || rows > 65535)
    return bad("columns and rows must lie in 1..65535");
  if (fovRadians <= 0 || fovRadians > kPi) return bad("field of view must lie in (0, 180] degrees");
  const double limit = radians(89.9);
  if (topElevation > limit || bottomElevation < -limit || topElevation <= bottomElevation)
    return bad("elevations must rise from bottom to top within +-89.9 degrees");
  return {};
}

glm::dvec2 ColumnCamera::directionAt(double x) const { return directionOf(azimuthAt(x)); }

double ColumnCamera::tangentAt(double y) const { return std::tan(elevationAt(y)); }

void ColumnCamera::addTo(Hasher& hasher) const {
  hasher.value(centreOfProjection.x).value(centreOfProjection.y).value(centreOfProjection.z);
  hasher.value(lowAzimuth).value(fovRadians).value(topElevation).value(bottomElevation);
  hasher.value(columns).value(rows);
}

}  // namespace acentric
