#pragma once
/// Scene: everything imported from a model file, as one immutable value shared by all stages.
/// Metres, Z up, positions relative to `origin` (project origin, double). Node transforms are applied. What
/// stands in very many places is kept once, as a prototype, with an instance for each place (instances.h says
/// which code sees what).

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/image/image.h"
#include "engine/image/sky.h"
#include "engine/scene/mesh_array.h"

namespace acentric {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

struct Texture {
  std::string name;
  int image = -1;  ///< index into Scene::images
  Wrap wrapU = Wrap::repeat;
  Wrap wrapV = Wrap::repeat;
  bool nearest = false;  ///< magnification filter: nearest instead of linear
};

/// Which texture, read at uv' = transform * (u, v, 1).
struct TextureUse {
  int texture = -1;        ///< index into Scene::textures; -1 = none
  std::uint8_t uvSet = 0;  ///< 0 or 1
  glm::mat3x2 transform{1, 0, 0, 1, 0, 0};
  bool used() const { return texture >= 0; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF 2.0 metallic-roughness, with the extensions named. Colours are linear.
struct Material {
  std::string name;
  glm::vec4 baseColour{1};       ///< linear, alpha straight
  TextureUse baseColourTexture;  ///< sRGB
  glm::vec3 emissive{0};         ///< linear, strength (KHR_materials_emissive_strength) multiplied in
  TextureUse emissiveTexture;    ///< sRGB
  float metallic = 1;
  float roughness = 1;
  TextureUse metallicRoughnessTexture;  ///< G roughness, B metallic, linear
  TextureUse normalTexture;             ///< tangent space, linear
  float normalScale = 1;
  float transmission = 0;  ///< KHR_materials_transmission
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  bool unlit = false;  ///< KHR_materials_unlit
};

/// Triangles of one material. Optional arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  int material = 0;  ///< index into Scene::materials (always valid)
  MeshArray<glm::vec3> positions;
  MeshArray<glm::vec3> normals;   ///< unit; always filled by import (from the file, else made flat)
  MeshArray<glm::vec4> tangents;  ///< xyz unit, w = handedness; filled only where a normal texture needs it
  MeshArray<glm::vec2> uv[2];
  MeshArray<glm::u8vec4> colours;   ///< linear RGBA8 vertex colours
  MeshArray<glm::uvec3> triangles;  ///< counter-clockwise = front, indices valid, no degenerate ones
};

/// A place where a prototype stands.
struct Instance {
  std::uint32_t prototype = 0;        ///< index into Scene::prototypes
  glm::mat4x3 worldFromPrototype{1};  ///< invertible; a negative determinant mirrors it
};

enum class LightKind : std::uint8_t { directional, point, spot };

/// KHR_lights_punctual.
struct Light {
  std::string name;
  LightKind kind = LightKind::directional;
  glm::vec3 colour{1};  ///< linear
  float intensity = 1;  ///< lux (directional) or candela (point, spot)
  glm::vec3 position{0};
  glm::vec3 direction{0, 0, -1};  ///< unit, the way the light travels
  float range = 0;                ///< metres, 0 = unlimited
  float innerCone = 0;            ///< radians
  float outerCone = 0.785398f;
  /// Size, which softens shadows; 0 = none. glTF has no word for it: read from the light's extras, see
  /// docs/light.md.
  float radius = 0;         ///< metres, of a point or spot light
  float angularRadius = 0;  ///< radians, of a directional light
};

struct Bounds {
  glm::vec3 min{std::numeric_limits<float>::max()};
  glm::vec3 max{std::numeric_limits<float>::lowest()};
  bool empty() const { return min.x > max.x; }
  void add(const glm::vec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
  glm::vec3 size() const { return empty() ? glm::vec3(0) : max - min; }
  glm::vec3 centre() const { return 0.5f * (min + max); }
};

/// What import found, dropped, ignored and guessed; each entry is one line for a person.
struct ImportReport {
  std::vector<std::string> found;    ///< "27,126 triangles in 16 meshes"
  std::vector<std::string> dropped;  ///< "12 degenerate triangles", "3 triangles with NaN positions"
  std::vector<std::string> ignored;  ///< "extension KHR_materials_specular"
  std::vector<std::string>
      guessed;  ///< "unit: metres (glTF)", "up axis: Y (glTF)", "no lights: a sun and sky were added"
  double metresPerUnit = 1;  ///< what the file's lengths were taken times
};

/// What a scene's key is made of.
struct SceneParts {
  ContentKey geometry;   ///< meshes, origin
  ContentKey materials;  ///< with textures and images
  ContentKey lights;     ///< with the sky
  bool operator==(const SceneParts&) const = default;
};

struct Scene {
  std::string name;      ///< file stem
  ContentKey key;        ///< of everything below that can change a pixel
  SceneParts parts;      ///< of the key
  glm::dvec3 origin{0};  ///< project origin in source metres; world = position + origin
  std::vector<Material> materials;
  std::vector<Mesh> meshes;         ///< each stands where it is
  std::vector<Mesh> prototypes;     ///< in frames of their own; seen through instances alone
  std::vector<Instance> instances;  ///< each prototype has one at least
  std::vector<Texture> textures;
  std::vector<std::shared_ptr<const ColourImage>> images;
  std::vector<Light> lights;
  Sky sky;
  Bounds bounds;
  ImportReport report;

  /// Of `meshes`: those that have numbers, and may have light of their own.
  std::size_t triangleCount() const;
  /// Of all instances together.
  std::uint64_t instancedTriangleCount() const;
  /// Of meshes and prototypes: those that are kept in memory.
  std::uint64_t uniqueTriangleCount() const { return triangleCount() + prototypeTriangleCount(); }
  std::uint64_t prototypeTriangleCount() const;
  /// All that can be seen.
  std::uint64_t shownTriangleCount() const { return triangleCount() + instancedTriangleCount(); }
  /// Placed meshes are numbered through: first the meshes, then the instances.
  std::uint32_t placedCount() const { return std::uint32_t(meshes.size() + instances.size()); }
  bool isInstance(std::uint32_t placed) const { return placed >= meshes.size(); }
  /// What stands there: of an instance its prototype, in the prototype's frame (placed_mesh.h tells where).
  const Mesh& meshOf(std::uint32_t placed) const {
    return placed < meshes.size() ? meshes[placed] : prototypes[instances[placed - meshes.size()].prototype];
  }
  /// Scene-wide triangle numbers: mesh m's triangle t is firstTriangle(m) + t. meshes.size() + 1 entries.
  std::vector<std::uint32_t> firstTriangles() const;
};

/// Numbers of the meshes' first triangles when all are numbered in order; meshes.size() + 1 entries.
std::vector<std::uint32_t> firstTrianglesOf(const std::vector<Mesh>& meshes);

using ScenePtr = std::shared_ptr<const Scene>;

/// Hash of everything in `scene` that can change a pixel: geometry, colours, images, lights, sky, origin.
/// Names and the report do not count. Import fills Scene::key with it; whoever makes a Scene by hand does the
/// same.
ContentKey keyOf(const Scene& scene);
SceneParts partsOf(const Scene& scene);
ContentKey keyOf(const SceneParts& parts);
Bounds boundsOf(const Scene& scene);

}  // namespace acentric
