#pragma once
/// Where a patch lies, to know which of two may hide the other from an eye that the capture serves.

#include <array>
#include <climits>
#include <cmath>

#include "engine/image/capture.h"

namespace acentric {

struct PatchExtent {
  /// Planes that may separate patches have normals in the upright plane through the middle of the strip: so
  /// many, all around.
  static constexpr std::size_t kAxes = 8;

  SurfacePlane plane;
  std::array<glm::vec3, 8> corners{};       ///< of an octagon around it, relative to P
  std::array<float, 8> perSlack{};          ///< one over by how much each may be off a plane unnoticed
  float nearest = 0, farthest = HUGE_VALF;  ///< largest and smallest inverse distance
  std::array<float, kAxes> low{}, high{};   ///< along each axis, less the slack
  std::array<float, kAxes> lowWithEyes{}, highWithEyes{};  ///< and with all eyes
};

/// The octagon around what samples cover, in parts of pixels.
class PatchOutline {
 public:
  PatchOutline() { most_.fill(INT_MIN); }
  void add(int column, int row, std::uint16_t coverage);
  const std::array<glm::ivec2, 8>& corners() const { return corners_; }

 private:
  std::array<glm::ivec2, 8> corners_{};
  std::array<int, 8> most_{};
};

/// Of one strip of columns.
class PatchExtents {
 public:
  /// `tolerance` of the capture's planes, 1/m: a quarter of a sample for its farthest eye.
  PatchExtents(const ColumnCamera& camera, double tolerance, int firstColumn, int endColumn);
  /// `nearest`, `farthest`: of its samples.
  PatchExtent of(const SurfacePlane& plane, const PatchOutline& outline, float nearest, float farthest) const;

 private:
  void project(PatchExtent& extent) const;

  const ColumnCamera& camera_;
  float tolerance_;
  glm::vec2 ahead_;                                 ///< direction of the strip's middle
  float reach_;                                     ///< of the eyes, m
  std::array<glm::vec2, PatchExtent::kAxes> axes_;  ///< along that, and up
};

/// Of two patches: may the first hide some of the second, and the other way round? Only if some of it lies on
/// the eyes' side of the other's plane and some of the other beyond its own, and no plane separates it from
/// all eyes and the other together.
struct Hiding {
  bool first = false, second = false;
};
Hiding hidingOf(const PatchExtent& first, const PatchExtent& second);

}  // namespace acentric
