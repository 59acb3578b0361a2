#include "engine/image/merge_captures.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/image/keep_samples.h"

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
  const std::size_t all = capture.sampleCount();
  keepSamples(capture, [&](std::size_t column, std::size_t n) {
    const glm::dvec3 way(camera.directionAt(double(column) + 0.5), camera.tangentAt(capture.row[n] + 0.5));
    const glm::dvec3 point = camera.centreOfProjection + way / double(capture.inverseDistance[n]);
    return std::ranges::none_of(earlier,
                                [&](const Capture* other) { return shows(*other, point, tolerance.share); });
  });
  if (!capture.hasSilhouettes() && !capture.reflections.hasSilhouettes()) capture.planeTolerance = 0;
  return all - capture.sampleCount();
}

}  // namespace acentric
