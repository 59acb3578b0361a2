#include "engine/bake/column_roles.h"

#include <algorithm>

#include "engine/bake/bake.h"

namespace acentric {

std::uint8_t give(std::span<RoleOnRay* const> roles) {
  std::uint8_t mask = 0;
  for (RoleOnRay* having : roles) {
    mask |= having->role->bit;
    ++having->samples;
  }
  return mask;
}

void keepLastPlace(std::vector<RoleOnRay*>& needed, int maxLayers) {
  std::erase_if(needed, [&](const RoleOnRay* having) { return having->samples + 1 >= maxLayers; });
}

double reachOf(const LayoutCamera& camera) {
  double reach = 0;
  for (const Role& role : camera.roles)
    for (const glm::dvec2& corner : role.polygon.corners)
      reach = std::max(reach, glm::distance(corner, camera.position));
  return reach;
}

std::vector<ColumnRole> rolesAlong(const LayoutCamera& camera, const glm::dvec2& direction) {
  std::vector<ColumnRole> roles;
  for (std::size_t i = 0; i < camera.roles.size(); ++i) {
    const Role& role = camera.roles[i];
    // Infinitely far as seen from any region, so that its part can be told.
    constexpr double kFar = 1e6;
    const auto& corners = role.grown.corners;
    const double size = corners.size() < 2 ? 1 : glm::distance(corners[0], corners[1]);
    roles.push_back({exitDistance(camera, role, direction), i, roleBit(camera, int(i)),
                     role.clip ? &*role.clip : nullptr,
                     !role.clip || role.clip->holds(camera.position + kFar * size * direction)});
  }
  std::ranges::stable_sort(roles, {}, &ColumnRole::exit);
  return roles;
}

}  // namespace acentric
