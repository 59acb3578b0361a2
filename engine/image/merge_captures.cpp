#include "engine/image/merge_captures.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Does the capture hold a sample where the point is?
bool shows(const Capture& capture, const glm::dvec3& point, double share) {
  const ColumnCamera& camera = capture.camera;
  const glm::dvec3 from = point - camera.centreOfProjection;
  const double distance = std::hypot(from.x, from.y);
  if (!(distance > 0)) return false;
  const double turn = wrapAngle(std::atan2(from.y, from.x) - camera.lowAzimuth);
  const int column = int(turn / camera.columnPitch());
  const double drop = (camera.topElevation - std::atan2(from.z, distance)) / camera.rowPitch();
  if (turn >= camera.fovRadians || column >= camera.columns || drop < 0 || drop >= camera.rows) return false;
  const auto begin = capture.row.begin() + capture.columnStart[std::size_t(column)],
             end = capture.row.begin() + capture.columnStart[std::size_t(column) + 1];
  const auto row = std::uint16_t(drop);
  for (auto at = std::lower_bound(begin, end, row); at != end && *at == row; ++at) {
    const double inverse = capture.inverseDistance[std::size_t(at - capture.row.begin())];
    if (std::abs(inverse * distance - 1) <= share) return true;
  }
  return false;
}

}  // namespace

std::size_t dropShown(Capture& capture, std::span<const Capture* const> earlier,
                      const MergeTolerance& tolerance) {
  const ColumnCamera& camera = capture.camera;
  std::size_t kept = 0;
  const bool mirrors = !capture.mirror.empty(), silhouettes = capture.hasSilhouettes();
  const std::size_t all = capture.sampleCount();
  for (std::size_t k = 0; k < std::size_t(camera.columns); ++k) {
    const glm::dvec2 direction = camera.directionAt(double(k) + 0.5);
    const std::size_t first = capture.columnStart[k], end = capture.columnStart[k + 1];
    capture.columnStart[k] = std::uint32_t(kept);
    for (std::size_t n = first; n < end; ++n) {
      const glm::dvec3 way(direction, camera.tangentAt(capture.row[n] + 0.5));
      const glm::dvec3 point = camera.centreOfProjection + way / double(capture.inverseDistance[n]);
      if (std::ranges::any_of(earlier,
                              [&](const Capture* other) { return shows(*other, point, tolerance.share); }))
        continue;
      capture.row[kept] = capture.row[n];
      capture.inverseDistance[kept] = capture.inverseDistance[n];
      capture.colour[kept] = capture.colour[n];
      capture.roles[kept] = capture.roles[n];
      if (mirrors) capture.mirror[kept] = capture.mirror[n];
      if (silhouettes) capture.coverage[kept] = capture.coverage[n], capture.plane[kept] = capture.plane[n];
      ++kept;
    }
    // The start of the next column is read before it is written over.
  }
  capture.columnStart.back() = std::uint32_t(kept);
  capture.row.resize(kept), capture.inverseDistance.resize(kept), capture.colour.resize(kept),
      capture.roles.resize(kept);
  if (mirrors) capture.mirror.resize(kept);
  if (silhouettes) capture.coverage.resize(kept), capture.plane.resize(kept);
  if (kept == 0) capture.planes.clear();
  if (!capture.hasSilhouettes() && !capture.reflections.hasSilhouettes()) capture.planeTolerance = 0;
  return all - kept;
}

}  // namespace acentric
