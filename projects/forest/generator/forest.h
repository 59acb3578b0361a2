#pragma once
/// A small town in a forest, for scenes of very many triangles: a cobbled street between half-timbered houses
/// and gardens, and woods of some ten species around. What stands in many places is instanced.

#include <cstdint>

#include "projects/gallery/generator/model.h"

namespace acentric::forest {

inline constexpr std::uint64_t kFewestTriangles = 100'000, kMostTriangles = 4'000'000'000;

struct ForestOptions {
  std::uint64_t triangles = 500'000'000;  ///< of all places together, about
  std::uint64_t seed = 1;
  float pictureScale = 1;  ///< below 1: coarser pictures, made faster
};

/// The street leads along y through the origin, straight there for 20 m either way, 6 m wide, at z = 0. It
/// and the houses are the same whatever the number; plants grow in number and in detail alike, by its square
/// root, those near the street first. Within 5 % of the triangles asked for.
gallery::Model makeForest(const ForestOptions& options);

/// Metres of the street's middle from x = 0, there.
float streetAt(float y);

}  // namespace acentric::forest
