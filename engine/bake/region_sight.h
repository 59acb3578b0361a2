#pragma once
/// Which roles of a camera see a point, from any of the test eyes of their regions (apv.md section 5).

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bake/eye_views.h"
#include "engine/layout/layout.h"

namespace acentric {

class RegionSight {
 public:
  /// Nothing when stopped.
  static std::optional<RegionSight> look(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                                         const BakeSettings& settings, EyeViews& views, TaskRunner& runner,
                                         RayCounts& rays, const std::stop_token& stop);

  /// Of one thread: which eye answered last, tried first the next time.
  struct Hints {
    std::vector<std::size_t> eye;  ///< by region
  };
  Hints hints() const { return {std::vector<std::size_t>(eyes_.size(), 0)}; }

  /// Which side of a surface the region of role `role` sees at a point, give or take `tolerance` metres of
  /// depth: the one that `normal` is on if any of its eyes does, else the other.
  enum class Side : std::uint8_t { none, normal, other };
  Side sees(std::size_t role, const glm::dvec3& point, const glm::dvec3& normal, double tolerance,
            Hints& hints, RayCounts& rays) const;
  /// The same for what lies infinitely far in a direction (unit).
  bool seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints, RayCounts& rays) const;

  /// Does a test hold for one of the eyes of a role's region?
  template <class Test>
  bool any(std::size_t role, Hints& hints, const Test& test) const {
    const std::size_t region = region_[role];
    const auto& eyes = eyes_[region];
    std::size_t& hint = hints.eye[region];
    if (hint < eyes.size() && test(*eyes[hint])) return true;
    for (std::size_t e = 0; e < eyes.size(); ++e)
      if (e != hint && test(*eyes[e])) {
        hint = e;
        return true;
      }
    return false;
  }
  /// Of all regions.
  std::vector<glm::dvec3> eyes() const;

 private:
  const RayScene* scene_ = nullptr;
  std::vector<std::size_t> region_;  ///< of each role, into eyes_
  std::vector<std::vector<std::shared_ptr<const EyeView>>> eyes_;
};

}  // namespace acentric
