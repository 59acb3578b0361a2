#include "engine/inspect/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/contract.h"
#include "engine/scene/placed_mesh.h"

namespace acentric {
namespace {

double areaOf(const std::array<glm::vec3, 3>& corners) {
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// By how much a transform makes everything larger; nothing if not all directions alike.
std::optional<double> evenScale(const glm::mat4x3& m) {
  constexpr double kEven = 1e-5;
  const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
  const double scale = glm::length(x), most = kEven * scale * scale;
  const auto differs = [&](const glm::dvec3& v) { return std::abs(glm::dot(v, v) - scale * scale) > most; };
  if (differs(y) || differs(z) || std::abs(glm::dot(x, y)) > most || std::abs(glm::dot(y, z)) > most ||
      std::abs(glm::dot(z, x)) > most)
    return std::nullopt;
  return scale;
}

/// In [0, 1), the same for the same numbers (splitmix64).
double randomAt(std::uint64_t n, std::uint64_t k) {
  std::uint64_t h = n * 0x9e3779b97f4a7c15u + (k + 1) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return double((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

SurfacePoints::SurfacePoints(ScenePtr scene) : scene_(std::move(scene)) {
  double area = 0;
  for (std::uint32_t m = 0; m < scene_->meshes.size(); ++m) {
    const Mesh& mesh = scene_->meshes[m];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& corners = mesh.triangles[t];
      const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
          c(mesh.positions[corners.z]);
      const double own = 0.5 * glm::length(glm::cross(b - a, c - a));
      if (!(own > 0) || !std::isfinite(own)) continue;
      area += own;
      triangles_.push_back({m, t});
      area_.push_back(area);
    }
  }
  addInstances();
}

void SurfacePoints::addInstances() {
  for (const Mesh& mesh : scene_->prototypes) {
    Prototype& prototype = prototypes_.emplace_back();
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double own = areaOf(PlacedMesh(mesh, nullptr).corners(t));
      if (!(own > 0) || !std::isfinite(own)) continue;
      prototype.triangles.push_back(t);
      prototype.area.push_back(area += own);
    }
  }
  double area = area_.empty() ? 0 : area_.back();
  for (std::uint32_t i = 0; i < scene_->instances.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    const Prototype& prototype = prototypes_[instance.prototype];
    if (prototype.area.empty()) continue;
    if (const auto scale = evenScale(instance.worldFromPrototype)) {
      area += *scale * *scale * prototype.area.back();
    } else {
      const PlacedMesh placed(scene_->prototypes[instance.prototype], &instance.worldFromPrototype);
      for (const std::uint32_t t : prototype.triangles) area += areaOf(placed.corners(t));
    }
    instances_.push_back(i);
    area_.push_back(area);
  }
}

/// By area. Where the instance is stretched, triangles are drawn by their own areas and taken as often as
/// they are stretched.
std::uint32_t SurfacePoints::triangleOf(std::uint32_t number, double share, std::uint64_t n) const {
  const Instance& instance = scene_->instances[number];
  const Prototype& prototype = prototypes_[instance.prototype];
  const auto at = [&](double place) {
    const auto found = std::ranges::upper_bound(prototype.area, place * prototype.area.back());
    return std::min(std::size_t(found - prototype.area.begin()), prototype.area.size() - 1);
  };
  std::size_t index = at(share);
  if (evenScale(instance.worldFromPrototype)) return prototype.triangles[index];
  const PlacedMesh placed(scene_->prototypes[instance.prototype], &instance.worldFromPrototype);
  const glm::dvec3 x(instance.worldFromPrototype[0]), y(instance.worldFromPrototype[1]),
      z(instance.worldFromPrototype[2]);
  // No less than the largest stretch of an area: the norm of the cofactors.
  const double most =
      std::sqrt(glm::dot(glm::cross(y, z), glm::cross(y, z)) + glm::dot(glm::cross(z, x), glm::cross(z, x)) +
                glm::dot(glm::cross(x, y), glm::cross(x, y)));
  constexpr int kTries = 1000;
  for (std::uint64_t k = 0; k < kTries; ++k) {
    const double own = prototype.area[index] - (index > 0 ? prototype.area[index - 1] : 0);
    if (randomAt(n, 2 * k) * most * own <= areaOf(placed.corners(prototype.triangles[index]))) break;
    index = at(randomAt(n, 2 * k + 1));
  }
  return prototype.triangles[index];
}

SurfacePoint SurfacePoints::at(std::uint64_t n) const {
  require(!area_.empty(), "the scene has surfaces");
  // Powers of the root of x^4 = x + 1: the generalised golden ratio for three dimensions.
  constexpr double kRoot = 1.2207440846057596;
  constexpr double kSteps[3] = {1 / kRoot, 1 / (kRoot * kRoot), 1 / (kRoot * kRoot * kRoot)};
  const auto place = [&](int dimension) { return std::fmod(0.5 + double(n + 1) * kSteps[dimension], 1.0); };
  const auto found = std::ranges::upper_bound(area_, place(0) * area_.back());
  const std::size_t index = std::min(std::size_t(found - area_.begin()), area_.size() - 1);
  double u = place(1), v = place(2);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  Ref ref{};
  if (index < triangles_.size()) {
    ref = triangles_[index];
  } else {
    const std::uint32_t instance = instances_[index - triangles_.size()];
    const double before = index > 0 ? area_[index - 1] : 0;
    const double share = (place(0) * area_.back() - before) / (area_[index] - before);
    ref = {std::uint32_t(scene_->meshes.size()) + instance,
           triangleOf(instance, std::clamp(share, 0.0, 1.0), n)};
  }
  const PlacedMesh placed(*scene_, ref.mesh);
  const auto corners = placed.corners(ref.triangle);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 across = (placed.mirrored() ? -1.0 : 1.0) * glm::cross(b - a, c - a);
  return {a + u * (b - a) + v * (c - a), glm::normalize(across), ref.mesh, ref.triangle};
}

}  // namespace acentric
