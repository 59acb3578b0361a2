#include "engine/image/plane_numbers.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

/// Larger numbers would have digits that the plane's floats have not.
constexpr double kMostNumber = 1 << 25;
constexpr double kStoredDigits = 0x1p-15;  ///< of an inverse distance, what stored ones are apart at most

/// Binary digits that a change by `by` needs no more.
int leftOut(double by) {
  return by > 0 ? std::clamp(-int(std::ceil(std::log2(by))), 0, kMostLeftOut) : kMostLeftOut;
}

}  // namespace

PlaneScale PlaneReach::scale(const ColumnCamera& camera) const {
  constexpr double kQuarter = 1.5;  // radians: from there on the sine falls
  const double turn = std::min((lastColumn - column + 1) * camera.columnPitch(), kQuarter);
  const double tangent = camera.tangentAt(row + 0.5);
  const double rise = std::max(camera.tangentAt(topRow - 0.5) - tangent,  // a row beyond either end
                               tangent - camera.tangentAt(bottomRow + 1.5));
  return {leftOut(std::sin(turn)), leftOut(rise + std::abs(tangent) * (1 - std::cos(turn)))};
}

std::vector<PlaneReach> planeReaches(const CaptureSamples& samples) {
  std::vector<PlaneReach> reaches(samples.planes.size());
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column)
    for (std::uint32_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i) {
      PlaneReach& reach = reaches[samples.plane[i]];
      const int row = samples.row[i];
      if (reach.column < 0) reach = {int(column), row, 0, row, row};
      reach.lastColumn = int(column);
      reach.topRow = std::min(reach.topRow, row), reach.bottomRow = std::max(reach.bottomRow, row);
    }
  return reaches;
}

std::optional<PlaneNumbers> PlaneFrame::numbersOf(const SurfacePlane& plane, const PlaneScale& scale) const {
  const glm::dvec3 normal(plane.normal);
  const double across = normal.y * direction_.x - normal.x * direction_.y;
  const glm::dvec3 exact(plane.inverseDistance(direction_, tangent_) / step_,
                         std::ldexp(across / step_, -scale.across),
                         std::ldexp(normal.z / step_, -scale.down));
  const glm::dvec3 size = glm::abs(exact);
  if (!(size.x >= 0.5 && size.x < kMostNumber && size.y < kMostNumber && size.z < kMostNumber)) return {};
  return PlaneNumbers{std::llround(exact.x), std::llround(exact.y), std::llround(exact.z)};
}

SurfacePlane PlaneFrame::planeAt(const PlaneNumbers& numbers, const PlaneScale& scale) const {
  const double across = std::ldexp(double(numbers.across) * step_, scale.across),
               down = std::ldexp(double(numbers.down) * step_, scale.down),
               ahead = double(numbers.inverseDistance) * step_ - tangent_ * down;
  return {glm::vec3(direction_.x * ahead - direction_.y * across + 0.0,  // no -0
                    direction_.y * ahead + direction_.x * across + 0.0, down + 0.0)};
}

std::optional<PlaneNumbers> PlaneFrame::exactNumbersOf(const SurfacePlane& plane,
                                                       const PlaneScale& scale) const {
  const std::optional<PlaneNumbers> numbers = numbersOf(plane, scale);
  if (!numbers || planeAt(*numbers, scale).normal != plane.normal) return {};
  return numbers;
}

void roundPlanes(CaptureSamples& samples, const ColumnCamera& camera, double distanceStep) {
  if (!(distanceStep > 0)) return;
  const std::vector<PlaneReach> reaches = planeReaches(samples);
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    const PlaneReach& reach = reaches[k];
    if (reach.column < 0) continue;
    const PlaneFrame frame(camera.directionAt(reach.column + 0.5), camera.tangentAt(reach.row + 0.5),
                           planeStep(distanceStep));
    const PlaneScale scale = reach.scale(camera);
    SurfacePlane& plane = samples.planes[k];
    const std::optional<PlaneNumbers> numbers = frame.numbersOf(plane, scale);
    if (!numbers) continue;
    const SurfacePlane rounded = frame.planeAt(*numbers, scale);
    if (frame.exactNumbersOf(rounded, scale)) plane.normal = rounded.normal;
  }
  placeOnPlanes(samples, camera, distanceStep);
}

void placeOnPlanes(CaptureSamples& samples, const ColumnCamera& camera, double distanceStep) {
  if (!samples.hasSilhouettes()) return;
  std::vector<double> tangent;
  for (int row = 0; row < camera.rows; ++row) tangent.push_back(camera.tangentAt(row + 0.5));
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column) {
    const glm::dvec2 direction = camera.directionAt(double(column) + 0.5);
    const std::uint32_t first = samples.columnStart[column];
    for (std::uint32_t i = first; i < samples.columnStart[column + 1]; ++i) {
      float& w = samples.inverseDistance[i];
      const double met = samples.planes[samples.plane[i]].inverseDistance(direction, tangent[samples.row[i]]);
      const double apart = std::max(distanceStep, double(w) * kStoredDigits);
      if (w > 0 && met > 0 && std::abs(met - double(w)) < 2 * apart)
        w = storedInverseDistance(met, distanceStep);
      if (i > first && samples.row[i] == samples.row[i - 1]) w = std::min(w, samples.inverseDistance[i - 1]);
    }
  }
}

}  // namespace acentric
