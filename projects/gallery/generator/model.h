#pragma once
/// A glTF model in memory, as far as this scene needs one: materials, meshes placed by nodes, lights. Z up;
/// the writer turns it to glTF's Y up.

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "projects/gallery/generator/shape.h"

namespace acentric::gallery {

struct Picture {
  std::string name;
  std::vector<std::byte> bytes;
  bool jpeg = false;  ///< else PNG
  bool repeats = true;
};

struct Material {
  std::string name;
  glm::vec4 baseColour{1};
  int picture = -1;        ///< base colour; index into Model::pictures
  int normalPicture = -1;  ///< with tangent space by texture coordinates
  float metres = 1;  ///< how much of the surface the picture covers; 0 = coordinates are the picture's own
  float metallic = 0;
  float roughness = 0.8f;
  float transmission = 0;
  glm::vec3 emission{0};  ///< linear, at most 1 a channel
  float emissionStrength = 1;
  std::optional<float> alphaCutoff;  ///< alpha-tested
  bool doubleSided = false;
};

struct Part {
  int material = 0;
  Shape shape;
};

/// Parts that are placed together, once or several times.
struct Thing {
  std::string name;
  std::vector<Part> parts;
  std::vector<glm::mat4> placements;
};

struct Light {
  std::string name;
  bool directional = false;  ///< else a point light
  glm::vec3 colour{1};
  float intensity = 1;  ///< lux, or candela
  glm::vec3 position{0};
  glm::vec3 direction{0, 0, -1};  ///< the way it travels
};

struct Model {
  std::vector<Picture> pictures;
  std::vector<Material> materials;
  std::vector<Thing> things;
  std::vector<Light> lights;

  int add(Picture picture);
  int add(Material material);
  /// A thing that stands where its parts say.
  void add(std::string name, int material, Shape shape);
};

enum class ModelCoding {
  plain,
  /// Meshes by EXT_meshopt_compression, positions rounded by at most 1/65536 of their distance from their
  /// origin; what stands in several places by EXT_mesh_gpu_instancing, its positions rounded by 1/4096, its
  /// places to 1/256 of a metre and its scales to 1/256. Placements turn and scale alike in all directions.
  compact,
};

/// Binary glTF 2.0, or for the ending .gltf JSON with one .bin beside it. Same model, same bytes. Atomic.
Status writeModel(const Model& model, const std::filesystem::path& path,
                  ModelCoding coding = ModelCoding::plain);

}  // namespace acentric::gallery
