#pragma once
/// Materials and textures of a file read through assimp, taken over as they are first used. Private to this
/// folder.

#include <map>

#include "engine/scene/source_scene.h"

struct aiScene;
struct aiMaterial;

namespace acentric {

struct AssimpMaterial {
  int index = -1;           ///< into SourceScene::materials
  int uvSet[2] = {-1, -1};  ///< which of assimp's uv channels goes into uv[0] and uv[1]; -1 = none
};

class AssimpMaterials {
 public:
  AssimpMaterials(const aiScene& from, const ReadContext& context, SourceScene& scene)
      : from_(from), context_(context), scene_(scene) {}

  AssimpMaterial take(unsigned index);

 private:
  AssimpMaterial convert(const aiMaterial& source, unsigned index);
  TextureUse use(const aiMaterial& source, std::initializer_list<int> types, AssimpMaterial& slots);
  int takeTexture(const std::string& file, int modeU, int modeV);
  int takeImage(const std::string& file);
  std::shared_ptr<const ColourImage> embedded(const std::string& file, bool& known);

  const aiScene& from_;
  const ReadContext& context_;
  SourceScene& scene_;
  std::map<unsigned, AssimpMaterial> materials_;
  std::map<std::string, int> textures_;
  std::map<std::string, int> images_;
};

/// sRGB to linear, [0,1].
float linearOf(float encoded);

}  // namespace acentric
