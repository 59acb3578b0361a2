#include "engine/scene/emitters.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "engine/image/colour.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

constexpr float kLeastShare = 0.01f;
/// Places within a triangle per edge at which its texture is read.
constexpr int kTextureGrid = 6;

/// On a surface that faces everything at once, nothing in between, a quarter of the scene's size from lamps.
float typicalIrradiance(const Scene& scene, float size) {
  const float lampDistance = 0.25f * size;
  float sum =
      glm::pi<float>() * luminance(scene.sky.zenith + 2.0f * scene.sky.horizon + scene.sky.ground) / 4;
  for (const Light& light : scene.lights) {
    const float strength = luminance(light.colour) * light.intensity;
    sum += light.kind == LightKind::directional ? strength
           : lampDistance > 0                   ? strength / (lampDistance * lampDistance)
                                                : 0;
  }
  return sum;
}

/// Facing a disc of this area and mean radiance from `distance`, on its axis.
float irradianceFromMesh(const Scene& scene, const Mesh& mesh, float distance) {
  double area = 0, strength = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& c = mesh.triangles[t];
    const double part = 0.5 * double(glm::length(glm::cross(mesh.positions[c.y] - mesh.positions[c.x],
                                                            mesh.positions[c.z] - mesh.positions[c.x])));
    area += part;
    strength += part * double(luminance(meanEmission(scene, mesh, t)));
  }
  const double reach = area + double(glm::pi<float>() * distance * distance);
  return reach > 0 ? float(double(glm::pi<float>()) * strength / reach) : 0;
}

}  // namespace

glm::vec3 meanEmission(const Scene& scene, const Mesh& mesh, std::uint32_t triangle) {
  const Material& material = scene.materials[std::size_t(mesh.material)];
  const TextureUse& use = material.emissiveTexture;
  if (!hasCoordinates(mesh, use)) return material.emissive;
  const auto& uv = coordinatesOf(mesh, use);
  const glm::uvec3& corners = mesh.triangles[triangle];
  glm::vec3 sum(0);
  int count = 0;
  for (int i = 0; i < kTextureGrid; ++i)
    for (int j = 0; i + j < kTextureGrid; ++j, ++count) {
      const glm::vec2 b((float(i) + 1.0f / 3) / kTextureGrid, (float(j) + 1.0f / 3) / kTextureGrid);
      sum += glm::vec3(sampleColour(
          scene, use, uv[corners.x] * (1 - b.x - b.y) + uv[corners.y] * b.x + uv[corners.z] * b.y));
    }
  return material.emissive * sum / float(count);
}

std::vector<std::uint8_t> lightingMeshes(const Scene& scene) {
  std::vector<std::uint8_t> lighting(scene.meshes.size(), 0);
  std::vector<float> irradiance(scene.meshes.size(), 0);
  const float size = glm::length(boundsOf(scene).size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (mesh.triangles.empty() || material.unlit || material.emissive == glm::vec3(0)) continue;
    irradiance[m] = irradianceFromMesh(scene, mesh, size / 20);
  }
  float typical = typicalIrradiance(scene, size);
  for (const float each : irradiance) typical = std::max(typical, each);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    lighting[m] = irradiance[m] > 0 && irradiance[m] >= kLeastShare * typical ? 1 : 0;
  return lighting;
}

}  // namespace acentric
