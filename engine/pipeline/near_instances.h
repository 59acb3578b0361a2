#pragma once
/// Instances that stand where people walk. What a region draws itself (its grown polygon) has light and local
/// geometry triangle by triangle: when a project is opened, those triangles of instances that reach into a
/// region's polygon become meshes that are drawn (scene/drawn_scene.h). For rays the instances stay. Mirrors
/// and lamps are such as meshes alone: of these, instances that are near are placed as a whole, for rays too.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/layout/layout.h"
#include "engine/scene/drawn_scene.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Triangles of instances that all regions of a project draw together, at most: they take some 30 bytes each,
/// and one or two hundred more while their light is baked.
inline constexpr std::uint64_t kMostNearTriangles = 120'000'000;

struct NearInstances {
  std::vector<std::uint32_t> whole;  ///< ascending numbers of Scene::instances: mirrors and lamps
  /// Of the others those triangles that some region draws. Null: none, or too many.
  std::shared_ptr<const InstanceExcerpts> excerpts;
  std::uint64_t instances = 0;  ///< how many there are, of both
  std::uint64_t triangles = 0;  ///< that are drawn; of whole ones all
  ContentKey key;               ///< of which instances and triangles; zero where there are none

  bool any() const { return instances > 0; }
  bool tooMany(std::uint64_t most = kMostNearTriangles) const { return triangles > most; }
  bool operator==(const NearInstances& other) const { return key == other.key; }
};

/// Those that reach into a grown polygon of some layout. Of more than `most` triangles it only tells how
/// many.
NearInstances findNearInstances(const Scene& scene, std::span<const Layout> layouts,
                                std::uint64_t most = kMostNearTriangles);

/// A failure that says what can be done, where there are too many.
Status checkNear(const NearInstances& near);

}  // namespace acentric
