#pragma once
/// Planes of captures as whole numbers, no finer than their samples need.
///
/// A plane is told where the first sample on it lies: by the inverse distance at which that pixel's ray meets
/// it, and by how this changes with the column's direction and with the row's tangent. The nearer all its
/// samples are to the first one, the coarser these two may be: most planes of small triangles have samples in
/// one or two pixels.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

/// How many binary digits the two changes leave out, 0 to kMostLeftOut.
struct PlaneScale {
  int across = 0, down = 0;
};
inline constexpr int kMostLeftOut = 15;

/// The first sample on a plane, in capture order, and how far the others are from it.
struct PlaneReach {
  int column = -1, row = -1;  ///< of the first; -1 where no sample is on the plane
  int lastColumn = 0, topRow = 0, bottomRow = 0;

  /// With it the plane's inverse distances on all its samples are as good as at the first one.
  PlaneScale scale(const ColumnCamera& camera) const;
};
/// Of each plane.
std::vector<PlaneReach> planeReaches(const CaptureSamples& samples);

struct PlaneNumbers {
  std::int64_t inverseDistance = 0, across = 0, down = 0;
};

/// The ray of one pixel, and a step of inverse distances, 1/m.
class PlaneFrame {
 public:
  PlaneFrame(const glm::dvec2& direction, double tangent, double step)
      : direction_(direction), tangent_(tangent), step_(step) {}

  /// Rounded. None if they are too large, or the plane so far away or so steep that its ray's would be 0.
  std::optional<PlaneNumbers> numbersOf(const SurfacePlane& plane, const PlaneScale& scale) const;
  /// Its `away` is 0.
  SurfacePlane planeAt(const PlaneNumbers& numbers, const PlaneScale& scale) const;
  /// The numbers from which planeAt makes this very plane; none if there are none.
  std::optional<PlaneNumbers> exactNumbersOf(const SurfacePlane& plane, const PlaneScale& scale) const;

 private:
  glm::dvec2 direction_;
  double tangent_, step_;
};

/// The step of planes' numbers in captures whose distances are so far apart.
inline double planeStep(double distanceStep) { return distanceStep / 4; }

/// Each plane as its numbers tell it, one that they cannot tell as it is, and samples where these have them
/// (placeOnPlanes).
void roundPlanes(CaptureSamples& samples, const ColumnCamera& camera, double distanceStep);

/// Puts each sample where its pixel's ray meets its plane if that is within two steps of stored distances, so
/// that the plane alone tells where it is. Samples of a pixel stay in order.
void placeOnPlanes(CaptureSamples& samples, const ColumnCamera& camera, double distanceStep);

}  // namespace acentric
