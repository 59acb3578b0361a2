#pragma once
/// Instances of prototypes: what stands in very many places is in memory once.
///
/// All that is asked by rays, and all that is measured of a scene, sees instances as it sees meshes: placed
/// meshes are numbered through (Scene::placedCount, placed_mesh.h). What has state for each triangle of its
/// own - surface light, geometry near the walk, mirrors, lamps - knows meshes alone: mirrors and lamps are
/// placed as meshes first, and of others what regions draw is a mesh as well (drawn_scene.h).

#include <span>
#include <vector>

#include "engine/scene/placed_mesh.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Of a scene, all prototypes together: Embree has about a kilobyte for each.
inline constexpr std::size_t kMaxInstances = 1'000'000;

/// Can rays be carried through it, there and back? Finite, and no axis is flat to speak of.
bool isPlacement(const glm::mat4x3& worldFromPrototype);

/// An instance as a mesh of its own.
Mesh placedAsMesh(const Scene& scene, const Instance& instance);
/// Some of its triangles, in the order given.
Mesh placedAsMesh(const Scene& scene, const Instance& instance, std::span<const std::uint32_t> triangles);

/// The same scene with some instances, ascending numbers of Scene::instances, as meshes behind its own. The
/// keys stay: it looks the same.
Scene withPlaced(const Scene& scene, std::span<const std::uint32_t> instances);

/// The same scene without instances: the reference that instances are tested against.
Scene flattened(const Scene& scene);

/// Calls `visit(number, placed, triangle, standsFor)` for each triangle that can be seen, with the number of
/// the placed mesh that it is of; of more than `most` of instances for as many, spread evenly, of which each
/// stands for more than one.
template <class Visit>
void eachTriangle(const Scene& scene, std::uint64_t most, const Visit& visit) {
  std::uint32_t number = 0;
  for (; number < scene.meshes.size(); ++number) {
    const PlacedMesh placed(scene, number);
    for (std::uint32_t t = 0; t < placed.mesh().triangles.size(); ++t) visit(number, placed, t, 1.0);
  }
  const std::uint64_t all = scene.instancedTriangleCount(), step = all <= most ? 1 : (all + most - 1) / most;
  std::uint64_t next = 0;  // triangles to leave out
  for (; number < scene.placedCount(); ++number) {
    const std::uint64_t count = scene.meshOf(number).triangles.size();
    if (next < count) {
      const PlacedMesh placed(scene, number);
      for (; next < count; next += step) visit(number, placed, std::uint32_t(next), double(step));
    }
    next -= count;
  }
}

/// Around each mesh's triangles, in its own frame.
std::vector<Bounds> boundsOf(const std::vector<Mesh>& meshes);
/// Around an instance; `own`: of its prototype. May be wider than its triangles.
Bounds boundsOf(const Instance& instance, const Bounds& own);
/// Widens bounds to hold all triangles of the instances, exactly.
void addInstances(const Scene& scene, Bounds& bounds);

}  // namespace acentric
