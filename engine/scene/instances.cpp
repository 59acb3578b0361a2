#include "engine/scene/instances.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/scene/mesh_attributes.h"
#include "engine/scene/placed_mesh.h"

namespace acentric {

bool isPlacement(const glm::mat4x3& m) {
  constexpr double kFarthest = 1e12, kFlattest = 1e-6;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(m[column][row]) < kFarthest)) return false;
  const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
  const double lengths = glm::length(x) * glm::length(y) * glm::length(z);
  return lengths > 1e-30 && std::abs(glm::dot(x, glm::cross(y, z))) > kFlattest * lengths;
}

namespace {

/// Some of its triangles, with the vertices that they use.
Mesh excerptOf(const Mesh& from, std::span<const std::uint32_t> triangles) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(from.positions.size(), kUnused), used;
  std::vector<glm::uvec3> renumbered;
  renumbered.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    glm::uvec3 corners = from.triangles[t];
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& own = number[corners[k]];
      if (own == kUnused) own = std::uint32_t(used.size()), used.push_back(corners[k]);
      corners[k] = own;
    }
    renumbered.push_back(corners);
  }
  Mesh out = withVertices(from, used);
  out.triangles = std::move(renumbered);
  return out;
}

/// From a prototype's frame into the world.
Mesh moved(Mesh mesh, const glm::mat4x3& worldFromMesh) {
  const PlacedMesh placed(mesh, &worldFromMesh);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) mesh.positions[v] = placed.position(v);
  for (std::uint32_t v = 0; v < mesh.normals.size(); ++v) mesh.normals[v] = placed.normal(v);
  for (std::uint32_t v = 0; v < mesh.tangents.size(); ++v) mesh.tangents[v] = placed.tangent(v);
  if (placed.mirrored())
    for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  return mesh;
}

}  // namespace

Mesh placedAsMesh(const Scene& scene, const Instance& instance) {
  return moved(scene.prototypes[instance.prototype], instance.worldFromPrototype);
}

Mesh placedAsMesh(const Scene& scene, const Instance& instance, std::span<const std::uint32_t> triangles) {
  return moved(excerptOf(scene.prototypes[instance.prototype], triangles), instance.worldFromPrototype);
}

Scene withPlaced(const Scene& scene, std::span<const std::uint32_t> instances) {
  Scene out = scene;
  out.meshes.reserve(scene.meshes.size() + instances.size());
  for (const std::uint32_t i : instances) out.meshes.push_back(placedAsMesh(scene, scene.instances[i]));
  out.instances.clear();
  for (std::size_t i = 0, next = 0; i < scene.instances.size(); ++i)
    if (next < instances.size() && instances[next] == i)
      ++next;
    else
      out.instances.push_back(scene.instances[i]);
  std::vector<std::uint32_t> number(scene.prototypes.size(), 0);
  for (const Instance& instance : out.instances) number[instance.prototype] = 1;
  out.prototypes.clear();
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] == 0) continue;
    number[p] = std::uint32_t(out.prototypes.size());
    out.prototypes.push_back(scene.prototypes[p]);
  }
  for (Instance& instance : out.instances) instance.prototype = number[instance.prototype];
  return out;
}

Scene flattened(const Scene& scene) {
  std::vector<std::uint32_t> all(scene.instances.size());
  std::iota(all.begin(), all.end(), 0u);
  return withPlaced(scene, all);
}

std::vector<Bounds> boundsOf(const std::vector<Mesh>& meshes) {
  std::vector<Bounds> all(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const glm::uvec3& t : meshes[m].triangles)
      for (int corner = 0; corner < 3; ++corner) all[m].add(meshes[m].positions[t[corner]]);
  return all;
}

Bounds boundsOf(const Instance& instance, const Bounds& own) {
  Bounds out;
  if (own.empty()) return out;
  const glm::mat4x3& m = instance.worldFromPrototype;
  const glm::dvec3 centre = glm::dvec3(own.min) * 0.5 + glm::dvec3(own.max) * 0.5;
  const glm::dvec3 half = glm::dvec3(own.max) - centre;
  glm::dvec3 middle(m[3]), reach(0);
  for (int axis = 0; axis < 3; ++axis) {
    middle += glm::dvec3(m[axis]) * centre[axis];
    reach += glm::abs(glm::dvec3(m[axis])) * half[axis];
  }
  reach +=
      1e-6 * (reach + glm::abs(middle));  // no less than the triangles, however their corners are rounded
  out.add(glm::vec3(middle - reach));
  out.add(glm::vec3(middle + reach));
  return out;
}

void addInstances(const Scene& scene, Bounds& bounds) {
  const std::vector<Bounds> own = boundsOf(scene.prototypes);
  std::vector<Bounds> boxes;
  boxes.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances)
    boxes.push_back(boundsOf(instance, own[instance.prototype]));
  // Only those whose boxes reach beyond what is known are looked at vertex by vertex, the farthest first:
  // few.
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto addExactly = [&](std::uint32_t i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.prototypes[instance.prototype];
    const PlacedMesh placed(mesh, &instance.worldFromPrototype);
    for (const glm::uvec3& t : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) bounds.add(placed.position(t[corner]));
  };
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return boxes[i].min[axis]; });
    for (const std::uint32_t i : order) {
      if (boxes[i].empty()) continue;
      if (boxes[i].min[axis] >= bounds.min[axis]) break;
      addExactly(i);
    }
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return -boxes[i].max[axis]; });
    for (const std::uint32_t i : order) {
      if (boxes[i].empty()) continue;
      if (boxes[i].max[axis] <= bounds.max[axis]) break;
      addExactly(i);
    }
  }
}

}  // namespace acentric
