#pragma once
/// The roles of a camera along one of its columns: which it has samples for, from where on.

#include <cstdint>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

/// Surfaces met along one ray at most; a guard, not a quality setting.
inline constexpr int kMaxMarch = 4096;
/// A surface on a region's border itself lies beyond it, whichever way the distance was rounded.
inline constexpr double kBorderSlack = 1e-6;

/// A role as one column of the camera meets it.
struct ColumnRole {
  double exit = 0;  ///< horizontal metres: where the column's rays leave the grown polygon
  std::size_t index = 0;
  std::uint8_t bit = 0;
  const Clip* clip = nullptr;
  bool holdsBackground = true;  ///< the part holds what is infinitely far along the column
};

/// By rising exit.
std::vector<ColumnRole> rolesAlong(const LayoutCamera& camera, const glm::dvec2& direction);

}  // namespace acentric
