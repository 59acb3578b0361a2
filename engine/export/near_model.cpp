#include "engine/export/near_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/export/bundle_materials.h"
#include "engine/image/colour.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

constexpr int kMostCuts = 32;  ///< of a side, for light
/// Metres: light is finer at the edges of shadows, but vertices take far more room than its samples.
constexpr float kFinestCut = 0.04f;

class Writer {
 public:
  Writer(const WalkScene& walk, const LocalGeometry& local, DrawModel& model)
      : walk_(walk),
        local_(local),
        model_(model),
        meshes_(local.meshes(*walk.scene)),
        first_(firstTrianglesOf(meshes_)) {
    light_ = local.surfaces ? &local.surfaces->light : walk.surfaceLight.get();
    if (light_ != nullptr && light_->empty()) light_ = nullptr;
    for (const Material& material : walk.scene->materials)
      materials_.push_back(localMaterial(material, walk.plan));
  }

  void write() {
    for (const LocalTriangle& triangle : local_.triangles) {
      if (walk_.mirrors && walk_.mirrors->planeOf(local_, triangle) != FlatMirrors::kNoPlane) continue;
      add(triangle, false);
      if (lightOnBack(triangle)) add(triangle, true);
    }
    for (auto& [key, mesh] : out_) {
      finish(mesh, key.first, key.second);
      if (mesh.alpha == AlphaMode::blend)
        blended_.push_back(std::move(mesh));
      else
        model_.meshes.push_back(std::move(mesh));
    }
    std::ranges::move(blended_, std::back_inserter(model_.meshes));
  }

 private:
  /// Sides that are seen by light of their own.
  enum class Sides { both, front, back };

  std::uint32_t numberOf(const LocalTriangle& t) const { return first_[t.mesh] + t.triangle; }
  bool lightOnBack(const LocalTriangle& t) const {
    const std::uint32_t number = numberOf(t);
    return light_ != nullptr && number < light_->hasBack.size() && light_->hasBack[number] != 0;
  }
  const Material& material(const LocalTriangle& t) const {
    return materials_[std::size_t(meshes_[t.mesh].material)];
  }
  bool textured(const LocalTriangle& t) const {
    const TextureUse& use = material(t).baseColourTexture;
    return hasCoordinates(meshes_[t.mesh], use) && TextureSampler(*walk_.scene, use).used();
  }

  /// What the texture is multiplied with so that the product is what is shown, display-linear.
  glm::vec3 factorAt(const LocalTriangle& t, const glm::vec2& b, bool back) const {
    const Mesh& mesh = meshes_[t.mesh];
    const Material& m = material(t);
    const glm::uvec3& corners = mesh.triangles[t.triangle];
    glm::vec3 light(1);
    if (light_ != nullptr && !m.unlit) {
      const std::uint32_t number = numberOf(t);
      light = number < light_->resolution.size() ? light_->at(number, b, back) : glm::vec3(0);
    }
    glm::vec3 base(m.baseColour);
    if (walk_.plan.on(Effect::vertexColours) && !mesh.colours.empty())
      base *= glm::vec3(vertexColourAt(mesh, corners, b));
    const auto sampled = [&](const TextureUse& use) {
      return glm::vec3(sampleColour(*walk_.scene, use, interpolate(coordinatesOf(mesh, use), corners, b)));
    };
    const bool hasTexture = textured(t);
    const glm::vec3 texture = hasTexture ? sampled(m.baseColourTexture) : glm::vec3(1);
    glm::vec3 emission = m.unlit ? glm::vec3(0) : m.emissive;
    if (hasCoordinates(mesh, m.emissiveTexture)) emission *= sampled(m.emissiveTexture);
    constexpr float kDarkest = 1.0F / 64;  // of a texture: below, light would be blown up
    const glm::vec3 shown = toneMap(base * texture * light + emission, walk_.exposure);
    return glm::min(shown / glm::max(texture, glm::vec3(kDarkest)), glm::vec3(1));
  }

  void add(const LocalTriangle& t, bool back) {
    const Mesh& source = meshes_[t.mesh];
    const Sides sides = lightOnBack(t) ? (back ? Sides::back : Sides::front) : Sides::both;
    DrawMesh& mesh = out_[{source.material, sides}];
    std::array<LocalVertex, 3> corners;
    for (int i = 0; i < 3; ++i) corners[std::size_t(i)] = local_.vertices[t.vertices[i]];
    float longest = 0, metres = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const LocalVertex &here = corners[i], &next = corners[(i + 1) % 3];
      const glm::vec2 way = next.barycentric - here.barycentric;
      longest = std::max({longest, std::abs(way.x), std::abs(way.y), std::abs(way.x + way.y)});
      metres = std::max(metres, glm::length(next.position - here.position));
    }
    const std::uint32_t number = numberOf(t);
    const int resolution =
        light_ != nullptr && number < light_->resolution.size() ? int(light_->resolution[number]) : 0;
    const float wanted = std::min(longest * float(resolution), metres / kFinestCut);
    const int cuts = std::clamp(int(std::ceil(wanted)), 1, kMostCuts);
    const TextureUse& use = material(t).baseColourTexture;
    const bool hasTexture = textured(t);
    const auto first = std::uint32_t(mesh.positions.size());
    for (int i = 0; i <= cuts; ++i)
      for (int j = 0; i + j <= cuts; ++j) {
        const float x = float(i) / float(cuts), y = float(j) / float(cuts), rest = 1 - x - y;
        const glm::vec2 b =
            rest * corners[0].barycentric + x * corners[1].barycentric + y * corners[2].barycentric;
        mesh.positions.emplace_back(
            glm::dvec3(rest * corners[0].position + x * corners[1].position + y * corners[2].position) -
            model_.origin);
        mesh.colours.push_back(factorAt(t, b, back));
        mesh.uv.push_back(hasTexture ? use.transform * glm::vec3(interpolate(coordinatesOf(source, use),
                                                                             source.triangles[t.triangle], b),
                                                                 1)
                                     : glm::vec2(0));
      }
    const auto at = [&](int i, int j) {
      return first + surfaceSampleIndex(std::uint32_t(cuts), std::uint32_t(i), std::uint32_t(j));
    };
    const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh.triangles.emplace_back(a, back ? c : b, back ? b : c);
    };
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        emit(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < cuts) emit(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }

  int textureOf(const TextureUse& use) {
    const TextureSampler sampler(*walk_.scene, use);
    if (!use.used() || !sampler.used()) return -1;
    const auto [known, isNew] = textures_.try_emplace(use.texture, int(model_.textures.size()));
    if (isNew)
      model_.textures.push_back({*sampler.image(), sampler.nearest(), sampler.wrapU(), sampler.wrapV()});
    return known->second;
  }

  void finish(DrawMesh& mesh, int number, Sides sides) {
    const Material& m = materials_[std::size_t(number)];
    mesh.part = "near";
    mesh.material = m.name.empty() ? "near " + std::to_string(number) : m.name;
    mesh.texture = textureOf(m.baseColourTexture);
    if (mesh.texture < 0) mesh.uv.clear();
    mesh.doubleSided = sides == Sides::both && m.doubleSided;
    mesh.factor.a = std::clamp(m.baseColour.a, 0.0F, 1.0F);
    mesh.alpha = m.alphaMode, mesh.cutoff = m.alphaCutoff;
    if (m.transmission > 0 && !m.unlit) {
      mesh.alpha = AlphaMode::blend;
      mesh.factor.a *= std::max(0.0F, 1 - m.transmission);
    }
  }

  const WalkScene& walk_;
  const LocalGeometry& local_;
  DrawModel& model_;
  const std::vector<Mesh>& meshes_;
  std::vector<std::uint32_t> first_;
  const SurfaceLight* light_ = nullptr;
  std::vector<Material> materials_;
  std::map<std::pair<int, Sides>, DrawMesh> out_;  ///< by material
  std::vector<DrawMesh> blended_;
  std::map<int, int> textures_;  ///< by texture of the scene
};

}  // namespace

std::size_t addNear(const WalkScene& walk, const LocalGeometry& local, DrawModel& model) {
  const std::size_t before = model.meshes.size();
  Writer(walk, local, model).write();
  std::size_t triangles = 0;
  for (std::size_t i = before; i < model.meshes.size(); ++i) triangles += model.meshes[i].triangles.size();
  return triangles;
}

}  // namespace acentric
