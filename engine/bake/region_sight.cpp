#include "engine/bake/region_sight.h"

namespace acentric {

std::optional<RegionSight> RegionSight::look(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                                             const BakeSettings& settings, EyeViews& views,
                                             TaskRunner& runner, RayCounts& rays,
                                             const std::stop_token& stop) {
  RegionSight sight;
  sight.scene_ = &scene;
  const Role* former = nullptr;
  for (const Role& role : camera.roles) {
    if (former == nullptr || former->region != role.region) {
      sight.eyes_.emplace_back();
      for (const glm::dvec3& eye : testEyes(role.polygon, eyeZ, settings)) {
        auto view = views.at(eye, runner, rays, stop);
        if (!view) return std::nullopt;
        sight.eyes_.back().push_back(std::move(view));
      }
    }
    sight.region_.push_back(sight.eyes_.size() - 1);
    former = &role;
  }
  return sight;
}

std::vector<glm::dvec3> RegionSight::eyes() const {
  std::vector<glm::dvec3> eyes;
  for (const auto& region : eyes_)
    for (const auto& view : region) eyes.push_back(view->eye());
  return eyes;
}

Side RegionSight::sees(std::size_t role, const MetSurface& surface, double tolerance, Hints& hints,
                       RayCounts& rays) const {
  return sideSeen(
      role, surface, hints, [](const EyeView& view) -> const glm::dvec3& { return view.eye(); },
      [&](const EyeView& view) { return seesPoint(*scene_, view, surface.point(), tolerance, rays); });
}

bool RegionSight::seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints,
                            RayCounts& rays) const {
  return any(role, hints,
             [&](const EyeView& view) { return acentric::seesAlong(*scene_, view, direction, rays); });
}

}  // namespace acentric
