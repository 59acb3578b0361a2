#include "engine/bake/region_sight.h"

#include <utility>

namespace acentric {

bool RegionSight::findEyes(const LayoutCamera& camera, double eyeZ, TestEyes& testEyes, TaskRunner& runner,
                           RayCounts& rays, const std::stop_token& stop) {
  const Role* former = nullptr;
  for (const Role& role : camera.roles) {
    if ((former == nullptr || former->region != role.region) &&
        !testEyes.of(role.polygon, role.grown, eyeZ, runner, rays, stop))
      return false;
    former = &role;
  }
  return true;
}

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
      std::vector<std::shared_ptr<const EyeView>> eyes;
      for (const glm::dvec3& eye : region->eyes) {
        auto view = views.at(eye, runner, rays, stop);
        if (!view) return std::nullopt;
        eyes.push_back(std::move(view));
      }
      std::shared_ptr<const RegionSky> sky;  // of no eyes: none
      if (!eyes.empty()) {
        sky = skies.at(role.polygon, eyeZ, eyes, runner, rays, stop);
        if (!sky) return std::nullopt;
      }
      sight.skies_.push_back(std::move(sky));
      sight.groups_.emplace_back(std::move(eyes));
    }
    sight.region_.push_back(sight.groups_.size() - 1);
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
      std::vector<std::shared_ptr<const EyeView>> eyes;
      for (const glm::dvec3& eye : testEyes.of(role.polygon, role.grown, eyeZ, inline_, rays)->eyes)
        eyes.push_back(EyeView::untraced(eye));
      sight.groups_.emplace_back(std::move(eyes));
      sight.skies_.emplace_back();
    }
    sight.region_.push_back(sight.groups_.size() - 1);
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
    const std::vector<glm::dvec3> places = placedEyes(former->polygon, eyeZ, settings);
    EyeGroup& group = more.groups_[region_[role]];
    auto eyes = group.eyes();
    for (std::size_t i = std::size_t(placed); i < places.size(); ++i)
      eyes.push_back(EyeView::untraced(places[i]));
    group = EyeGroup(std::move(eyes));
  }
  return more;
}

std::vector<glm::dvec3> RegionSight::eyes() const {
  std::vector<glm::dvec3> eyes;
  for (const EyeGroup& region : groups_)
    for (const auto& view : region.eyes()) eyes.push_back(view->eye());
  return eyes;
}

Side RegionSight::sees(std::size_t role, const MetSurface& surface, double tolerance, Hints& hints,
                       RayCounts& rays, bool byRays) const {
  const EyeGroup& group = groups_[region_[role]];
  const glm::dvec3& point = surface.point();
  bool askedOne = false, askedAll = false;
  const auto isHidden = [&](std::size_t eye) {
    // The one that answered last mostly does again.
    if (group.isUntraced() || !std::exchange(askedOne, true)) return false;
    if (!std::exchange(askedAll, true)) group.findHidden(point, hints.hidden);
    return hints.hidden[eye] != 0;
  };
  return sideSeen(
      role, surface, hints, [](const EyeView& view) -> const glm::dvec3& { return view.eye(); },
      [&](const EyeView& view, bool closely) {
        if (closely) return seesClosely(*scene_, view, point, rays);
        return byRays ? seesByRay(*scene_, view, point, tolerance, rays)
                      : seesPoint(*scene_, view, point, tolerance, rays);
      },
      isHidden);
}

bool RegionSight::seesAlong(std::size_t role, const glm::dvec3& direction, Hints& hints,
                            RayCounts& rays) const {
  const RegionSky* sky = skies_[region_[role]].get();
  if (sky == nullptr) return false;
  const EyeView::Sees shown = sky->looksAlong(direction);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  return any(role, hints, [&](const EyeView& view, std::size_t) {
    ++rays.visibility;
    return !scene_->isOccluded({glm::vec3(view.eye()), glm::vec3(direction)});
  });
}

}  // namespace acentric
