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

RegionSight::Side RegionSight::sees(std::size_t role, const glm::dvec3& point, const glm::dvec3& normal,
                                    double tolerance, Hints& hints, RayCounts& rays) const {
  const auto seenFrom = [&](Side side) {
    return any(role, hints, [&](const EyeView& view) {
      const bool onNormal = glm::dot(normal, view.eye() - point) >= 0;
      return onNormal == (side == Side::normal) && seesPoint(*scene_, view, point, tolerance, rays);
    });
  };
  if (seenFrom(Side::normal)) return Side::normal;
  return seenFrom(Side::other) ? Side::other : Side::none;
}

bool RegionSight::seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints,
                            RayCounts& rays) const {
  return any(role, hints,
             [&](const EyeView& view) { return acentric::seesAlong(*scene_, view, direction, rays); });
}

}  // namespace acentric
