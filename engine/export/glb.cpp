#include "engine/export/glb.h"

#include <algorithm>
#include <cstring>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/export/packed_mesh.h"
#include "engine/export/webp.h"
#include "engine/image/png.h"

namespace acentric {
namespace {

constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr int kNearest = 9728, kLinear = 9729;
constexpr const char *kUnlit = "KHR_materials_unlit", *kMeshopt = "EXT_meshopt_compression",
                     *kWebp = "EXT_texture_webp";
constexpr std::size_t kLargestGlb = 0xfffffff0;  // its lengths have 32 bits

/// glTF's.
int numberOf(Wrap mode) { return mode == Wrap::clamp ? 33071 : mode == Wrap::mirror ? 33648 : 10497; }

void put(std::vector<std::byte>& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(std::byte(word >> shift));
}

}  // namespace

Glb::Glb(const std::string& generator, const GlbCoding& coding)
    : coding_(coding),
      json_{{"asset", {{"version", "2.0"}, {"generator", generator}}},
            {"scene", 0},
            {"scenes", Json::array({Json::object()})}} {
  use(kUnlit, false);
}

void Glb::use(const char* extension, bool required) {
  const auto add = [&](Json& names) {
    if (std::ranges::find(names, extension) == names.end()) names.push_back(extension);
  };
  add(json_["extensionsUsed"]);
  if (required) add(json_["extensionsRequired"]);
}

int Glb::addView(const void* data, std::size_t bytes, int target) {
  buffer_.resize((buffer_.size() + 3) / 4 * 4);
  Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes}};
  if (target != 0) view["target"] = target;
  const auto* first = static_cast<const std::byte*>(data);
  buffer_.insert(buffer_.end(), first, first + bytes);
  json_["bufferViews"].push_back(std::move(view));
  return int(json_["bufferViews"].size()) - 1;
}

int Glb::addAccessor(int view, int componentType, const char* type, std::size_t count) {
  json_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}});
  return int(json_["accessors"].size()) - 1;
}

template <class Value>
int Glb::addAttribute(const std::vector<Value>& values, const char* type) {
  return addAccessor(addView(values.data(), values.size() * sizeof(Value), kArrayBuffer), kGltfFloat, type,
                     values.size());
}

Status Glb::add(DrawModel model) {
  for (const DrawTexture& texture : model.textures)
    if (Status added = addTexture(texture); !added) return added;
  for (DrawMesh& mesh : model.meshes) {
    for (glm::vec3& position : mesh.positions) position = gltfPosition(position);
    addMesh(mesh);
  }
  return {};
}

Status Glb::addTexture(const DrawTexture& texture) {
  const auto coded = coding_.webp ? encodeWebp(texture.image, coding_.quality) : encodePng(texture.image);
  if (!coded) return tl::unexpected(coded.error());
  const int view = addView(coded->data(), coded->size(), 0);
  json_["images"].push_back({{"bufferView", view}, {"mimeType", coding_.webp ? "image/webp" : "image/png"}});
  json_["samplers"].push_back({{"magFilter", texture.nearest ? kNearest : kLinear},
                               {"minFilter", texture.nearest ? kNearest : kLinear},
                               {"wrapS", numberOf(texture.wrapU)},
                               {"wrapT", numberOf(texture.wrapV)}});
  const auto number = int(json_["images"].size()) - 1;
  const Json source{{"source", number}};
  Json out{{"sampler", number}};
  if (coding_.webp) {
    use(kWebp, true);
    out["extensions"] = {{kWebp, source}};
  } else {
    out.update(source);
  }
  json_["textures"].push_back(std::move(out));
  return {};
}

int Glb::addMaterial(const DrawMesh& mesh) {
  Json pbr{{"baseColorFactor", {mesh.factor.r, mesh.factor.g, mesh.factor.b, mesh.factor.a}},
           {"metallicFactor", 0},
           {"roughnessFactor", 1}};
  if (mesh.texture >= 0) pbr["baseColorTexture"] = {{"index", mesh.texture}};
  Json out{{"name", mesh.material},
           {"pbrMetallicRoughness", std::move(pbr)},
           {"doubleSided", mesh.doubleSided},
           {"extensions", {{kUnlit, Json::object()}}}};
  if (mesh.alpha == AlphaMode::blend) out["alphaMode"] = "BLEND";
  if (mesh.alpha == AlphaMode::mask) out["alphaMode"] = "MASK", out["alphaCutoff"] = mesh.cutoff;
  json_["materials"].push_back(std::move(out));
  return int(json_["materials"].size()) - 1;
}

void Glb::addBounds(int positions, const glm::vec3& low, const glm::vec3& high) {
  json_["accessors"][std::size_t(positions)]["min"] = {low.x, low.y, low.z};
  json_["accessors"][std::size_t(positions)]["max"] = {high.x, high.y, high.z};
  const glm::vec3 from = coding_.meshopt ? coding_.middle : glm::vec3(0);
  bounds_.add(from + low);
  bounds_.add(from + high);
}

Glb::Json Glb::primitiveOf(const DrawMesh& mesh) {
  Json attributes{{"POSITION", addAttribute(mesh.positions, "VEC3")}};
  Bounds box;
  for (const glm::vec3& p : mesh.positions) box.add(p);
  addBounds(attributes["POSITION"], box.min, box.max);
  if (mesh.texture >= 0 && !mesh.uv.empty()) attributes["TEXCOORD_0"] = addAttribute(mesh.uv, "VEC2");
  if (!mesh.colours.empty()) attributes["COLOR_0"] = addAttribute(mesh.colours, "VEC3");
  const int view = addView(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3), kElementBuffer);
  const int indices = addAccessor(view, kGltfUnsignedInt, "SCALAR", 3 * mesh.triangles.size());
  return {{"attributes", std::move(attributes)}, {"indices", indices}};
}

int Glb::addCodedView(const std::vector<std::byte>& coded, std::size_t count, std::size_t stride, int target,
                      const std::string& filter) {
  use(kMeshopt, true);
  const int view = addView(coded.data(), coded.size(), target);
  Json& json = json_["bufferViews"].back();
  const bool vertices = target == kArrayBuffer;
  Json how{{"buffer", 0},
           {"byteOffset", json["byteOffset"]},
           {"byteLength", json["byteLength"]},
           {"byteStride", stride},
           {"count", count},
           {"mode", vertices ? "ATTRIBUTES" : "TRIANGLES"}};
  if (!filter.empty()) how["filter"] = filter;
  // As those without the extension see it: of a buffer that has no bytes.
  json["buffer"] = 1, json["byteOffset"] = decoded_, json["byteLength"] = count * stride;
  if (vertices) json["byteStride"] = stride;
  json["extensions"] = {{kMeshopt, std::move(how)}};
  decoded_ += count * stride;  // a multiple of four
  return view;
}

int Glb::addPacked(const PackedAttribute& attribute, std::size_t vertices) {
  const int view = addCodedView(attribute.coded, vertices, attribute.stride, kArrayBuffer, attribute.filter);
  const int accessor = addAccessor(view, attribute.componentType, attribute.type.c_str(), vertices);
  if (attribute.normalized) json_["accessors"][std::size_t(accessor)]["normalized"] = true;
  return accessor;
}

Glb::Json Glb::packedPrimitiveOf(const DrawMesh& mesh) {
  DrawMesh moved = mesh;
  for (glm::vec3& p : moved.positions) p -= coding_.middle;
  if (mesh.texture < 0) moved.uv.clear();
  const PackedMesh packed = packMesh(moved, coding_.positionError);
  Json attributes{{"POSITION", addPacked(packed.positions, packed.vertices)}};
  addBounds(attributes["POSITION"], packed.low, packed.high);
  if (!packed.uv.coded.empty()) attributes["TEXCOORD_0"] = addPacked(packed.uv, packed.vertices);
  if (!packed.colour.coded.empty()) attributes["COLOR_0"] = addPacked(packed.colour, packed.vertices);
  const std::size_t count = 3 * packed.triangles;
  const int view = addCodedView(packed.coded, count, sizeof(std::uint32_t), kElementBuffer, "");
  return {{"attributes", std::move(attributes)},
          {"indices", addAccessor(view, kGltfUnsignedInt, "SCALAR", count)}};
}

void Glb::addMesh(const DrawMesh& mesh) {
  const int material = addMaterial(mesh);
  if (mesh.triangles.empty()) return;
  Json primitive = coding_.meshopt ? packedPrimitiveOf(mesh) : primitiveOf(mesh);
  primitive["material"] = material;
  Json& nodes = json_["nodes"];
  if (nodes.is_null()) nodes = Json::array();
  const auto known = std::ranges::find_if(nodes, [&](const Json& each) { return each["name"] == mesh.part; });
  if (known != nodes.end()) {
    json_["meshes"][known->at("mesh").get<std::size_t>()]["primitives"].push_back(std::move(primitive));
    return;
  }
  json_["scenes"][0]["nodes"].push_back(nodes.size());
  nodes.push_back({{"name", mesh.part}, {"mesh", json_["meshes"].size()}});
  if (coding_.meshopt) nodes.back()["translation"] = {coding_.middle.x, coding_.middle.y, coding_.middle.z};
  json_["meshes"].push_back({{"name", mesh.part}, {"primitives", Json::array({std::move(primitive)})}});
}

Result<std::uint64_t> Glb::write(const std::filesystem::path& file) const {
  Json json = json_;
  if (!buffer_.empty()) json["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  if (decoded_ > 0)
    json["buffers"].push_back({{"byteLength", decoded_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
  std::string text = jsonText(json);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t binary = (buffer_.size() + 3) / 4 * 4;
  const std::size_t size = 12 + 8 + text.size() + (binary > 0 ? 8 + binary : 0);
  if (size > kLargestGlb)
    return fail(ErrorKind::tooLarge,
                "would be larger than the 4 GB that a GLB can have: compress meshes and textures",
                file.string());
  std::vector<std::byte> out;
  out.reserve(size);
  for (const std::uint32_t word :
       {0x46546c67U, 2U, std::uint32_t(size), std::uint32_t(text.size()), 0x4e4f534aU})
    put(out, word);
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  out.insert(out.end(), first, first + text.size());
  if (binary > 0) {
    put(out, std::uint32_t(binary));
    put(out, 0x004e4942U);
    out.insert(out.end(), buffer_.begin(), buffer_.end());
    out.resize(size);
  }
  if (Status written = writeFileAtomically(file, out); !written) return tl::unexpected(written.error());
  return size;
}

}  // namespace acentric
