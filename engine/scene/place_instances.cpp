// Which instances stay instances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/scene/instances.h"
#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

/// Of what mirrors or glows, times as many triangles as of all else.
constexpr std::uint64_t kMoreOfLamps = 4;

/// Smooth metal, or light of its own: found, numbered and sampled triangle by triangle.
bool isMirrorOrLamp(const Material& m) {
  if (m.unlit) return false;
  return m.emissive != glm::vec3(0) ||
         (m.metallic >= 0.9f && m.roughness <= 0.1f && !m.metallicRoughnessTexture.used());
}

/// Does it leave triangles an area?
bool showsArea(const glm::dmat4& worldFromMesh) {
  const glm::dvec3 x(worldFromMesh[0]), y(worldFromMesh[1]), z(worldFromMesh[2]);
  const double most =
      std::max({glm::length(glm::cross(x, y)), glm::length(glm::cross(y, z)), glm::length(glm::cross(z, x))});
  const double longest = std::max({glm::dot(x, x), glm::dot(y, y), glm::dot(z, z)});
  return std::isfinite(longest) && std::isfinite(glm::length(glm::dvec3(worldFromMesh[3]))) &&
         most > 1e-10 * longest;
}

class Placer {
 public:
  Placer(SourceScene& scene, const ImportOptions& options)
      : scene_(scene),
        most_(options.flatTriangles),
        triangles_(scene.prototypes.size(), 0),
        places_(scene.prototypes.size(), 0) {
    for (const SourceInstance& instance : scene.instances) {
      triangles_[instance.prototype] += scene.prototypes[instance.prototype].triangles.size();
      ++places_[instance.prototype];
    }
  }

  Status place() {
    choose();
    std::vector<SourceMesh> meshes;
    std::vector<SourceInstance> kept;
    std::size_t next = 0;
    const auto takeMeshes = [&](std::size_t end) {
      for (; next < end; ++next) meshes.push_back(std::move(scene_.meshes[next]));
    };
    for (SourceInstance& instance : scene_.instances) {
      if (flat_[instance.prototype] == 0) {
        if (isPlacement(glm::mat4x3(glm::dmat4x3(instance.worldFromMesh)))) {
          kept.push_back(std::move(instance));
          continue;
        }
        if (!showsArea(instance.worldFromMesh)) {
          scene_.ignored.add(
              fmt::format("instances of {} that are shrunk to nothing or not finite", instance.name));
          continue;
        }
      }
      takeMeshes(instance.before);
      SourceMesh mesh = scene_.prototypes[instance.prototype];
      scene_.indexCount += 3 * mesh.triangles.size();
      if (scene_.indexCount > kMaxSceneIndices)
        return fail(ErrorKind::tooLarge,
                    "has more than 2^31 indices in places whose transforms are flat; give them three "
                    "directions, or split it");
      mesh.name = std::move(instance.name);
      applyTransform(mesh, instance.worldFromMesh);
      meshes.push_back(std::move(mesh));
    }
    takeMeshes(scene_.meshes.size());
    scene_.meshes = std::move(meshes);
    scene_.instances = std::move(kept);
    dropUnused();
    return {};
  }

 private:
  /// The fewest triangles first, as long as they fit: a prototype with its instances at once.
  void choose() {
    flat_.assign(scene_.prototypes.size(), 0);
    std::uint64_t placed = 0;
    for (const SourceMesh& mesh : scene_.meshes) placed += mesh.triangles.size();
    std::vector<std::size_t> order(scene_.prototypes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, {}, [&](std::size_t p) { return triangles_[p]; });
    std::uint64_t lamps = 0;
    for (const std::size_t p : order) {
      const bool special = isMirrorOrLamp(scene_.materials[std::size_t(scene_.prototypes[p].material)]);
      if (places_[p] == 1 || placed + triangles_[p] <= most_) {
        flat_[p] = 1, placed += triangles_[p];
      } else if (special && lamps + triangles_[p] <= kMoreOfLamps * most_) {
        flat_[p] = 1, lamps += triangles_[p];
      } else if (special) {
        scene_.ignored.add(fmt::format(
            "plane mirrors and lamps among the {} of {}: they are seen, but light nothing and show only what "
            "is far away",
            counted(triangles_[p], "triangle", "triangles"), scene_.prototypes[p].name));
      }
    }
  }

  void dropUnused() {
    std::vector<std::uint32_t> number(scene_.prototypes.size(), 0);
    for (const SourceInstance& instance : scene_.instances) number[instance.prototype] = 1;
    std::vector<SourceMesh> used;
    for (std::size_t p = 0; p < number.size(); ++p)
      if (number[p] != 0) {
        number[p] = std::uint32_t(used.size());
        used.push_back(std::move(scene_.prototypes[p]));
      }
    scene_.prototypes = std::move(used);
    for (SourceInstance& instance : scene_.instances) instance.prototype = number[instance.prototype];
  }

  SourceScene& scene_;
  std::uint64_t most_;
  std::vector<std::uint64_t> triangles_;  ///< by prototype, of all its instances
  std::vector<std::uint32_t> places_;     ///< by prototype
  std::vector<char> flat_;                ///< by prototype
};

}  // namespace

Status placeInstances(SourceScene& scene, const ImportOptions& options) {
  return Placer(scene, options).place();
}

}  // namespace acentric
