#pragma once
/// Which triangles of a scene are plane mirrors, and which of them make one mirror. In a plane mirror what is
/// seen has one virtual place for all eyes, so that captures can keep it there; in a curved or bumpy one it
/// has not. Captures and local geometry number mirrors alike, by scene and effect plan alone.

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/scene/effect_plan.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/scene.h"

namespace acentric {

/// One side of a plane with mirrors on it. Where on the plane they are is known by a rectangle around them
/// all; a ray tells the rest.
struct FlatMirror {
  std::uint8_t number = 0;  ///< as FlatMirrors::at
  glm::dvec3 point{0};      ///< on the plane
  glm::dvec3 normal{0};     ///< unit, towards those who see it
  glm::dvec3 right{0}, up{0};
  glm::dvec2 low{0}, high{0};  ///< metres from `point` along right and up

  /// Metres before the plane; negative behind it.
  double height(const glm::dvec3& place) const { return glm::dot(normal, place - point); }
  glm::dvec2 inPlane(const glm::dvec3& way) const { return {glm::dot(right, way), glm::dot(up, way)}; }
  glm::dvec3 imageOf(const glm::dvec3& place) const { return place - 2 * height(place) * normal; }
  glm::dvec3 reflected(const glm::dvec3& way) const { return way - 2 * glm::dot(normal, way) * normal; }
};

/// Of a mirror's plane what tells which side of it an eye sees.
struct MirrorPlane {
  glm::vec3 normal{0};  ///< unit
  glm::vec3 point{0};
  bool operator==(const MirrorPlane&) const = default;
};

class FlatMirrors {
 public:
  /// None where the plan has no mirrors. Of more planes than can be numbered those with the largest
  /// triangles.
  FlatMirrors(const Scene& scene, const EffectPlan& plan);
  /// Known planes, by number: only local geometry that says which of them it lies in
  /// (LocalSurfaces::mirrorPlanes) has mirrors. At most kMaxPlanes.
  explicit FlatMirrors(std::span<const MirrorPlane> planes);

  /// Coplanar triangles are one plane, whatever they belong to; each of its sides is a mirror.
  static constexpr std::size_t kMaxPlanes = 127;

  bool any() const { return !planes_.empty(); }
  /// Number of the mirror whose side is seen of a scene triangle, 1..255; 0: it is no plane mirror.
  std::uint8_t at(std::uint32_t mesh, std::uint32_t triangle, const glm::vec3& toViewer) const {
    const std::uint8_t plane = planeOf(mesh, triangle);
    return plane == kNoPlane ? std::uint8_t(0) : sideOf(plane, toViewer);
  }
  static constexpr std::uint8_t kNoPlane = 0xff;
  /// The plane of a triangle of local geometry; of its own surfaces those that lie in one.
  std::uint8_t planeOf(const LocalGeometry& local, const LocalTriangle& triangle) const;
  /// Number of the mirror that an eye sees of a plane, wherever it looks.
  std::uint8_t seenFrom(std::uint8_t plane, const glm::dvec3& eye) const {
    return sideOf(plane, glm::vec3(eye - glm::dvec3(planes_[plane].point)));
  }
  /// Both sides of all planes, by number.
  std::vector<FlatMirror> sides() const;
  /// All planes, by number.
  std::vector<MirrorPlane> planes() const;
  /// Metres: how far a mirror may lie off its plane.
  float slack() const { return slack_; }

 private:
  struct Plane {
    glm::vec3 normal{0};  ///< unit
    glm::vec3 point{0};
    glm::vec3 right{0}, up{0};
    glm::vec2 low{0}, high{0};
  };
  struct Facet {
    std::uint32_t mesh = 0, triangle = 0;
    float area = 0;
  };
  enum class Smooth : std::uint8_t { no, withoutTangents, yes };
  std::vector<Facet> facetsOf(const std::vector<Mesh>& meshes) const;
  bool isFacet(const Mesh& mesh, std::uint32_t triangle) const;
  /// The first that all its corners lie in; kNoPlane if none.
  std::uint8_t findPlane(const Mesh& mesh, std::uint32_t triangle) const;
  std::uint8_t planeOf(std::uint32_t mesh, std::uint32_t triangle) const {
    if (mesh >= planeOf_.size()) return kNoPlane;  // an instance
    const std::vector<std::uint8_t>& planes = planeOf_[mesh];
    return planes.empty() ? kNoPlane : planes[triangle];
  }
  std::uint8_t sideOf(std::uint8_t plane, const glm::vec3& toViewer) const {
    return std::uint8_t(1 + 2 * plane + (glm::dot(planes_[plane].normal, toViewer) < 0 ? 1 : 0));
  }

  std::vector<Smooth> materials_;
  float slack_ = 0;
  std::vector<Plane> planes_;
  std::vector<std::vector<std::uint8_t>> planeOf_;  ///< by mesh and triangle; empty: none of the mesh
};

/// Null where there are none.
std::shared_ptr<const FlatMirrors> flatMirrorsOf(const Scene& scene, const EffectPlan& plan);

}  // namespace acentric
