#pragma once
/// A glTF 2.0 document and its one buffer, put together piece by piece and written as GLB.

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"
#include "engine/scene/scene.h"

namespace acentric {

/// glTF's numbers for types of components.
inline constexpr int kGltfUnsignedShort = 5123, kGltfUnsignedInt = 5125, kGltfFloat = 5126;

struct GlbMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uv;      ///< empty, or one each: (0, 0) is the picture's upper left corner
  std::vector<glm::vec3> colour;  ///< empty, or one each: display-linear, 0..1
  std::vector<glm::uvec3> triangles;
};

struct GlbMaterial {
  std::string name;
  int texture = -1;  ///< of the document
  glm::vec4 factor{1};
  enum class Alpha : std::uint8_t { opaque, mask, blend } alpha = Alpha::opaque;
  float cutoff = 0.5F;
  bool doubleSided = true;
};

struct PackedAttribute;

/// How geometry and pictures are kept.
struct GlbCoding {
  /// Geometry is packed (packed_mesh.h) and coded as EXT_meshopt_compression has it.
  bool meshopt = false;
  /// Of packed positions: the origin of all nodes, and how far a position may be off, as a share of its
  /// distance from there.
  glm::vec3 middle{0};
  double positionError = 1e-5;
  bool webp = false;  ///< textures: EXT_texture_webp; else PNG
  int quality = 92;   ///< of WebP: its own 0..99, or kLosslessColours
};

/// Everything in it is drawn as it is: all materials are unlit (KHR_materials_unlit), light is in textures
/// and vertex colours.
class Glb {
 public:
  using Json = nlohmann::ordered_json;

  Glb(const std::string& generator, const GlbCoding& coding);

  struct Sampler {
    bool nearest = false;
    int wrapU = kClamp, wrapV = kClamp;  ///< glTF's numbers
  };
  static constexpr int kClamp = 33071, kMirror = 33648, kRepeat = 10497;
  /// Returns the texture's number. Without alpha it is stored as RGB.
  Result<int> addTexture(const ColourImage& image, const Sampler& sampler);
  int addMaterial(const GlbMaterial& material);
  /// As a primitive of the node of that name, made when it is first named. Nothing without triangles.
  void add(const std::string& node, const GlbMesh& mesh, int material);
  /// Of the scene.
  void setExtras(Json extras) { json_["scenes"][0]["extras"] = std::move(extras); }

  /// Of all that was added.
  const Bounds& bounds() const { return bounds_; }

  /// Atomically; returns its size.
  Result<std::uint64_t> write(const std::filesystem::path& file) const;

 private:
  int addView(const void* data, std::size_t bytes, int target);
  int addAccessor(int view, int componentType, const char* type, std::size_t count);
  template <class Value>
  int addAttribute(const std::vector<Value>& values, const char* type);
  /// With the bounds of its positions, as they are in the file.
  Json primitiveOf(const GlbMesh& mesh, bool textured);
  Json packedPrimitiveOf(const GlbMesh& mesh, bool textured);
  /// `stride`: bytes of an element; of triangles' indices `target` is that of elements.
  int addCodedView(const std::vector<std::byte>& coded, std::size_t count, std::size_t stride, int target,
                   bool exponential);
  int addPacked(const PackedAttribute& attribute, std::size_t vertices);
  void addBounds(int positions, const glm::vec3& low, const glm::vec3& high);
  void use(const char* extension, bool required);

  const GlbCoding coding_;
  Json json_;
  std::vector<std::byte> buffer_;
  std::size_t decoded_ = 0;  ///< bytes of what is coded, once it is decoded
  Bounds bounds_;
};

}  // namespace acentric
