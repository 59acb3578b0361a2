#include "engine/scene/flat_mirrors.h"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"
#include "engine/scene/material_rules.h"
#include "engine/scene/triangle_normal.h"

namespace acentric {
namespace {

/// Normals that far apart (radians, squared and halved) still make a picture that is flat to the eye.
constexpr float kSameNormal = 1 - 1e-5f;
/// Of the scene's size: how far apart parallel planes are still one.
constexpr float kSamePlane = 1e-5f;

/// Does light leave every point of the triangle as from its plane?
bool isFlat(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& normal) {
  if (mesh.normals.empty()) return true;
  const glm::uvec3& corners = mesh.triangles[triangle];
  const float side = glm::dot(mesh.normals[corners.x], normal) < 0 ? -1.0f : 1.0f;
  for (int c = 0; c < 3; ++c)
    if (!(side * glm::dot(mesh.normals[corners[c]], normal) >= kSameNormal)) return false;
  return true;
}

}  // namespace

bool FlatMirrors::isFacet(const Mesh& mesh, std::uint32_t triangle) const {
  const Smooth smooth = materials_[std::size_t(mesh.material)];
  if (smooth == Smooth::no || (smooth == Smooth::withoutTangents && !mesh.tangents.empty())) return false;
  return isFlat(mesh, triangle, triangleNormal(mesh, triangle));
}

std::vector<FlatMirrors::Facet> FlatMirrors::facetsOf(const std::vector<Mesh>& meshes) const {
  std::vector<Facet> facets;
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    const Mesh& mesh = meshes[m];
    if (materials_[std::size_t(mesh.material)] == Smooth::no) continue;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!isFacet(mesh, t)) continue;
      const glm::uvec3& corners = mesh.triangles[t];
      const glm::vec3& a = mesh.positions[corners.x];
      facets.push_back(
          {m, t, glm::length(glm::cross(mesh.positions[corners.y] - a, mesh.positions[corners.z] - a))});
    }
  }
  return facets;
}

std::uint8_t FlatMirrors::findPlane(const Mesh& mesh, std::uint32_t triangle) const {
  const glm::uvec3& corners = mesh.triangles[triangle];
  const glm::vec3 normal = triangleNormal(mesh, triangle);
  const auto plane = std::ranges::find_if(planes_, [&](const Plane& p) {
    if (std::abs(glm::dot(p.normal, normal)) < kSameNormal) return false;
    for (int c = 0; c < 3; ++c)
      if (std::abs(glm::dot(p.normal, mesh.positions[corners[c]] - p.point)) > slack_) return false;
    return true;
  });
  return plane == planes_.end() ? kNoPlane : std::uint8_t(plane - planes_.begin());
}

FlatMirrors::FlatMirrors(const Scene& scene, const EffectPlan& plan) : planeOf_(scene.meshes.size()) {
  const std::vector<MaterialRules> rules = materialRules(scene, plan);
  for (std::size_t m = 0; m < rules.size(); ++m) {
    const bool bumpy = plan.on(Effect::normalMaps) && scene.materials[m].normalTexture.used();
    materials_.push_back(!rules[m].mirror || rules[m].clear() ? Smooth::no
                         : bumpy                              ? Smooth::withoutTangents
                                                              : Smooth::yes);
  }
  std::vector<Facet> facets = facetsOf(scene.meshes);
  std::ranges::stable_sort(facets, std::ranges::greater{}, &Facet::area);
  slack_ = facets.empty() ? 0 : kSamePlane * glm::length(scene.bounds.size());
  for (const Facet& facet : facets) {
    const Mesh& mesh = scene.meshes[facet.mesh];
    const glm::uvec3& corners = mesh.triangles[facet.triangle];
    std::uint8_t found = findPlane(mesh, facet.triangle);
    if (found == kNoPlane) {
      if (planes_.size() == kMaxPlanes) continue;
      const glm::vec3 normal = triangleNormal(mesh, facet.triangle);
      const glm::vec3 level = std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
      const glm::vec3 right = glm::normalize(glm::cross(level, normal));
      found = std::uint8_t(planes_.size());
      planes_.push_back({normal, mesh.positions[corners.x], right, glm::cross(normal, right)});
    }
    Plane& plane = planes_[found];
    for (int c = 0; c < 3; ++c) {
      const glm::vec3 way = mesh.positions[corners[c]] - plane.point;
      const glm::vec2 at(glm::dot(plane.right, way), glm::dot(plane.up, way));
      plane.low = glm::min(plane.low, at), plane.high = glm::max(plane.high, at);
    }
    std::vector<std::uint8_t>& planes = planeOf_[facet.mesh];
    if (planes.empty()) planes.assign(mesh.triangles.size(), kNoPlane);
    planes[facet.triangle] = found;
  }
}

FlatMirrors::FlatMirrors(std::span<const MirrorPlane> planes) {
  require(planes.size() <= kMaxPlanes, "mirrors have numbers of 8 bits");
  for (const MirrorPlane& plane : planes) planes_.push_back({plane.normal, plane.point});
}

std::uint8_t FlatMirrors::planeOf(const LocalGeometry& local, const LocalTriangle& triangle) const {
  if (!local.surfaces) return planeOf(triangle.mesh, triangle.triangle);
  if (!local.surfaces->mirrorPlanes.empty()) {
    const std::vector<std::uint8_t>& planes = local.surfaces->mirrorPlanes[triangle.mesh];
    return planes.empty() ? kNoPlane : planes[triangle.triangle];
  }
  if (materials_.empty()) return kNoPlane;
  const Mesh& mesh = local.surfaces->meshes[triangle.mesh];
  return isFacet(mesh, triangle.triangle) ? findPlane(mesh, triangle.triangle) : kNoPlane;
}

std::vector<FlatMirror> FlatMirrors::sides() const {
  std::vector<FlatMirror> sides;
  for (const Plane& p : planes_)
    for (const double side : {1.0, -1.0})
      sides.push_back({std::uint8_t(sides.size() + 1), p.point, side * glm::normalize(glm::dvec3(p.normal)),
                       p.right, p.up, p.low, p.high});
  return sides;
}

std::vector<MirrorPlane> FlatMirrors::planes() const {
  std::vector<MirrorPlane> planes;
  for (const Plane& p : planes_) planes.push_back({p.normal, p.point});
  return planes;
}

std::shared_ptr<const FlatMirrors> flatMirrorsOf(const Scene& scene, const EffectPlan& plan) {
  auto mirrors = std::make_shared<const FlatMirrors>(scene, plan);
  return mirrors->any() ? mirrors : nullptr;
}

}  // namespace acentric
