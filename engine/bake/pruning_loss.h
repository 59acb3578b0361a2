#pragma once
/// What pruning loses: surfaces that an eye of a region sees and none of its test eyes does.

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/bake/surface_side.h"
#include "engine/base/task_runner.h"
#include "engine/geometry/convex_polygon.h"

namespace acentric {

/// Looks of eyes chosen at random, one direction each, and how many of them lose what they see.
struct PruningLoss {
  std::uint64_t looks = 0, lost = 0;

  double share() const { return looks > 0 ? double(lost) / double(looks) : 0; }
  /// With 95 % confidence the share of all looks is no larger: the exact one-sided limit of Clopper and
  /// Pearson (1934). 1 where nobody looked.
  double atMost() const;
  PruningLoss& operator+=(const PruningLoss& other);
  bool operator==(const PruningLoss&) const = default;
};

/// Random looks from a region. Eyes are uniform in it and within the settings' eye range of `eyeZ`;
/// directions are uniform all round, within 45 degrees of level. A look loses the nearest opaque surface
/// where a bake keeps it only if a test eye sees it, and none does, by the bake's tolerance and by rays
/// alone. Looks into the background, and at what lies within the region's near band (`grown`), which is drawn
/// as polygons, lose nothing.
class RandomLooks {
 public:
  RandomLooks(const RayScene& scene, const ConvexPolygon& polygon, const ConvexPolygon& grown, double eyeZ,
              const BakeSettings& settings);

  /// A surface that one eye sees.
  struct Lost {
    glm::dvec3 eye;
    MetSurface surface;
    double tolerance = 0;  ///< metres
  };
  /// What so many looks lose, of test eyes at those places. The same seed makes the same looks whatever the
  /// eyes and the threads are; all that is lost goes into `lost`, in order of looks. Meaningless when
  /// stopped.
  PruningLoss loss(std::span<const glm::dvec3> testEyes, std::size_t looks, std::uint64_t seed,
                   TaskRunner& runner, RayCounts& rays, std::vector<Lost>* lost = nullptr,
                   const std::stop_token& stop = {}) const;
  /// Does an eye there see it too?
  bool sees(const glm::dvec3& eye, const Lost& what, RayCounts& rays) const;

 private:
  struct Batch;
  void look(std::span<const glm::dvec3> testEyes, std::size_t looks, std::uint64_t seed, Batch& batch) const;

  const RayScene& scene_;
  const ConvexPolygon& polygon_;
  const ConvexPolygon& grown_;
  glm::dvec2 low_{0}, high_{0};  ///< of the polygon
  double eyeZ_, eyeRange_, nearer_;
};

}  // namespace acentric
