#pragma once
/// The roles of a camera along one of its columns: which it has samples for, from where on.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bake/surface_side.h"
#include "engine/layout/layout.h"

namespace acentric {

/// Surfaces met along one ray at most; a guard, not a quality setting.
inline constexpr int kMaxMarch = 4096;
/// A surface on a region's border itself lies beyond it, whichever way the distance was rounded.
inline constexpr double kBorderSlack = 1e-6;

/// A role as one column of the camera meets it.
struct ColumnRole {
  double exit = 0;  ///< horizontal metres: where the column's rays leave the grown polygon
  /// From where on samples are asked for that may be the last before the border.
  double begin() const { return (1 - kBorderOverlap) * exit; }
  std::size_t index = 0;
  std::uint8_t bit = 0;
  const Clip* clip = nullptr;
  bool holdsBackground = true;  ///< the part holds what is infinitely far along the column
  bool holds(const glm::dvec2& place) const { return clip == nullptr || clip->holds(place); }
};

/// What a role has been given along one ray.
struct RoleOnRay {
  const ColumnRole* role = nullptr;
  int samples = 0;
  /// How far its last opaque surface is, as the march counts. What lies right behind it, as the backs of
  /// panels and mouldings, would pass for it before the test eyes, and show in its cracks.
  double opaqueAt = 0;
  Side opaqueSide = Side::none;  ///< its side that eyes see: the other one, as of a thin panel, is kept too
};
/// Counts a sample to each; returns their bits.
std::uint8_t give(std::span<RoleOnRay* const> roles);
/// Of the roles that need a clear surface those that have room for it: the last place is kept for an opaque
/// one, since there is always something behind glass.
void keepLastPlace(std::vector<RoleOnRay*>& needed, int maxLayers);

/// The roles that a surface is kept for, by the side that they see.
struct SeenSides {
  std::vector<RoleOnRay*> met, other;

  bool empty() const { return met.empty() && other.empty(); }
  void clear() { met.clear(), other.clear(); }
  std::vector<RoleOnRay*>& of(Side side) { return side == Side::met ? met : other; }
};

/// How far an eye of a served region is from the camera at most, metres.
double reachOf(const LayoutCamera& camera);

/// By rising exit.
std::vector<ColumnRole> rolesAlong(const LayoutCamera& camera, const glm::dvec2& direction);

}  // namespace acentric
