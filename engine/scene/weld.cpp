#include "engine/scene/weld.h"

#include <array>
#include <bit>
#include <unordered_map>

#include "engine/scene/mesh_attributes.h"
#include "engine/scene/triangle_bvh.h"

namespace acentric {
namespace {

/// All that shading reads of a vertex; vertices that are alike in it are one.
struct VertexKey {
  std::uint32_t mesh = 0;
  std::array<float, 10> values{};  ///< position, two texture coordinates, normal where it is seen
  glm::u8vec4 colour{0};
  bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t hash = key.mesh;
    const auto mix = [&](std::uint32_t v) { hash = (hash ^ v) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29; };
    for (const float value : key.values) mix(std::bit_cast<std::uint32_t>(value + 0.0f));
    mix(std::bit_cast<std::uint32_t>(key.colour));
    return std::size_t(hash);
  }
};

VertexKey keyOf(const Scene& scene, std::uint32_t mesh, std::uint32_t vertex) {
  const Mesh& m = scene.meshes[mesh];
  const Material& material = scene.materials[std::size_t(m.material)];
  VertexKey key;
  key.mesh = mesh;
  const glm::vec3& p = m.positions[vertex];
  std::size_t at = 0;
  const auto add = [&](float value) { key.values[at++] = value == 0 ? 0.0f : value; };  // -0 is 0
  add(p.x), add(p.y), add(p.z);
  for (const auto& uv : m.uv) {
    const bool used = !uv.empty() && (material.baseColourTexture.used() || material.emissiveTexture.used());
    add(used ? uv[vertex].x : 0), add(used ? uv[vertex].y : 0);
  }
  // Only glass shows its normals; the light of the others is baked.
  if (material.transmission > 0 && !m.normals.empty())
    for (int axis = 0; axis < 3; ++axis) add(m.normals[vertex][axis]);
  if (!m.colours.empty()) key.colour = m.colours[vertex];
  return key;
}

/// The whole triangles as one mesh for decimation, and where its vertices come from.
const MeshArray<glm::vec2>* paintedUv(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials[std::size_t(mesh.material)];
  for (const TextureUse* use : {&material.baseColourTexture, &material.emissiveTexture})
    if (hasCoordinates(mesh, *use)) return &coordinatesOf(mesh, *use);
  return nullptr;
}

}  // namespace

struct Welder::Known {
  std::vector<std::vector<std::uint32_t>> byIndex;  ///< by mesh and vertex
  std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> alike;
};

Welder::Welder(const Scene& scene) : scene_(scene), known_(std::make_unique<Known>()) {
  known_->byIndex.resize(scene.meshes.size());
}
Welder::~Welder() = default;

bool Welder::add(const LocalTriangle& t) {
  const glm::uvec3& corners = scene_.meshes[t.mesh].triangles[t.triangle];
  const glm::uvec3 welded(vertex(t.mesh, corners.x), vertex(t.mesh, corners.y), vertex(t.mesh, corners.z));
  if (welded.x == welded.y || welded.y == welded.z || welded.z == welded.x) return false;
  out.mesh.triangles.push_back(welded);
  out.triangleSource.push_back({t.mesh, t.triangle});
  return true;
}

std::uint32_t Welder::vertex(std::uint32_t mesh, std::uint32_t index) {
  const Mesh& source = scene_.meshes[mesh];
  if (known_->byIndex[mesh].empty())
    known_->byIndex[mesh].assign(source.positions.size(), TriangleBvh::kNone);
  std::uint32_t& known = known_->byIndex[mesh][index];
  if (known != TriangleBvh::kNone) return known;
  const auto [at, isNew] =
      known_->alike.try_emplace(keyOf(scene_, mesh, index), std::uint32_t(out.vertexSource.size()));
  if (isNew) {
    out.vertexSource.push_back({mesh, index});
    out.mesh.positions.push_back(source.positions[index]);
    const auto* uv = paintedUv(scene_, source);
    out.mesh.uv.push_back(uv ? (*uv)[index] : glm::vec2(0));
    out.mesh.colours.push_back(source.colours.empty() ? glm::vec4(1)
                                                      : glm::vec4(source.colours[index]) / 255.0f);
  }
  return known = at->second;
}

}  // namespace acentric
