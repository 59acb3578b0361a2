#include "engine/view/local_corners.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "engine/scene/mesh_attributes.h"

namespace acentric {
namespace {

constexpr std::uint32_t kHasBack = 1u << 16;

/// Everything that the shader and we index by must exist; local geometry comes from our own clipping, but of
/// a scene that may have been exchanged since.
bool fits(const Scene& scene, const LocalGeometry& geometry) {
  const std::vector<Mesh>& meshes = geometry.meshes(scene);
  for (const Mesh& mesh : meshes)
    if (mesh.material < 0 || std::size_t(mesh.material) >= scene.materials.size()) return false;
  return std::all_of(geometry.triangles.begin(), geometry.triangles.end(), [&](const LocalTriangle& t) {
    return t.mesh < meshes.size() && t.triangle < meshes[t.mesh].triangles.size() &&
           std::max({t.vertices.x, t.vertices.y, t.vertices.z}) < geometry.vertices.size();
  });
}

/// Whether some effect plan can make it clear.
bool canBeClear(const Material& material) {
  return material.alphaMode == AlphaMode::blend || material.transmission > 0;
}

glm::vec2 uvAt(const Mesh& mesh, const TextureUse& use, const glm::uvec3& corners, const glm::vec2& weights) {
  if (!hasCoordinates(mesh, use)) return glm::vec2(0);
  return use.transform * glm::vec3(interpolate(coordinatesOf(mesh, use), corners, weights), 1);
}

glm::u16vec4 colourAt(const Mesh& mesh, const glm::uvec3& corners, const glm::vec2& weights) {
  if (mesh.colours.empty()) return glm::u16vec4(65535);
  return glm::u16vec4(glm::round(glm::clamp(vertexColourAt(mesh, corners, weights), 0.0f, 1.0f) * 65535.0f));
}

/// Without usable normals in the file, that of the triangle.
glm::vec3 normalAt(const Mesh& mesh, const glm::uvec3& corners, const glm::vec2& weights) {
  const glm::vec3 normal = mesh.normals.empty() ? glm::vec3(0) : interpolate(mesh.normals, corners, weights);
  if (glm::dot(normal, normal) > 0) return normal;
  return glm::cross(mesh.positions[corners.y] - mesh.positions[corners.x],
                    mesh.positions[corners.z] - mesh.positions[corners.x]);
}

/// Copies the light of source triangles into one compact array, each triangle once.
class LightGatherer {
 public:
  LightGatherer(const std::vector<Mesh>& meshes, const SurfaceLight* light)
      : light_(light), firstTriangles_(firstTrianglesOf(meshes)) {}

  struct Place {
    std::uint32_t first = 0, resolution = 0;
  };
  Place place(const LocalTriangle& triangle) {
    const std::uint32_t source = firstTriangles_[triangle.mesh] + triangle.triangle;
    if (light_ == nullptr || source >= light_->resolution.size() || light_->resolution[source] == 0)
      return {};
    const auto [found, isNew] = places_.try_emplace(source);
    if (isNew) {
      const std::uint32_t resolution = light_->resolution[source];
      const bool back = light_->hasBack[source] != 0;
      const std::size_t first = light_->firstSample[source];
      const std::size_t count = std::size_t(surfaceSampleCount(resolution)) * (back ? 2 : 1);
      if (first + count > light_->light.size()) return {};
      found->second = {std::uint32_t(samples.size()), resolution | (back ? kHasBack : 0)};
      samples.insert(samples.end(), light_->light.begin() + std::ptrdiff_t(first),
                     light_->light.begin() + std::ptrdiff_t(first + count));
    }
    return found->second;
  }

  std::vector<HalfColour> samples;

 private:
  const SurfaceLight* light_;
  std::vector<std::uint32_t> firstTriangles_;
  std::unordered_map<std::uint32_t, Place> places_;
};

}  // namespace

Result<LocalCorners> localCorners(const WalkScene& walk, const LocalGeometry& geometry,
                                  const glm::dvec3& origin) {
  const Scene& scene = *walk.scene;
  if (!fits(scene, geometry))
    return fail(ErrorKind::malformed, "the local geometry was not made from this scene: clip it again",
                "local geometry");
  LocalCorners out;
  const std::vector<Mesh>& meshes = geometry.meshes(scene);
  const SurfaceLight* const ownLight =
      geometry.surfaces ? &geometry.surfaces->light : walk.surfaceLight.get();
  out.lit = ownLight != nullptr && !ownLight->empty();
  struct Placed {
    LocalTriangle triangle;
    std::uint8_t mirrorPlane;
  };
  std::vector<Placed> triangles;
  triangles.reserve(geometry.triangles.size());
  for (const LocalTriangle& t : geometry.triangles) {
    triangles.push_back({t, walk.mirrors ? walk.mirrors->planeOf(geometry, t) : FlatMirrors::kNoPlane});
    out.mirrors = out.mirrors || triangles.back().mirrorPlane != FlatMirrors::kNoPlane;
  }
  const auto key = [&](const Placed& placed) {
    const Mesh& mesh = meshes[placed.triangle.mesh];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    return std::make_tuple(canBeClear(material), mesh.material, !mesh.colours.empty(),
                           hasCoordinates(mesh, material.baseColourTexture),
                           hasCoordinates(mesh, material.emissiveTexture), placed.mirrorPlane);
  };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const Placed& a, const Placed& b) { return key(a) < key(b); });

  LightGatherer gatherer(meshes, out.lit ? ownLight : nullptr);
  out.corners.reserve(3 * triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const LocalTriangle& triangle = triangles[n].triangle;
    const Mesh& mesh = meshes[triangle.mesh];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const glm::uvec3 source = mesh.triangles[triangle.triangle];
    const LightGatherer::Place place = gatherer.place(triangle);
    const bool clear = canBeClear(material);
    for (int corner = 0; corner < 3; ++corner) {
      const LocalVertex& v = geometry.vertices[triangle.vertices[corner]];
      const glm::vec3 position(glm::dvec3(v.position) - origin);
      out.corners.push_back(
          {position, v.barycentric, uvAt(mesh, material.baseColourTexture, source, v.barycentric),
           uvAt(mesh, material.emissiveTexture, source, v.barycentric), colourAt(mesh, source, v.barycentric),
           place.first, place.resolution, normalAt(mesh, source, v.barycentric)});
      if (clear) out.clearCorners.push_back(position);
    }
    if (n == 0 || key(triangles[n - 1]) != key(triangles[n])) {
      const auto [isClear, index, colours, baseUv, emissiveUv, plane] = key(triangles[n]);
      out.batches.push_back({index, colours, baseUv, emissiveUv, plane, std::uint32_t(n), 0});
    }
    ++out.batches.back().triangles;
    if (!clear) out.firstClear = std::uint32_t(n) + 1;
  }
  out.light = std::move(gatherer.samples);
  return out;
}

}  // namespace acentric
