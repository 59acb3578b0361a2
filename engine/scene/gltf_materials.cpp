#include "engine/scene/gltf_materials.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>

#include "engine/scene/gltf_accessors.h"

namespace acentric {
namespace {

float factor(double value, double low, double high, double otherwise) {
  return float(std::isfinite(value) ? glm::clamp(value, low, high) : otherwise);
}

/// Colour factors above 1 or below 0 have no meaning; a short or broken list keeps the default.
glm::vec4 colourOf(const std::vector<double>& values, glm::vec4 colour, std::size_t components) {
  if (values.size() != components) return colour;
  for (std::size_t i = 0; i < components; ++i) colour[int(i)] = factor(values[i], 0, 1, colour[int(i)]);
  return colour;
}

std::vector<double> numbersOf(const tinygltf::Value& object, const char* key) {
  std::vector<double> out;
  if (!object.IsObject() || !object.Has(key)) return out;
  const tinygltf::Value& array = object.Get(key);
  for (std::size_t i = 0; i < array.ArrayLen(); ++i) {
    const tinygltf::Value& item = array.Get(int(i));
    out.push_back(item.IsNumber() ? item.GetNumberAsDouble() : std::nan(""));
  }
  return out;
}

const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

int integerOr(const tinygltf::Value& object, const char* key, int otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  return value.IsInt() ? value.GetNumberAsInt() : otherwise;
}

Wrap wrapOf(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
  return Wrap::repeat;
}

/// KHR_texture_transform: translation * rotation * scale, v down.
glm::mat3x2 transformOf(const tinygltf::Value& extension) {
  const std::vector<double> offset = numbersOf(extension, "offset");
  const std::vector<double> scale = numbersOf(extension, "scale");
  const double rotation = numberOr(extension, "rotation", 0);
  const auto pick = [](const std::vector<double>& v, std::size_t i, double otherwise) {
    return v.size() == 2 && std::isfinite(v[i]) ? v[i] : otherwise;
  };
  const double sx = pick(scale, 0, 1), sy = pick(scale, 1, 1);
  const double c = std::cos(rotation), s = std::sin(rotation);
  return glm::mat3x2(glm::vec2(c * sx, -s * sx), glm::vec2(s * sy, c * sy),
                     glm::vec2(pick(offset, 0, 0), pick(offset, 1, 0)));
}

}  // namespace

double numberOr(const tinygltf::Value& object, const char* key, double otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  return value.IsNumber() && std::isfinite(value.GetNumberAsDouble()) ? value.GetNumberAsDouble() : otherwise;
}

GltfMaterial GltfMaterials::take(int gltfMaterial) {
  if (gltfMaterial < -1 || gltfMaterial >= int(model_.materials.size())) {
    scene_.ignored.add(
        fmt::format("material {}, which does not exist (the default material is used)", gltfMaterial));
    gltfMaterial = -1;
  }
  const auto known = materials_.find(gltfMaterial);
  if (known != materials_.end()) return known->second;
  tinygltf::Material defaultMaterial;
  defaultMaterial.name = "default";
  const tinygltf::Material& source =
      gltfMaterial < 0 ? defaultMaterial : model_.materials[std::size_t(gltfMaterial)];
  return materials_[gltfMaterial] = convert(source, gltfMaterial);
}

GltfMaterial GltfMaterials::convert(const tinygltf::Material& source, int number) {
  Material out;
  GltfMaterial slots;
  out.name = source.name.empty() ? fmt::format("material {}", number) : source.name;
  const auto& pbr = source.pbrMetallicRoughness;
  out.baseColour = colourOf(pbr.baseColorFactor, glm::vec4(1), 4);
  out.baseColourTexture = use(pbr.baseColorTexture, slots, out.name);
  out.metallic = factor(pbr.metallicFactor, 0, 1, 1);
  out.roughness = factor(pbr.roughnessFactor, 0, 1, 1);
  if (const auto* glossy = extensionOf(source.extensions, "KHR_materials_pbrSpecularGlossiness"))
    convertSpecularGlossiness(*glossy, out, slots);
  else
    out.metallicRoughnessTexture = use(pbr.metallicRoughnessTexture, slots, out.name);

  out.emissive = glm::vec3(colourOf(source.emissiveFactor, glm::vec4(0), 3));
  if (const auto* strength = extensionOf(source.extensions, "KHR_materials_emissive_strength"))
    out.emissive *= factor(numberOr(*strength, "emissiveStrength", 1), 0, 1e6, 1);
  if (out.emissive != glm::vec3(0)) out.emissiveTexture = use(source.emissiveTexture, slots, out.name);

  out.normalTexture = use(source.normalTexture, slots, out.name);
  out.normalScale = factor(source.normalTexture.scale, -100, 100, 1);
  slots.wantsTangents = out.normalTexture.used();
  if (source.occlusionTexture.index >= 0) scene_.ignored.add("occlusion textures (occlusion is baked)");

  if (const auto* transmission = extensionOf(source.extensions, "KHR_materials_transmission")) {
    out.transmission = factor(numberOr(*transmission, "transmissionFactor", 0), 0, 1, 0);
    if (transmission->Has("transmissionTexture"))
      scene_.ignored.add("transmission textures (the factor is used)");
  }
  out.unlit = source.extensions.contains("KHR_materials_unlit");
  out.doubleSided = source.doubleSided;
  out.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::mask
                  : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                : AlphaMode::opaque;
  out.alphaCutoff = factor(source.alphaCutoff, 0, 1e6, 0.5);

  slots.index = int(scene_.materials.size());
  scene_.materials.push_back(std::move(out));
  return slots;
}

void GltfMaterials::convertSpecularGlossiness(const tinygltf::Value& extension, Material& out,
                                              GltfMaterial& slots) {
  out.baseColour = colourOf(numbersOf(extension, "diffuseFactor"), glm::vec4(1), 4);
  if (extension.Has("diffuseTexture"))
    out.baseColourTexture = use(extension.Get("diffuseTexture"), slots, out.name);
  out.metallic = 0;
  out.roughness = 1 - factor(numberOr(extension, "glossinessFactor", 1), 0, 1, 1);
  scene_.ignored.add("specular colours of KHR_materials_pbrSpecularGlossiness (its diffuse colour is used)");
}

template <class Info>
TextureUse GltfMaterials::use(const Info& info, GltfMaterial& slots, const std::string& what) {
  return useAt(info.index, info.texCoord, extensionOf(info.extensions, "KHR_texture_transform"), slots, what);
}

TextureUse GltfMaterials::use(const tinygltf::Value& info, GltfMaterial& slots, const std::string& what) {
  if (!info.IsObject()) return {};
  const tinygltf::Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").IsObject() &&
      info.Get("extensions").Has("KHR_texture_transform"))
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  return useAt(integerOr(info, "index", -1), integerOr(info, "texCoord", 0), transform, slots, what);
}

TextureUse GltfMaterials::useAt(int texture, int texCoord, const tinygltf::Value* transform,
                                GltfMaterial& slots, const std::string& what) {
  TextureUse out;
  if (texture < 0) return out;
  if (transform) {
    out.transform = transformOf(*transform);
    texCoord = integerOr(*transform, "texCoord", texCoord);
  }
  int slot = 0;
  while (slot < 2 && slots.uvSet[slot] != -1 && slots.uvSet[slot] != texCoord) ++slot;
  if (slot == 2 || texCoord < 0) {
    scene_.ignored.add(
        fmt::format("a texture of material {}: it needs a third set of texture coordinates", what));
    return {};
  }
  out.texture = takeTexture(texture);
  if (out.texture < 0) return {};
  slots.uvSet[slot] = texCoord;
  out.uvSet = std::uint8_t(slot);
  return out;
}

int GltfMaterials::takeTexture(int gltfTexture) {
  const auto known = textures_.find(gltfTexture);
  if (known != textures_.end()) return known->second;
  int& result = textures_[gltfTexture] = -1;
  if (std::size_t(gltfTexture) >= model_.textures.size()) {
    scene_.ignored.add(fmt::format("texture {}, which does not exist", gltfTexture));
    return -1;
  }
  const tinygltf::Texture& source = model_.textures[std::size_t(gltfTexture)];
  int image = source.source;
  if (const auto* webp = extensionOf(source.extensions, "EXT_texture_webp"); webp && image < 0)
    image = integerOr(*webp, "source", -1);
  if (image < 0 && extensionOf(source.extensions, "KHR_texture_basisu") != nullptr) {
    scene_.ignored.add(
        "textures that are Basis Universal pictures (KHR_texture_basisu), which are not decoded: their "
        "materials "
        "have the colour of their factor alone; convert them to PNG, JPEG or WebP (gltf-transform "
        "ktxdecompress)");
    return -1;
  }
  Texture texture;
  texture.image = takeImage(image);
  if (texture.image < 0) return -1;
  texture.name = source.name;
  if (source.sampler >= 0 && std::size_t(source.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& sampler = model_.samplers[std::size_t(source.sampler)];
    texture.wrapU = wrapOf(sampler.wrapS);
    texture.wrapV = wrapOf(sampler.wrapT);
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  result = int(scene_.textures.size());
  scene_.textures.push_back(std::move(texture));
  return result;
}

int GltfMaterials::takeImage(int gltfImage) {
  const auto known = images_.find(gltfImage);
  if (known != images_.end()) return known->second;
  int& result = images_[gltfImage] = -1;
  if (gltfImage < 0 || std::size_t(gltfImage) >= model_.images.size()) {
    scene_.ignored.add(
        fmt::format("image {}, which does not exist or has a format that is not played", gltfImage));
    return -1;
  }
  const tinygltf::Image& source = model_.images[std::size_t(gltfImage)];
  const std::string name = !source.uri.empty()    ? source.uri
                           : !source.name.empty() ? source.name
                                                  : fmt::format("image {}", gltfImage);
  context_.tell(double(images_.size()), double(model_.images.size()), "reading textures");
  std::span<const std::byte> bytes = std::as_bytes(std::span(source.image));
  if (source.bufferView >= 0) {
    const auto view = readGltfView(model_, source.bufferView);
    if (!view) {
      scene_.ignored.add(fmt::format("texture {}: {}", name, view.error().message));
      return -1;
    }
    bytes = std::as_bytes(std::span(view->data, view->size));
  }
  if (bytes.empty()) {  // the reading callback has already said why a named file was not read
    scene_.ignored.add(fmt::format("texture {}: has no data", name));
    return -1;
  }
  auto image = decodeOrIgnore(bytes, name, scene_.ignored);
  if (!image) return -1;
  result = int(scene_.images.size());
  scene_.images.push_back(std::move(image));
  return result;
}

}  // namespace acentric
