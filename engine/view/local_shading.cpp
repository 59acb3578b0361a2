#include "engine/view/local_shading.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/mesh_attributes.h"
#include "engine/scene/surface_alpha.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

static_assert(int(TextureWrap::repeat) == int(Wrap::repeat) && int(TextureWrap::clamp) == int(Wrap::clamp) &&
              int(TextureWrap::mirror) == int(Wrap::mirror));
static_assert(sizeof(Rgba8) == sizeof(std::uint32_t) && sizeof(HalfColour) == 2 * sizeof(std::uint32_t));

glm::vec4 sampleAt(const Scene& scene, const Mesh& mesh, const TextureUse& use, const LocalPoint& point) {
  return sampleColour(
      scene, use, interpolate(coordinatesOf(mesh, use), mesh.triangles[point.triangle], point.barycentric));
}

/// Unit normal on the side of `toEye`.
glm::vec3 normalTowards(const Mesh& mesh, const LocalPoint& point, const glm::vec3& toEye) {
  const glm::uvec3& corners = mesh.triangles[point.triangle];
  glm::vec3 normal(0);
  if (!mesh.normals.empty()) normal = interpolate(mesh.normals, corners, point.barycentric);
  if (!(glm::dot(normal, normal) > 0))
    normal = glm::cross(mesh.positions[corners.y] - mesh.positions[corners.x],
                        mesh.positions[corners.z] - mesh.positions[corners.x]);
  const float length = glm::length(normal);
  if (!(length > 0)) return toEye;
  normal /= length;
  return glm::dot(normal, toEye) < 0 ? -normal : normal;
}

template <class From, class To>
void copy(const From& from, To& to) {
  for (int i = 0; i < from.length() && i < int(std::size(to)); ++i) to[i] = from[i];
}

}  // namespace

LocalShading::LocalShading(const WalkScene& scene)
    : scene_(scene.scene.get()),
      meshes_(&scene_->meshes),
      light_(scene.surfaceLight != nullptr && !scene.surfaceLight->empty() ? scene.surfaceLight.get()
                                                                           : nullptr),
      exposure_(scene.exposure),
      firstTriangles_(scene_->firstTriangles()) {
  const EffectPlan& plan = scene.plan;
  for (const Material& m : scene_->materials) {
    LocalMaterial local;
    local.material = &m;
    local.unlit = plan.on(Effect::unlit) && m.unlit;
    local.textured = plan.on(Effect::textures) && m.baseColourTexture.used();
    local.vertexColours = plan.on(Effect::vertexColours);
    local.masked = plan.on(Effect::alphaTest) && m.alphaMode == AlphaMode::mask;
    local.blended = plan.on(Effect::alphaBlend) && m.alphaMode == AlphaMode::blend;
    local.transmissive = plan.on(Effect::transmission) && m.transmission > 0 && !local.unlit;
    local.emits = plan.on(Effect::emission) && m.emissive != glm::vec3(0) && !local.unlit;
    local.emissionTextured = local.emits && plan.on(Effect::textures) && m.emissiveTexture.used();
    materials_.push_back(local);
  }
}

LocalShading::LocalShading(const WalkScene& scene, const LocalGeometry& local) : LocalShading(scene) {
  if (!local.surfaces) return;
  meshes_ = &local.surfaces->meshes;
  light_ = local.surfaces->light.empty() ? nullptr : &local.surfaces->light;
  firstTriangles_ = firstTrianglesOf(*meshes_);
}

bool LocalShading::hasLightOnBack(std::uint32_t mesh, std::uint32_t triangle) const {
  const std::size_t number = firstTriangles_[mesh] + triangle;
  return light_ != nullptr && number < light_->hasBack.size() && light_->hasBack[number] != 0;
}

int LocalShading::lightResolution(std::uint32_t mesh, std::uint32_t triangle) const {
  const std::size_t number = firstTriangles_[mesh] + triangle;
  return light_ != nullptr && number < light_->resolution.size() ? int(light_->resolution[number]) : 0;
}

glm::vec4 LocalShading::baseColourAt(const LocalMaterial& material, const Mesh& mesh,
                                     const LocalPoint& point) const {
  glm::vec4 colour = material.material->baseColour;
  if (material.textured && hasCoordinates(mesh, material.material->baseColourTexture))
    colour *= sampleAt(*scene_, mesh, material.material->baseColourTexture, point);
  if (material.vertexColours && !mesh.colours.empty())
    colour *= vertexColourAt(mesh, mesh.triangles[point.triangle], point.barycentric);
  return colour;
}

bool LocalShading::survivesMask(const LocalPoint& point) const {
  const LocalMaterial& material = materialOf(point.mesh);
  return baseColourAt(material, (*meshes_)[point.mesh], point).a >= material.material->alphaCutoff;
}

float LocalShading::alphaAt(const LocalPoint& point) const {
  const LocalMaterial& material = materialOf(point.mesh);
  if (!material.masked && !material.blended) return 1;
  return std::clamp(baseColourAt(material, (*meshes_)[point.mesh], point).a, 0.0f, 1.0f);
}

Rgba8 LocalShading::colourAt(const LocalPoint& point, const glm::vec3& eye) const {
  const glm::vec4 shown = shownAt(point, eye);
  return encodeShown(glm::vec3(shown), shown.a);
}

glm::vec4 LocalShading::shownAt(const LocalPoint& point, const glm::vec3& eye) const {
  const Mesh& mesh = (*meshes_)[point.mesh];
  const LocalMaterial& material = materialOf(point.mesh);
  const glm::vec4 base = baseColourAt(material, mesh, point);

  glm::vec3 light(1);
  const std::uint32_t triangle = firstTriangles_[point.mesh] + point.triangle;
  if (light_ != nullptr && !material.unlit) {
    light = triangle < light_->resolution.size()
                ? light_->at(triangle, point.barycentric,
                             point.back && hasLightOnBack(point.mesh, point.triangle))
                : glm::vec3(0);
  }
  glm::vec3 radiance = glm::vec3(base) * light;
  if (material.emits) {
    glm::vec3 emission = material.material->emissive;
    if (material.emissionTextured && hasCoordinates(mesh, material.material->emissiveTexture))
      emission *= glm::vec3(sampleAt(*scene_, mesh, material.material->emissiveTexture, point));
    radiance += emission;
  }

  float alpha = 1;
  if (material.blended) alpha = std::clamp(base.a, 0.0f, 1.0f);
  if (material.transmissive) {
    const glm::vec3 at = interpolate(mesh.positions, mesh.triangles[point.triangle], point.barycentric);
    const glm::vec3 offset = eye - at;
    const float distance = glm::length(offset);
    const glm::vec3 toEye = distance > 0 ? offset / distance : glm::vec3(0, 0, 1);
    const float cosine = glm::dot(normalTowards(mesh, point, toEye), toEye);
    alpha *= glassAlpha(material.material->transmission, glm::vec3(base), cosine).alpha();
  }
  return {toneMap(radiance, exposure_), alpha};
}

std::optional<SurfaceShade> LocalShading::triangle(const std::array<LocalPoint, 3>& corners) const {
  if (materialOf(corners[0].mesh).clear()) return {};
  return surfaceOf(corners);
}

std::optional<ClearShade> LocalShading::clearTriangle(const std::array<LocalPoint, 3>& corners,
                                                      const glm::vec3& eye) const {
  const Mesh& mesh = (*meshes_)[corners[0].mesh];
  const LocalMaterial& material = materialOf(corners[0].mesh);
  if (!material.clear() || material.masked || (material.blended && material.textured)) return {};
  const auto surface = surfaceOf(corners);
  if (!surface) return {};
  ClearShade shade;
  shade.surface = *surface;
  if (material.blended) shade.opacity = std::clamp(material.material->baseColour.a, 0.0f, 1.0f);
  shade.glass = material.transmissive;
  shade.transmission = material.material->transmission;
  const glm::uvec3& triangle = mesh.triangles[corners[0].triangle];
  const glm::vec3 flat = glm::cross(mesh.positions[triangle.y] - mesh.positions[triangle.x],
                                    mesh.positions[triangle.z] - mesh.positions[triangle.x]);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec2& at = corners[i].barycentric;
    copy(mesh.normals.empty() ? flat : interpolate(mesh.normals, triangle, at), shade.normal[i]);
    copy(eye - interpolate(mesh.positions, triangle, at), shade.toEye[i]);
  }
  return shade;
}

std::optional<SurfaceShade> LocalShading::surfaceOf(const std::array<LocalPoint, 3>& corners) const {
  const LocalPoint& point = corners[0];
  const Mesh& mesh = (*meshes_)[point.mesh];
  const LocalMaterial& material = materialOf(point.mesh);
  const Material& m = *material.material;
  if (material.emissionTextured || (material.vertexColours && !mesh.colours.empty())) return {};
  SurfaceShade shade;
  copy(m.baseColour, shade.colour);
  if (material.emits) copy(m.emissive, shade.emission);
  shade.exposure = exposure_;
  shade.linearFromSrgb = linearFromSrgbTable().data();
  const DisplayCodes codes = displayCodes();
  shade.threshold = codes.threshold, shade.firstCode = codes.firstCode;
  const TextureUse& use = m.baseColourTexture;
  const TextureSampler texture(*scene_, use);
  if (material.textured && hasCoordinates(mesh, use) && texture.used()) {
    const ColourImage& image = *texture.image();
    shade.texels = reinterpret_cast<const std::uint32_t*>(image.pixels.data());
    shade.width = image.width, shade.height = image.height;
    shade.wrapU = static_cast<TextureWrap>(texture.wrapU());
    shade.wrapV = static_cast<TextureWrap>(texture.wrapV());
    shade.nearest = texture.nearest();
    for (std::size_t i = 0; i < 3; ++i)
      copy(use.transform * glm::vec3(interpolate(coordinatesOf(mesh, use), mesh.triangles[point.triangle],
                                                 corners[i].barycentric),
                                     1),
           shade.uv[i]);
  }
  if (light_ == nullptr || material.unlit) return shade;
  for (std::size_t i = 0; i < 3; ++i) copy(corners[i].barycentric, shade.barycentric[i]);
  const std::uint32_t triangle = firstTriangles_[point.mesh] + point.triangle;
  const HalfColour* light = light_->light.data();
  if (triangle < light_->resolution.size() && light_->resolution[triangle] > 0) {
    if (light_->resolution[triangle] > SurfaceShade::kMaxResolution) return {};
    shade.resolution = light_->resolution[triangle];
    light = light_->samplesOf(triangle, point.back && hasLightOnBack(point.mesh, point.triangle));
  }
  shade.light = reinterpret_cast<const std::uint32_t*>(light);
  return shade;
}

}  // namespace acentric
