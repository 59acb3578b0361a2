#pragma once
/// In which directions some eye of a region sees the background.
///
/// Seen through a window the background fills other directions from each place, and those between the test
/// eyes see it where none of these does. So from what the test eyes see the search goes on, direction by
/// neighbouring direction, as long as one of many more eyes sees the background there: while an eye moves,
/// its view through an opening moves on without a gap.

#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/bake/cube_lattice.h"
#include "engine/bake/eye_views.h"
#include "engine/geometry/convex_polygon.h"

namespace acentric {

/// Of a region, that are asked for the sky.
inline constexpr int kSkyEyes = kMostTestEyes;

class RegionSky {
 public:
  /// `views`: of the region's test eyes, one at least, all of one lattice and of the same elevations; `eyes`:
  /// many more. Null when stopped.
  static std::shared_ptr<const RegionSky> trace(const RayScene& scene,
                                                std::span<const std::shared_ptr<const EyeView>> views,
                                                const std::vector<glm::dvec3>& eyes, TaskRunner& runner,
                                                RayCounts& rays, const std::stop_token& stop);

  /// Does an eye see it in a direction? Along the edges yes: a pixel of background costs nothing. Unsure in
  /// directions that were not looked at.
  EyeView::Sees looksAlong(const glm::dvec3& direction) const;
  std::size_t bytes() const { return seen_.size(); }

 private:
  explicit RegionSky(const CubeLattice& lattice)
      : lattice_(lattice), seen_(lattice.size(), EyeView::Sees::no) {}

  CubeLattice lattice_;
  std::vector<EyeView::Sees> seen_;  ///< by corner
};

/// Those of the regions asked for last. Not safe from several threads.
class RegionSkies {
 public:
  RegionSkies(const RayScene& scene, const BakeSettings& settings, MemoryBudget& budget)
      : scene_(scene), settings_(settings), budget_(budget) {}

  /// `views`: of the test eyes of a region, one at least. Null when stopped.
  std::shared_ptr<const RegionSky> at(const ConvexPolygon& region, double eyeZ,
                                      std::span<const std::shared_ptr<const EyeView>> views,
                                      TaskRunner& runner, RayCounts& rays, const std::stop_token& stop);

 private:
  struct Kept {
    std::vector<glm::dvec3> eyes;
    std::shared_ptr<const RegionSky> sky;
    MemoryBudget::Share share;
  };

  const RayScene& scene_;
  BakeSettings settings_;
  MemoryBudget& budget_;
  std::vector<Kept> kept_;  ///< the last asked for at the end
};

}  // namespace acentric
