#include "engine/scene/assimp_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"

namespace acentric {
namespace {

glm::vec3 colourOf(const aiMaterial& source, const char* key, unsigned type, unsigned index,
                   glm::vec3 otherwise) {
  aiColor4D colour;
  if (source.Get(key, type, index, colour) != AI_SUCCESS) return otherwise;
  const glm::vec3 out(colour.r, colour.g, colour.b);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(out[i]) || out[i] < 0) return otherwise;
  return out;
}

float numberOf(const aiMaterial& source, const char* key, unsigned type, unsigned index, float otherwise) {
  ai_real value = 0;
  return source.Get(key, type, index, value) == AI_SUCCESS && std::isfinite(value) ? float(value) : otherwise;
}

std::string textureFile(const aiMaterial& source, aiTextureType type) {
  aiString file;
  return source.Get(AI_MATKEY_TEXTURE(type, 0), file) == AI_SUCCESS ? file.C_Str() : "";
}

Wrap wrapOf(int mode) {
  if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return Wrap::clamp;
  if (mode == aiTextureMapMode_Mirror) return Wrap::mirror;
  return Wrap::repeat;
}

}  // namespace

float linearOf(float encoded) {
  return std::isfinite(encoded) ? linearFromSrgb(std::clamp(encoded, 0.0f, 1.0f)) : 0.0f;
}

AssimpMaterial AssimpMaterials::take(unsigned index) {
  const auto known = materials_.find(index);
  if (known != materials_.end()) return known->second;
  if (index < from_.mNumMaterials && from_.mMaterials[index])
    return materials_[index] = convert(*from_.mMaterials[index], index);
  Material plain;
  plain.name = "default";
  plain.metallic = 0;
  plain.doubleSided = true;
  scene_.materials.push_back(plain);
  return materials_[index] = {int(scene_.materials.size()) - 1, {-1, -1}};
}

AssimpMaterial AssimpMaterials::convert(const aiMaterial& source, unsigned index) {
  Material out;
  AssimpMaterial slots;
  aiString name;
  out.name = source.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name.length > 0
                 ? name.C_Str()
                 : fmt::format("material {}", index);
  out.baseColourTexture = use(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, slots);
  glm::vec3 colour =
      colourOf(source, AI_MATKEY_BASE_COLOR, colourOf(source, AI_MATKEY_COLOR_DIFFUSE, glm::vec3(0.8f)));
  // Exporters leave the colour black where a texture says it all.
  if (colour == glm::vec3(0) && out.baseColourTexture.used()) colour = glm::vec3(1);
  const float opacity = std::clamp(numberOf(source, AI_MATKEY_OPACITY, 1), 0.0f, 1.0f);
  out.baseColour = glm::vec4(glm::min(colour, glm::vec3(1)), opacity);
  if (opacity < 1) out.alphaMode = AlphaMode::blend;
  const std::string opacityFile = textureFile(source, aiTextureType_OPACITY);
  if (!opacityFile.empty()) {
    if (out.baseColourTexture.used() && opacityFile == textureFile(source, aiTextureType_DIFFUSE))
      out.alphaMode = AlphaMode::mask;  // one picture for both: its alpha cuts leaves and fences out
    else
      scene_.ignored.add(fmt::format("opacity texture {} of material {}", opacityFile, out.name));
  }
  out.emissive = colourOf(source, AI_MATKEY_COLOR_EMISSIVE, glm::vec3(0));
  if (out.emissive != glm::vec3(0)) out.emissiveTexture = use(source, {aiTextureType_EMISSIVE}, slots);
  out.metallic = std::clamp(numberOf(source, AI_MATKEY_METALLIC_FACTOR, 0), 0.0f, 1.0f);
  const float shininess = std::max(0.0f, numberOf(source, AI_MATKEY_SHININESS, 0));
  out.roughness =
      std::clamp(numberOf(source, AI_MATKEY_ROUGHNESS_FACTOR, std::sqrt(2 / (shininess + 2))), 0.0f, 1.0f);
  out.normalTexture = use(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}, slots);
  if (!textureFile(source, aiTextureType_HEIGHT).empty()) scene_.ignored.add("height (bump) textures");
  int twoSided = 0;
  if (source.Get(AI_MATKEY_TWOSIDED, twoSided) == AI_SUCCESS) {
    out.doubleSided = twoSided != 0;
  } else {
    out.doubleSided = true;
    scene_.guessed.add("materials: two-sided (the format does not say)");
  }
  slots.index = int(scene_.materials.size());
  scene_.materials.push_back(std::move(out));
  return slots;
}

TextureUse AssimpMaterials::use(const aiMaterial& source, std::initializer_list<int> types,
                                AssimpMaterial& slots) {
  for (const int code : types) {
    const auto type = aiTextureType(code);
    const std::string file = textureFile(source, type);
    if (file.empty()) continue;
    int modeU = 0, modeV = 0, channel = 0;
    source.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), modeU);
    source.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), modeV);
    source.Get(AI_MATKEY_UVWSRC(type, 0), channel);
    int slot = 0;
    while (slot < 2 && slots.uvSet[slot] != -1 && slots.uvSet[slot] != channel) ++slot;
    if (slot == 2) {
      scene_.ignored.add(fmt::format("texture {}: it needs a third set of texture coordinates", file));
      continue;
    }
    TextureUse out;
    out.texture = takeTexture(file, modeU, modeV);
    if (out.texture < 0) continue;
    slots.uvSet[slot] = channel;
    out.uvSet = std::uint8_t(slot);
    return out;
  }
  return {};
}

int AssimpMaterials::takeTexture(const std::string& file, int modeU, int modeV) {
  const std::string key = fmt::format("{} {} {}", modeU, modeV, file);
  if (const auto known = textures_.find(key); known != textures_.end()) return known->second;
  int& result = textures_[key] = -1;
  Texture texture;
  texture.name = file;
  texture.image = takeImage(file);
  texture.wrapU = wrapOf(modeU);
  texture.wrapV = wrapOf(modeV);
  if (texture.image < 0) return -1;
  result = int(scene_.textures.size());
  scene_.textures.push_back(std::move(texture));
  return result;
}

int AssimpMaterials::takeImage(const std::string& file) {
  if (const auto known = images_.find(file); known != images_.end()) return known->second;
  int& result = images_[file] = -1;
  context_.tell(double(images_.size()), 0, "reading textures");
  bool inside = false;
  std::shared_ptr<const ColourImage> image = embedded(file, inside);
  if (!inside) {
    const auto bytes = context_.references.read(file, std::size_t(1) << 30);
    if (bytes)
      image = decodeOrIgnore(*bytes, file, scene_.ignored);
    else
      scene_.ignored.add(fmt::format("texture {}: {}", file, bytes.error().message));
  }
  if (!image) return -1;
  result = int(scene_.images.size());
  scene_.images.push_back(std::move(image));
  return result;
}

std::shared_ptr<const ColourImage> AssimpMaterials::embedded(const std::string& file, bool& known) {
  const aiTexture* texture = from_.GetEmbeddedTexture(file.c_str());
  known = texture != nullptr;
  if (!texture || !texture->pcData) return nullptr;
  if (texture->mHeight == 0)  // the bytes of a picture file, mWidth of them
    return decodeOrIgnore(
        std::as_bytes(std::span(reinterpret_cast<const char*>(texture->pcData), texture->mWidth)), file,
        scene_.ignored);
  if (std::size_t(texture->mWidth) * texture->mHeight > (std::size_t(1) << 28)) {
    scene_.ignored.add(fmt::format("texture {}: is too large", file));
    return nullptr;
  }
  ColourImage out{int(texture->mWidth), int(texture->mHeight)};
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const aiTexel& t = texture->pcData[i];
    out.pixels[i] = {t.r, t.g, t.b, t.a};
  }
  return std::make_shared<const ColourImage>(std::move(out));
}

}  // namespace acentric
