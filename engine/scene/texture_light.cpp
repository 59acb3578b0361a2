#include "engine/scene/texture_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace acentric {
namespace {

constexpr std::size_t kFewestTriangles = 500;  // a hand-made box with a photograph on it is no scan
constexpr double kEven = 8;  // edges of the large triangles, in those of the small ones: tenth and ninetieth
constexpr double kLeastShare = 0.98;   // of the area, that has nothing but colours
constexpr double kUsedOnce = 1.25;     // area of all parts on a picture, in that of what they cover
constexpr double kAtlasMargin = 0.01;  // that texture coordinates may lie outside the picture
constexpr int kAtlasCells = 512;       // along a picture's side
constexpr std::size_t kManyColours = 64;

bool hasColoursOnly(const Scene& scene, const Mesh& mesh) {
  const Material& m = scene.materials[std::size_t(mesh.material)];
  if (m.normalTexture.used() || m.metallicRoughnessTexture.used() || m.emissive != glm::vec3(0) ||
      m.transmission > 0 || m.alphaMode == AlphaMode::blend)
    return false;
  return m.baseColourTexture.used() || !mesh.colours.empty();
}

double areaOf(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Which parts of a picture triangles are cut from.
class Atlas {
 public:
  Atlas() : cells_(std::size_t(kAtlasCells) * kAtlasCells, 0) {}

  /// False if it reaches out of the picture: a pattern that is repeated.
  bool add(const std::array<glm::dvec2, 3>& corners) {
    glm::dvec2 low(2), high(-1);
    for (const glm::dvec2& p : corners) low = glm::min(low, p), high = glm::max(high, p);
    if (!(low.x >= -kAtlasMargin && low.y >= -kAtlasMargin && high.x <= 1 + kAtlasMargin &&
          high.y <= 1 + kAtlasMargin))
      return false;
    const glm::dvec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
    used_ += 0.5 * std::abs(u.x * v.y - u.y * v.x) * kAtlasCells * kAtlasCells;
    cover(corners, low, high);
    return true;
  }

  bool usedOnce() const {
    const auto covered = double(std::ranges::count(cells_, 1));
    return covered > 0 && used_ <= kUsedOnce * covered;
  }

 private:
  /// The cells whose middles lie in it; a small one has that of its own middle.
  void cover(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& low, const glm::dvec2& high) {
    const auto cellOf = [](double at) {
      return std::clamp(static_cast<int>(at * kAtlasCells), 0, kAtlasCells - 1);
    };
    const auto mark = [&](int x, int y) { cells_[std::size_t(y) * kAtlasCells + std::size_t(x)] = 1; };
    const glm::dvec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    mark(cellOf(middle.x), cellOf(middle.y));
    for (int y = cellOf(low.y); y <= cellOf(high.y); ++y)
      for (int x = cellOf(low.x); x <= cellOf(high.x); ++x) {
        const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) / double(kAtlasCells);
        int left = 0, right = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec2 edge = corners[(k + 1) % 3] - corners[k], to = at - corners[k];
          const double side = edge.x * to.y - edge.y * to.x;
          left += side >= 0, right += side <= 0;
        }
        if (left == 3 || right == 3) mark(x, y);
      }
  }

  std::vector<std::uint8_t> cells_;
  double used_ = 0;  ///< cells
};

/// Each part of each picture is used once; false where one is not.
bool picturesUsedOnce(const Scene& scene) {
  std::map<int, Atlas> atlases;  // by image
  for (const Mesh& mesh : scene.meshes) {
    const TextureUse& use = scene.materials[std::size_t(mesh.material)].baseColourTexture;
    if (!use.used()) continue;
    const auto& uv = mesh.uv[use.uvSet];
    if (uv.empty()) return false;
    Atlas& atlas = atlases[scene.textures[std::size_t(use.texture)].image];
    for (const glm::uvec3& t : mesh.triangles) {
      const auto at = [&](unsigned corner) { return glm::dvec2(use.transform * glm::vec3(uv[corner], 1)); };
      if (!atlas.add({at(t.x), at(t.y), at(t.z)})) return false;
    }
  }
  return std::ranges::all_of(atlases, [](const auto& entry) { return entry.second.usedOnce(); });
}

/// Of what has no picture: as many colours as measuring gives, not those of a palette.
bool coloursMeasured(const Scene& scene) {
  std::set<std::array<std::uint8_t, 3>> seen;
  bool any = false;
  for (const Mesh& mesh : scene.meshes) {
    if (scene.materials[std::size_t(mesh.material)].baseColourTexture.used()) continue;
    any = true;
    for (const glm::u8vec4& c : mesh.colours) {
      seen.insert({c.r, c.g, c.b});
      if (seen.size() >= kManyColours) return true;
    }
  }
  return !any;
}

bool evenlySized(const Scene& scene) {
  std::vector<double> areas;
  for (const Mesh& mesh : scene.meshes)
    for (const glm::uvec3& t : mesh.triangles) areas.push_back(areaOf(mesh, t));
  if (areas.size() < kFewestTriangles) return false;
  const auto at = [&](double share) {
    const auto place = areas.begin() + std::ptrdiff_t(share * double(areas.size() - 1));
    std::ranges::nth_element(areas, place);
    return *place;
  };
  const double small = at(0.1), large = at(0.9);
  return large <= kEven * kEven * small;
}

bool shines(const Light& light) { return light.intensity > 0 && light.colour != glm::vec3(0); }

}  // namespace

std::optional<std::string> whyLightIsInTextures(const Scene& scene) {
  if (std::ranges::any_of(scene.lights, shines)) return std::nullopt;
  if (!scene.instances.empty()) return std::nullopt;  // no scan shows one thing in many places
  double all = 0, plain = 0;
  std::set<int> pictures;
  for (const Mesh& mesh : scene.meshes) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) area += areaOf(mesh, t);
    all += area;
    if (hasColoursOnly(scene, mesh)) plain += area;
    const TextureUse& use = scene.materials[std::size_t(mesh.material)].baseColourTexture;
    if (use.used()) pictures.insert(scene.textures[std::size_t(use.texture)].image);
  }
  if (!(all > 0 && plain >= kLeastShare * all)) return std::nullopt;
  if (!evenlySized(scene) || !coloursMeasured(scene) || !picturesUsedOnce(scene)) return std::nullopt;
  const std::string colours =
      pictures.empty() ? std::string("surfaces have measured colours only")
                       : fmt::format("surfaces have only {}, each part used once",
                                     pictures.size() == 1 ? std::string("one picture")
                                                          : fmt::format("{} pictures", pictures.size()));
  return colours + ", triangles are of about one size, there is no lamp: as in a scan";
}

bool applyLighting(Scene& scene, Lighting lighting, ReportLines& guessed) {
  std::vector<bool> used(scene.materials.size());
  for (const auto* meshes : {&scene.meshes, &scene.prototypes})
    for (const Mesh& mesh : *meshes) used[std::size_t(mesh.material)] = true;
  std::size_t declared = 0;  // unlit
  for (std::size_t m = 0; m < used.size(); ++m) declared += used[m] && scene.materials[m].unlit ? 1 : 0;
  const bool allDeclared = declared > 0 && declared == std::size_t(std::ranges::count(used, true));
  const auto setUnlit = [&](bool unlit) {
    for (Material& material : scene.materials) material.unlit = unlit;
  };
  if (lighting == Lighting::computed) {
    if (declared > 0)
      guessed.add(fmt::format("light: computed, as chosen, for {} that the file declares unlit",
                              counted(declared, "material", "materials")));
    setUnlit(false);
    return false;
  }
  if (lighting == Lighting::inTextures) {
    setUnlit(true);
    return true;
  }
  if (allDeclared) {
    guessed.add("light: in the textures already (the file declares every material unlit)");
    return false;
  }
  const auto why = whyLightIsInTextures(scene);
  if (!why) return false;
  guessed.add(fmt::format("light: in the textures already ({}); it is not computed once more", *why));
  setUnlit(true);
  return true;
}

}  // namespace acentric
