#include "engine/bake/column_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {

RowAngles::RowAngles(const ColumnCamera& columns) {
  for (int row = 0; row < columns.rows; ++row) {
    cosine.push_back(std::cos(columns.elevationAt(row + 0.5)));
    sine.push_back(std::sin(columns.elevationAt(row + 0.5)));
  }
}

RayPacket firstRays(const ColumnCamera& columns, const RowAngles& rows, const glm::dvec2& columnDirection,
                    int first, int last, double nearest) {
  RayPacket packet;
  packet.origin = glm::vec3(columns.centreOfProjection);
  packet.count = last - first;
  for (int row = first; row < last; ++row) {
    const auto n = std::size_t(row - first), r = std::size_t(row);
    const double flat = rows.cosine[r];
    packet.direction[n] = glm::vec3(columnDirection.x * flat, columnDirection.y * flat, rows.sine[r]);
    packet.nearest[n] = float(nearest / flat);
  }
  return packet;
}

double firstExit(const LayoutCamera& camera, const glm::dvec2& columnDirection) {
  if (camera.roles.empty()) return nearestSample(camera);
  double exit = std::numeric_limits<double>::infinity();
  for (const Role& role : camera.roles) exit = std::min(exit, exitDistance(camera, role, columnDirection));
  return exit;
}

}  // namespace acentric
