#pragma once
/// A glTF 2.0 document and its one buffer, put together piece by piece and written as GLB.

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/export/draw_model.h"

namespace acentric {

/// (x, y, z) with Z up as glTF has it, with Y up.
inline glm::vec3 gltfPosition(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

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

/// Everything in it is drawn as it is: all materials are unlit (KHR_materials_unlit), light is in textures,
/// the sky in vertex colours.
class Glb {
 public:
  using Json = nlohmann::ordered_json;

  Glb(const std::string& generator, const GlbCoding& coding);

  /// Each mesh as a primitive of its part's node, which is made when it is first named; with Y up. Nothing of
  /// meshes without triangles. Textures without alpha are stored as RGB. Once for a document.
  Status add(DrawModel model);
  /// Of the scene.
  void setExtras(Json extras) { json_["scenes"][0]["extras"] = std::move(extras); }

  /// Of all that was added.
  const Bounds& bounds() const { return bounds_; }

  /// Atomically; returns its size.
  Result<std::uint64_t> write(const std::filesystem::path& file) const;

 private:
  Status addTexture(const DrawTexture& texture);
  int addMaterial(const DrawMesh& mesh);
  void addMesh(const DrawMesh& mesh);
  int addView(const void* data, std::size_t bytes, int target);
  int addAccessor(int view, int componentType, const char* type, std::size_t count);
  template <class Value>
  int addAttribute(const std::vector<Value>& values, const char* type);
  /// With the bounds of its positions, as they are in the file.
  Json primitiveOf(const DrawMesh& mesh);
  Json packedPrimitiveOf(const DrawMesh& mesh);
  /// `stride`: bytes of an element; of triangles' indices `target` is that of elements.
  int addCodedView(const std::vector<std::byte>& coded, std::size_t count, std::size_t stride, int target,
                   const std::string& filter);
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
