#include "engine/bake/region_sight.h"

namespace acentric {

std::optional<RegionSight> RegionSight::look(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                                             TestEyes& testEyes, EyeViews& views, RegionSkies& skies,
                                             TaskRunner& runner, RayCounts& rays,
                                             const std::stop_token& stop) {
  RegionSight sight;
  sight.scene_ = &scene;
  const Role* former = nullptr;
  for (const Role& role : camera.roles) {
    if (former == nullptr || former->region != role.region) {
      const auto region = testEyes.of(role.polygon, role.grown, eyeZ, runner, rays, stop);
      if (!region) return std::nullopt;
      sight.eyes_.emplace_back();
      for (const glm::dvec3& eye : region->eyes) {
        auto view = views.at(eye, runner, rays, stop);
        if (!view) return std::nullopt;
        sight.eyes_.back().push_back(std::move(view));
      }
      std::shared_ptr<const RegionSky> sky;  // of no eyes: none
      if (const auto& eyes = sight.eyes_.back(); !eyes.empty()) {
        sky = skies.at(role.polygon, eyeZ, eyes, runner, rays, stop);
        if (!sky) return std::nullopt;
      }
      sight.skies_.push_back(std::move(sky));
    }
    sight.region_.push_back(sight.eyes_.size() - 1);
    former = &role;
  }
  return sight;
}

RegionSight RegionSight::untraced(const RayScene& scene, const LayoutCamera& camera, double eyeZ,
                                  TestEyes& testEyes) {
  RegionSight sight;
  sight.scene_ = &scene;
  TaskRunner inline_;
  RayCounts rays;
  const Role* former = nullptr;
  for (const Role& role : camera.roles) {
    if (former == nullptr || former->region != role.region) {
      sight.eyes_.emplace_back();
      for (const glm::dvec3& eye : testEyes.of(role.polygon, role.grown, eyeZ, inline_, rays)->eyes)
        sight.eyes_.back().push_back(EyeView::untraced(eye));
      sight.skies_.emplace_back();
    }
    sight.region_.push_back(sight.eyes_.size() - 1);
    former = &role;
  }
  return sight;
}

RegionSight RegionSight::withEyes(int count, const LayoutCamera& camera, double eyeZ,
                                  BakeSettings settings) const {
  RegionSight more = *this;
  const int placed = settings.testEyes;
  settings.testEyes = std::max(count, placed);
  const Role* former = nullptr;
  for (std::size_t role = 0; role < camera.roles.size(); ++role) {
    if (former != nullptr && former->region == camera.roles[role].region) continue;
    former = &camera.roles[role];
    const std::vector<glm::dvec3> eyes = placedEyes(former->polygon, eyeZ, settings);
    for (std::size_t i = std::size_t(placed); i < eyes.size(); ++i)
      more.eyes_[region_[role]].push_back(EyeView::untraced(eyes[i]));
  }
  return more;
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
      [&](const EyeView& view, bool closely) {
        return closely ? seesClosely(*scene_, view, surface.point(), rays)
                       : seesPoint(*scene_, view, surface.point(), tolerance, rays);
      });
}

bool RegionSight::seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints,
                            RayCounts& rays) const {
  const RegionSky* sky = skies_[region_[role]].get();
  if (sky == nullptr) return false;
  const EyeView::Sees shown = sky->looksAlong(direction);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  return any(role, hints, [&](const EyeView& view) {
    ++rays.visibility;
    return !std::isfinite(scene_->occluderDistance({glm::vec3(view.eye()), glm::vec3(direction)}));
  });
}

}  // namespace acentric
