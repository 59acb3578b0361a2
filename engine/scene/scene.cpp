#include "engine/scene/scene.h"

#include "engine/base/contract.h"
#include "engine/scene/instances.h"

namespace acentric {
namespace {

void addVector(Hasher& hasher, const float* values, int count) {
  for (int i = 0; i < count; ++i) hasher.value(values[i]);
}

void add(Hasher& hasher, const TextureUse& use) {
  hasher.value(use.texture).value(use.uvSet);
  for (int column = 0; column < 3; ++column) addVector(hasher, &use.transform[column].x, 2);
}

void add(Hasher& hasher, const Material& m) {
  addVector(hasher, &m.baseColour.x, 4);
  add(hasher, m.baseColourTexture);
  addVector(hasher, &m.emissive.x, 3);
  add(hasher, m.emissiveTexture);
  hasher.value(m.metallic).value(m.roughness);
  add(hasher, m.metallicRoughnessTexture);
  add(hasher, m.normalTexture);
  hasher.value(m.normalScale).value(m.transmission).value(m.alphaMode).value(m.alphaCutoff);
  hasher.value(m.doubleSided).value(m.unlit);
}

template <class Array>
void addArray(Hasher& hasher, const Array& values) {
  hasher.array(std::span<const typename Array::value_type>(values));
}

void add(Hasher& hasher, const Mesh& mesh) {
  hasher.value(mesh.material);
  addArray(hasher, mesh.positions);
  addArray(hasher, mesh.normals);
  addArray(hasher, mesh.tangents);
  addArray(hasher, mesh.uv[0]);
  addArray(hasher, mesh.uv[1]);
  addArray(hasher, mesh.colours);
  addArray(hasher, mesh.triangles);
}

void add(Hasher& hasher, const Light& light) {
  hasher.value(light.kind).value(light.intensity);
  addVector(hasher, &light.colour.x, 3);
  addVector(hasher, &light.position.x, 3);
  addVector(hasher, &light.direction.x, 3);
  hasher.value(light.range).value(light.innerCone).value(light.outerCone);
  hasher.value(light.radius).value(light.angularRadius);
}

}  // namespace

std::size_t Scene::triangleCount() const {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

std::uint64_t Scene::instancedTriangleCount() const {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) count += prototypes[instance.prototype].triangles.size();
  return count;
}

std::uint64_t Scene::prototypeTriangleCount() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : prototypes) count += mesh.triangles.size();
  return count;
}

std::vector<std::uint32_t> Scene::firstTriangles() const { return firstTrianglesOf(meshes); }

std::vector<std::uint32_t> firstTrianglesOf(const std::vector<Mesh>& meshes) {
  std::vector<std::uint32_t> first;
  first.reserve(meshes.size() + 1);
  std::size_t next = 0;
  for (const Mesh& mesh : meshes) {
    first.push_back(std::uint32_t(next));
    next += mesh.triangles.size();
  }
  require(next <= std::numeric_limits<std::uint32_t>::max(), "a scene has less than 2^32 triangles");
  first.push_back(std::uint32_t(next));
  return first;
}

SceneParts partsOf(const Scene& scene) {
  Hasher geometry, materials, lights;
  geometry.value(scene.origin.x).value(scene.origin.y).value(scene.origin.z);
  geometry.value(std::uint64_t(scene.meshes.size()));
  for (const Mesh& mesh : scene.meshes) add(geometry, mesh);
  if (!scene.instances.empty()) {  // scenes without any keep the keys that they had before there were some
    geometry.text("instances").value(std::uint64_t(scene.prototypes.size()));
    for (const Mesh& mesh : scene.prototypes) add(geometry, mesh);
    geometry.value(std::uint64_t(scene.instances.size()));
    for (const Instance& instance : scene.instances) {
      geometry.value(instance.prototype);
      addVector(geometry, &instance.worldFromPrototype[0].x, 12);
    }
  }
  materials.value(std::uint64_t(scene.materials.size()));
  for (const Material& material : scene.materials) add(materials, material);
  materials.value(std::uint64_t(scene.textures.size()));
  for (const Texture& texture : scene.textures)
    materials.value(texture.image).value(texture.wrapU).value(texture.wrapV).value(texture.nearest);
  materials.value(std::uint64_t(scene.images.size()));
  for (const auto& image : scene.images) {
    materials.value(image ? image->width : 0).value(image ? image->height : 0);
    if (image) addArray(materials, image->pixels);
  }
  lights.value(std::uint64_t(scene.lights.size()));
  for (const Light& light : scene.lights) add(lights, light);
  addVector(lights, &scene.sky.zenith.x, 3);
  addVector(lights, &scene.sky.horizon.x, 3);
  addVector(lights, &scene.sky.ground.x, 3);
  return {geometry.finish(), materials.finish(), lights.finish()};
}

ContentKey keyOf(const SceneParts& parts) {
  Hasher hasher;
  hasher.text("acentric scene 2");
  for (const ContentKey& part : {parts.geometry, parts.materials, parts.lights})
    hasher.value(part.high).value(part.low);
  return hasher.finish();
}

ContentKey keyOf(const Scene& scene) { return keyOf(partsOf(scene)); }

Bounds boundsOf(const Scene& scene) {
  Bounds bounds;
  for (const Mesh& mesh : scene.meshes)
    for (const glm::uvec3& triangle : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) bounds.add(mesh.positions[triangle[corner]]);
  addInstances(scene, bounds);
  return bounds;
}

}  // namespace acentric
