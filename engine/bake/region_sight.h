#pragma once
/// Which roles of a camera see a point, from any of the test eyes of their regions (apv.md section 5).

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bake/eye_group.h"
#include "engine/bake/eye_views.h"
#include "engine/bake/region_sky.h"
#include "engine/bake/surface_side.h"
#include "engine/bake/test_eyes.h"
#include "engine/layout/layout.h"

namespace acentric {

/// Of a sample's footprint: what lies nearer behind it than this is still the same surface.
inline constexpr double kSameDepth = 0.5;

class RegionSight {
 public:
  /// Chooses the test eyes of the camera's regions, so that `look` finds them chosen. False when stopped.
  static bool findEyes(const LayoutCamera& camera, double eyeZ, TestEyes& testEyes, TaskRunner& runner,
                       RayCounts& rays, const std::stop_token& stop);
  /// Nothing when stopped.
  static std::optional<RegionSight> look(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                                         TestEyes& testEyes, EyeViews& views, RegionSkies& skies,
                                         TaskRunner& runner, RayCounts& rays, const std::stop_token& stop);

  /// The same answers without maps, by rays alone; the sky is seen nowhere.
  static RegionSight untraced(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                              TestEyes& testEyes);

  /// With more eyes, without maps: `count` placed evenly in each region. `camera` and `eyeZ` as before.
  RegionSight withEyes(int count, const LayoutCamera& camera, double eyeZ, BakeSettings settings) const;

  /// Of one thread: which eye answered last, tried first the next time.
  struct Hints {
    std::vector<std::size_t> eye;      ///< by region
    std::vector<std::uint8_t> hidden;  ///< EyeGroup::findHidden, of the last point asked about
  };
  Hints hints() const { return {std::vector<std::size_t>(groups_.size(), 0), {}}; }

  /// Which side of a surface the region of role `role` sees, give or take `tolerance` metres of depth;
  /// `byRays`: maps, which take what lies right behind a surface for the surface itself, may only deny it.
  Side sees(std::size_t role, const MetSurface& surface, double tolerance, Hints& hints, RayCounts& rays,
            bool byRays = false) const;
  /// The same for what lies infinitely far in a direction (unit).
  bool seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints, RayCounts& rays) const;

  /// Does a test(view, number of the eye) hold for one of the eyes of a role's region?
  template <class Test>
  bool any(std::size_t role, Hints& hints, const Test& test) const {
    const std::size_t region = region_[role];
    const auto& eyes = groups_[region].eyes();
    std::size_t& hint = hints.eye[region];
    if (hint < eyes.size() && test(*eyes[hint], hint)) return true;
    for (std::size_t e = 0; e < eyes.size(); ++e)
      if (e != hint && test(*eyes[e], e)) {
        hint = e;
        return true;
      }
    return false;
  }
  /// The side of a surface that the eyes of a role's region see: the one that the ray meets if any of them
  /// does, else the other. `from(view)`: where an eye sees it from; `sees(view, closely)`: does it see it
  /// from there, and if asked to look closely not just what lies right before it? Else eyes would see the
  /// inner side of a body's thin parts, which is dark, through the outer one. `isHidden(eye)`: is it known
  /// not to see the surface at all?
  template <class From, class Sees, class Hidden>
  Side sideSeen(std::size_t role, const MetSurface& surface, Hints& hints, const From& from, const Sees& sees,
                const Hidden& isHidden) const {
    for (const Side side : {Side::met, Side::other})
      if (any(role, hints, [&](const EyeView& view, std::size_t eye) {
            const bool closely = side == Side::met && surface.fromWithin();
            return !isHidden(eye) && surface.sideOf(from(view)) == side && sees(view, closely);
          }))
        return side;
    return Side::none;
  }
  /// Is one of the eyes of a role's region on a side of a surface, whether or not it sees it?
  template <class From>
  bool isOn(Side side, std::size_t role, const MetSurface& surface, const From& from) const {
    return std::ranges::any_of(groups_[region_[role]].eyes(),
                               [&](const auto& view) { return surface.sideOf(from(*view)) == side; });
  }
  /// Of all regions.
  std::vector<glm::dvec3> eyes() const;

 private:
  const RayScene* scene_ = nullptr;
  std::vector<std::size_t> region_;                      ///< of each role, into groups_
  std::vector<EyeGroup> groups_;                         ///< by region
  std::vector<std::shared_ptr<const RegionSky>> skies_;  ///< by region
};

}  // namespace acentric
