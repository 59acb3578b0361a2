#include "engine/scene/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

/// What is not played: lost of a picture (null: nothing that is seen), and how to do without.
struct Extension {
  const char* name;
  const char* lost;
  const char* wayOut;
};

/// KHR_texture_basisu by its fallback or the material's colour factor, KHR_materials_variants by the default.
constexpr std::array<const char*, 13> kPlayed{
    "KHR_lights_punctual",        "KHR_texture_transform",   "KHR_materials_emissive_strength",
    "KHR_materials_transmission", "KHR_materials_unlit",     "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_variants",     "EXT_mesh_gpu_instancing", "KHR_mesh_quantization",
    "EXT_texture_webp",           "KHR_texture_basisu",      "KHR_draco_mesh_compression",
    "EXT_meshopt_compression"};

constexpr const char* kWithout =
    "export the model without it, or remove it with a tool such as gltf-transform";
constexpr const char* kPictures =
    "convert its pictures to PNG, JPEG or WebP (gltf-transform png, jpeg or webp)";

constexpr Extension kKnown[] = {
    {"KHR_materials_variants", "all variants but the default one", kWithout},
    {"KHR_materials_specular", "the strength and tint of highlights", kWithout},
    {"KHR_materials_clearcoat", "the shine of clear coats", kWithout},
    {"KHR_materials_sheen", "the sheen of cloth", kWithout},
    {"KHR_materials_ior", "bending by glass", kWithout},
    {"KHR_materials_volume", "the colour that thick glass takes on", kWithout},
    {"KHR_materials_iridescence", "iridescent colours", kWithout},
    {"KHR_materials_anisotropy", "brushed highlights", kWithout},
    {"KHR_materials_dispersion", "colours split by glass", kWithout},
    {"KHR_materials_diffuse_transmission", "light that shines through leaves and paper", kWithout},
    {"KHR_animation_pointer", "animations", kWithout},
    {"KHR_node_visibility", "the hiding of nodes: all are shown", kWithout},
    {"EXT_lights_image_based", "light from its environment picture", kWithout},
    {"EXT_lights_ies", "the shapes of lamps' beams", kWithout},
    {"EXT_texture_avif", "textures that are AVIF pictures", kPictures},
    {"MSFT_texture_dds", "textures that are DDS pictures", kPictures},
    {"MSFT_lod", "coarser levels of detail: the finest is taken", kWithout},
    {"KHR_meshopt_compression", "the compressed geometry",
     "compress it with EXT_meshopt_compression instead (gltfpack -c)"},
    {"KHR_gaussian_splatting", "its splats", "export the model as triangles"},
    {"KHR_xmp_json_ld", nullptr, kWithout},
    {"KHR_mesh_attributes", nullptr, kWithout},
    {"EXT_mesh_features", nullptr, kWithout},
    {"EXT_structural_metadata", nullptr, kWithout},
    {"EXT_instance_features", nullptr, kWithout},
    {"AGI_articulations", nullptr, kWithout},
};

const Extension* known(const std::string& name) {
  const auto found = std::ranges::find_if(kKnown, [&](const Extension& e) { return name == e.name; });
  return found == std::end(kKnown) ? nullptr : &*found;
}

}  // namespace

Status checkExtensions(const std::vector<std::string>& required, const std::vector<std::string>& used,
                       ReportLines& ignored) {
  const auto played = [](const std::string& name) {
    return std::ranges::find(kPlayed, name) != kPlayed.end();
  };
  for (const std::string& name : required) {
    const Extension* extension = known(name);
    if (played(name) || (extension != nullptr && extension->lost == nullptr)) continue;
    return fail(
        ErrorKind::unsupported,
        fmt::format("requires the extension {}, which is not supported; without it, {} would be lost: {}",
                    name, extension == nullptr ? "what it adds" : extension->lost,
                    extension == nullptr ? kWithout : extension->wayOut));
  }
  for (const std::string& name : used)
    if (const Extension* extension = known(name); extension != nullptr && extension->lost != nullptr)
      ignored.add(fmt::format("extension {}: {}", name, extension->lost));
    else if (extension == nullptr && !played(name))
      ignored.add("extension " + name);
  return {};
}

}  // namespace acentric
