#pragma once
/// Materials, textures and images of a glTF file, taken over as they are first used. Private to this folder.

#include <map>

#include "engine/scene/source_scene.h"

namespace tinygltf {
class Model;
class Value;
struct Material;
}  // namespace tinygltf

namespace acentric {

struct GltfMaterial {
  int index = -1;           ///< into SourceScene::materials
  int uvSet[2] = {-1, -1};  ///< which TEXCOORD_n goes into uv[0] and uv[1]; -1 = none
  bool wantsTangents = false;
};

class GltfMaterials {
 public:
  GltfMaterials(const tinygltf::Model& model, const ReadContext& context, SourceScene& scene)
      : model_(model), context_(context), scene_(scene) {}

  /// -1 = the default material.
  GltfMaterial take(int gltfMaterial);

 private:
  GltfMaterial convert(const tinygltf::Material& source, int number);
  void convertSpecularGlossiness(const tinygltf::Value& extension, Material& out, GltfMaterial& slots);
  template <class Info>
  TextureUse use(const Info& info, GltfMaterial& slots, const std::string& what);
  TextureUse use(const tinygltf::Value& info, GltfMaterial& slots, const std::string& what);
  TextureUse useAt(int texture, int texCoord, const tinygltf::Value* transform, GltfMaterial& slots,
                   const std::string& what);
  int takeTexture(int gltfTexture);
  int takeImage(int gltfImage);

  const tinygltf::Model& model_;
  const ReadContext& context_;
  SourceScene& scene_;
  std::map<int, GltfMaterial> materials_;
  std::map<int, int> textures_;
  std::map<int, int> images_;
};

/// A number of an extension's JSON, finite, or the default.
double numberOr(const tinygltf::Value& object, const char* key, double otherwise);

}  // namespace acentric
