#include "engine/bake/surface.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/mesh_attributes.h"
#include "engine/scene/placed_mesh.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

/// Reads the textures of a triangle at a place on it, or over an area around that.
class TextureReader {
 public:
  TextureReader(const Scene& scene, const Mesh& mesh, const glm::uvec3& corners, const glm::vec2& barycentric,
                const TextureArea* area)
      : scene_(scene), mesh_(mesh), corners_(corners), barycentric_(barycentric), area_(area) {}

  /// Is there one, and has the mesh coordinates for it?
  bool has(const TextureUse& use) const { return hasCoordinates(mesh_, use); }
  glm::vec4 read(const TextureUse& use, TexelKind kind) const {
    const auto& uv = coordinatesOf(mesh_, use);
    if (area_ != nullptr)
      return area_->mean(scene_, use, kind, glm::mat3x2(uv[corners_.x], uv[corners_.y], uv[corners_.z]));
    const glm::vec2 at = interpolate(uv, corners_, barycentric_);
    return kind == TexelKind::data ? sampleLinear(scene_, use, at) : sampleColour(scene_, use, at);
  }

 private:
  const Scene& scene_;
  const Mesh& mesh_;
  glm::uvec3 corners_;
  glm::vec2 barycentric_;
  const TextureArea* area_;
};

/// How far the interpolated point may lie off its triangle's plane, generously: rounding is relative to the
/// corners' coordinates axis by axis (so an axis-aligned wall has next to none across itself, however long it
/// is), and never nothing, since a ray that starts on the plane itself would hit it.
float leaveDistance(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& normal) {
  constexpr float kRounding = 16.0f / (1 << 24);
  const glm::vec3 largest = glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c));
  const glm::vec3 extent = glm::max(glm::max(glm::abs(b - a), glm::abs(c - a)), glm::abs(c - b));
  const float longest = std::max(extent.x, std::max(extent.y, extent.z));
  return kRounding * glm::dot(glm::abs(normal), largest) + 1e-8f * longest;
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise) {
  const float square = glm::dot(v, v);
  return square > 0 && std::isfinite(square) ? v / std::sqrt(square) : otherwise;
}

glm::vec3 mappedNormal(const TextureReader& textures, const PlacedMesh& placed, const Material& material,
                       const glm::uvec3& corners, const glm::vec2& b, const glm::vec3& normal) {
  if (placed.mesh().tangents.empty() || !textures.has(material.normalTexture)) return normal;
  const glm::vec4 tangent = placed.tangent(corners.x) * (1 - b.x - b.y) + placed.tangent(corners.y) * b.x +
                            placed.tangent(corners.z) * b.y;
  const glm::vec3 flat = glm::vec3(tangent) - normal * glm::dot(normal, glm::vec3(tangent));
  const glm::vec3 t = unitOr(flat, glm::vec3(0));
  if (t == glm::vec3(0)) return normal;
  const glm::vec3 bitangent = glm::cross(normal, t) * (tangent.w < 0 ? -1.0f : 1.0f);
  const glm::vec3 stored = 2.0f * glm::vec3(textures.read(material.normalTexture, TexelKind::data)) - 1.0f;
  const glm::vec2 slope = material.normalScale * glm::vec2(stored);
  return unitOr(t * slope.x + bitangent * slope.y + normal * stored.z, normal);
}

glm::vec4 baseColourOf(const TextureReader& textures, const Mesh& mesh, const Material& material,
                       const glm::uvec3& corners, const glm::vec2& b, const DetailRules& detail) {
  glm::vec4 colour = material.baseColour;
  if (detail.textures && textures.has(material.baseColourTexture))
    colour *= textures.read(material.baseColourTexture, baseColourKind(material));
  if (detail.vertexColours && !mesh.colours.empty()) colour *= vertexColourAt(mesh, corners, b);
  return colour;
}

}  // namespace

glm::vec4 baseColourAt(const Scene& scene, const Mesh& mesh, std::uint32_t triangle,
                       const glm::vec2& barycentric, const DetailRules& detail) {
  const glm::uvec3& corners = mesh.triangles[triangle];
  return baseColourOf({scene, mesh, corners, barycentric, nullptr}, mesh,
                      scene.materials[std::size_t(mesh.material)], corners, barycentric, detail);
}

template <bool kDetail>
Surface surfaceAt(const Scene& scene, const Hit& hit, const glm::vec3& toViewer, const DetailRules& detail,
                  bool emission, const TextureArea* area) {
  const PlacedMesh placed(scene, hit.mesh);
  const Mesh& mesh = placed.mesh();
  const Material& material = scene.materials[std::size_t(mesh.material)];
  const glm::uvec3& corners = mesh.triangles[hit.triangle];
  const glm::vec2& b = hit.barycentric;

  const glm::vec3 wound = hit.geometricNormal();
  Surface surface;
  const auto at = placed.corners(hit.triangle);
  surface.position = at[0] * (1 - b.x - b.y) + at[1] * b.x + at[2] * b.y;
  const bool front = glm::dot(wound, toViewer) >= 0;
  surface.geometricNormal = front ? wound : -wound;
  surface.rayOrigin =
      surface.position +
      surface.geometricNormal * (leaveDistance(at[0], at[1], at[2], wound) + placed.rounding(at[0], wound));
  glm::vec3 normal = wound;
  if (!mesh.normals.empty())
    normal = unitOr(placed.normal(corners.x) * (1 - b.x - b.y) + placed.normal(corners.y) * b.x +
                        placed.normal(corners.z) * b.y,
                    normal);
  surface.metallic = material.metallic;
  surface.roughness = material.roughness;
  if (emission) surface.emission = material.emissive;

  if constexpr (kDetail) {
    const TextureReader textures(scene, mesh, corners, b, area);
    if (detail.normalMaps) normal = mappedNormal(textures, placed, material, corners, b, normal);
    surface.baseColour = baseColourOf(textures, mesh, material, corners, b, detail);
    if (detail.textures && textures.has(material.metallicRoughnessTexture)) {
      const glm::vec4 stored = textures.read(material.metallicRoughnessTexture, TexelKind::data);
      surface.roughness *= stored.g;
      surface.metallic *= stored.b;
    }
    if (emission && detail.textures && textures.has(material.emissiveTexture))
      surface.emission *= glm::vec3(textures.read(material.emissiveTexture, TexelKind::colour));
  } else {
    surface.baseColour = material.baseColour;
  }
  // Back sides, and normals that a file stores against its winding: shade the side that is seen.
  surface.normal = glm::dot(normal, surface.geometricNormal) >= 0 ? normal : -normal;
  return surface;
}

template Surface surfaceAt<true>(const Scene&, const Hit&, const glm::vec3&, const DetailRules&, bool,
                                 const TextureArea*);
template Surface surfaceAt<false>(const Scene&, const Hit&, const glm::vec3&, const DetailRules&, bool,
                                  const TextureArea*);

}  // namespace acentric
