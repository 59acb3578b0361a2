#include "editor/tools/snap.h"

#include <cmath>
#include <limits>

#include "editor/tools/pointer_event.h"
#include "engine/geometry/conventions.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

std::optional<glm::dvec2> nearestCorner(std::span<const glm::dvec2> corners, const glm::dvec2& point,
                                        double pixelsPerMetre) {
  std::optional<glm::dvec2> best;
  double nearest = kGrabPixels / pixelsPerMetre;
  for (const glm::dvec2& corner : corners)
    if (const double distance = glm::distance(corner, point); distance <= nearest)
      nearest = distance, best = corner;
  return best;
}

std::optional<glm::dvec2> nearestCellCorner(const LayoutSpec& spec, const glm::dvec2& point,
                                            double pixelsPerMetre) {
  return nearestCorner(cellAt(spec, point).polygon.corners, point, pixelsPerMetre);
}

glm::dvec2 snapped(const glm::dvec2& point, const SnapTargets& targets, double pixelsPerMetre) {
  if (const auto corner = nearestCorner(targets.corners, point, pixelsPerMetre)) return *corner;
  return targets.gridMetres > 0 ? glm::round(point / targets.gridMetres) * targets.gridMetres : point;
}

double snappedAngle(double angleRadians, const SnapTargets& targets) {
  constexpr double kStepDegrees = 15, kWallReachDegrees = 4;
  const auto nearest = [&](double from, double step) {
    return from + std::round((angleRadians - from) / step) * step;
  };
  if (targets.wallRadians)
    if (const double wall = nearest(*targets.wallRadians, kPi / 2);
        std::abs(wall - angleRadians) <= radians(kWallReachDegrees))
      return wall;
  return nearest(0, radians(kStepDegrees));
}

}  // namespace acentric::editor
