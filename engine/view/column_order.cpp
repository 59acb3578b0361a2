#include "engine/view/column_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Column position of an azimuth in [0, columns], or -1 outside the sector.
double columnPosition(const ColumnCamera& camera, double azimuth) {
  const double offset = wrapAngle(azimuth - camera.lowAzimuth);
  return offset <= camera.fovRadians ? offset / camera.columnPitch() : -1;
}

int columnAt(const ColumnCamera& camera, double position) {
  return std::clamp(static_cast<int>(position), 0, camera.columns - 1);
}

void addRun(std::vector<ColumnRun>& runs, int first, int last, bool ascending) {
  if (first < last) runs.push_back({first, last, ascending});
}

}  // namespace

ColumnOrder columnOrder(const ColumnCamera& camera, const glm::dvec2& eyeFromCentre) {
  ColumnOrder order;
  if (eyeFromCentre == glm::dvec2(0)) {
    addRun(order.runs, 0, camera.columns, true);
    return order;
  }
  const double epipole = std::atan2(eyeFromCentre.y, eyeFromCentre.x);
  if (const double x = columnPosition(camera, epipole); x >= 0) {
    const int k = columnAt(camera, x);
    order.epipoleColumn = k;
    addRun(order.runs, 0, k, true);
    addRun(order.runs, k + 1, camera.columns, false);
    addRun(order.runs, k, k + 1, true);
  } else if (const double y = columnPosition(camera, epipole + kPi); y >= 0) {
    const int k = columnAt(camera, y);
    order.antipodeColumn = k;
    addRun(order.runs, k, k + 1, true);
    addRun(order.runs, k + 1, camera.columns, true);
    addRun(order.runs, 0, k, false);
  } else {
    const auto away = [&](double position) {
      return std::abs(std::remainder(camera.azimuthAt(position) - epipole, kTwoPi));
    };
    addRun(order.runs, 0, camera.columns, away(0.5) >= away(camera.columns - 0.5));
  }
  return order;
}

std::vector<ColumnRun> keepColumns(const std::vector<ColumnRun>& runs, const std::vector<char>& keep) {
  std::vector<ColumnRun> kept;
  for (const ColumnRun& run : runs) {
    const std::size_t start = kept.size();
    for (int k = run.first; k < run.last;) {
      if (!keep[static_cast<std::size_t>(k)]) {
        ++k;
        continue;
      }
      const int first = k;
      while (k < run.last && keep[static_cast<std::size_t>(k)]) ++k;
      kept.push_back({first, k, run.ascending});
    }
    if (!run.ascending) std::reverse(kept.begin() + static_cast<std::ptrdiff_t>(start), kept.end());
  }
  return kept;
}

RowOrder rowOrder(const glm::dvec2& columnDirection, const glm::dvec3& eyeFromCentre) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double along = glm::dot(columnDirection, glm::dvec2(eyeFromCentre));
  RowOrder order;
  order.inwards = along > 0;
  order.footInverse = static_cast<float>(along > 0 ? 1 / along : kInfinity);
  // Rising rows everywhere (e.z > 0) is "towards a pivot above all rows", or "away from one below all rows".
  if (along != 0)
    order.pivotTangent = static_cast<float>(eyeFromCentre.z / along);
  else
    order.pivotTangent = static_cast<float>(eyeFromCentre.z > 0 ? -kInfinity : kInfinity);
  return order;
}

}  // namespace acentric
