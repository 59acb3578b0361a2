#pragma once
/// What the test eyes of the served regions see by way of plane mirrors. An eye sees a virtual place where
/// the way to it meets the mirror, the eye sees the mirror there, and its original is seen from there.

#include <optional>
#include <vector>

#include "engine/bake/region_sight.h"
#include "engine/scene/flat_mirrors.h"

namespace acentric {

class MirrorSight {
 public:
  /// Scene and sight must outlive it.
  MirrorSight(const RayScene& scene, const FlatMirrors& mirrors, const RegionSight& sight);

  /// Is there a mirror that an eye stands before?
  bool any() const { return !faced_.empty(); }
  /// All of them.
  std::vector<const FlatMirror*> mirrors() const {
    std::vector<const FlatMirror*> all;
    for (const Faced& faced : faced_) all.push_back(&faced.mirror);
    return all;
  }

  /// Where along a ray virtual places may be seen in a mirror, metres.
  struct Span {
    const FlatMirror* mirror = nullptr;
    double from = 0, to = 0;
  };
  void spansAlong(const glm::dvec3& origin, const glm::dvec3& direction, std::vector<Span>& spans) const;

  using Hints = RegionSight::Hints;
  Hints hints() const { return sight_->hints(); }

  /// Where an eye meets the mirror, and the side that it sees of what is shown there.
  struct Seen {
    Hit mirror;
    glm::vec3 toEye{0};  ///< unit
    Side side = Side::met;
  };
  /// Which side of a surface before the mirror the region of role `role` sees in it, give or take `tolerance`
  /// metres of depth.
  std::optional<Seen> sees(std::size_t role, const FlatMirror& mirror, const MetSurface& surface,
                           double tolerance, Hints& hints, RayCounts& rays) const;
  /// The same for what lies infinitely far in a virtual direction (unit).
  std::optional<Seen> seesAlong(std::size_t role, const FlatMirror& mirror, const glm::dvec3& direction,
                                Hints& hints, RayCounts& rays) const;
  /// Is one of the region's eyes on a side of the surface, as the mirror shows it, whether or not it sees it?
  bool isOn(Side side, std::size_t role, const FlatMirror& mirror, const MetSurface& surface) const;

 private:
  struct EyeBefore {
    glm::dvec2 foot{0};  ///< in the plane
    double height = 0;
  };
  struct Faced {
    FlatMirror mirror;
    std::vector<EyeBefore> eyes;
    glm::dvec2 lowFoot{0}, highFoot{0};
    double lowest = 0, highest = 0;
  };
  std::optional<Seen> meets(const EyeView& view, const FlatMirror& mirror, const glm::dvec3& at,
                            const Ray& onwards, RayCounts& rays) const;

  const RayScene* scene_;
  const FlatMirrors* mirrors_;
  const RegionSight* sight_;
  std::vector<Faced> faced_;
};

}  // namespace acentric
