#pragma once
/// Instances that stand where people walk. What a region draws itself (its grown polygon) has light and local
/// geometry triangle by triangle, which meshes alone have: so instances that reach into a region's polygon
/// are placed as meshes when a project is opened. All others stay instances, met by rays.

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Triangles that are placed for all regions of a project together, at most: with their light and rays they
/// take some hundred bytes each.
inline constexpr std::uint64_t kMostNearTriangles = 10'000'000;

struct NearInstances {
  std::vector<std::uint32_t> instances;  ///< ascending numbers of Scene::instances
  std::uint64_t triangles = 0;           ///< of them all

  bool tooMany(std::uint64_t most = kMostNearTriangles) const { return triangles > most; }
  /// Of which instances; zero where there are none.
  ContentKey key() const;
  bool operator==(const NearInstances&) const = default;
};

/// Those whose boxes reach into a grown polygon of some layout.
NearInstances findNearInstances(const Scene& scene, std::span<const Layout> layouts);

/// A failure that says what can be done, where there are too many.
Status checkNear(const NearInstances& near);

}  // namespace acentric
