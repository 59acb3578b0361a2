#include "projects/gallery/generator/model.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/export/packed_mesh.h"

namespace acentric::gallery {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

using Json = nlohmann::ordered_json;

constexpr int kFloat = kGltfFloat, kUnsignedInt = kGltfUnsignedInt, kUnsignedShort = kGltfUnsignedShort,
              kUnsignedByte = 5121;
constexpr int kVertices = 34962, kIndices = 34963;
constexpr const char *kMeshopt = "EXT_meshopt_compression", *kInstancing = "EXT_mesh_gpu_instancing";
/// Positions, by their distance from their origin: of what stands in several places, and of what lies where
/// it is told, maybe far away.
constexpr double kInstancedError = 1.0 / 4096, kPlacedError = 1.0 / 65536;
constexpr float kPlaceSteps = 256;  // a metre, or a scale of 1

/// glTF has Y up: (x, y, z) becomes (x, z, -y).
glm::vec3 yUp(const glm::vec3& v) { return {v.x, v.z, -v.y}; }
glm::mat4 yUp(const glm::mat4& m) {
  const glm::mat4 turn(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
  return turn * m * glm::inverse(turn);
}

/// Shortest decimal that reads back as the same float, so that files stay small and equal.
double plain(float v) { return std::stod(fmt::format("{}", v)); }
Json list(std::span<const float> values) {
  Json out = Json::array();
  for (const float v : values) out.push_back(plain(v));
  return out;
}
Json list(const glm::vec3& v) { return list(std::span(glm::value_ptr(v), 3)); }

class Writer {
 public:
  Writer(const Model& model, ModelCoding coding) : model_(model), coding_(coding) {}

  /// JSON without the buffer's uri; the buffer's bytes are in `buffer()`.
  Json document() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "acentric-sample-gallery"}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({Json{{"name", "Gallery"}}});
    writePictures();
    writeMaterials();
    writeThings();
    writeLights();
    Json nodes = Json::array();
    for (std::size_t i = 0; i < root_["nodes"].size(); ++i) nodes.push_back(i);
    root_["scenes"][0]["nodes"] = nodes;
    Json used = Json::array();
    Json required = Json::array();
    for (const auto& [name, isRequired] : extensions_) {
      used.push_back(name);
      if (isRequired) required.push_back(name);
    }
    root_["extensionsUsed"] = used;
    if (!required.empty()) root_["extensionsRequired"] = required;
    root_["buffers"] = Json::array({Json{{"byteLength", buffer_.size()}}});
    if (decoded_ > 0)
      root_["buffers"].push_back(
          {{"byteLength", decoded_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
    return root_;
  }
  const std::vector<std::byte>& buffer() const { return buffer_; }

 private:
  int addView(std::span<const std::byte> bytes, int target) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    root_["bufferViews"].push_back(view);
    return static_cast<int>(root_["bufferViews"].size()) - 1;
  }

  template <class T>
  int addAccessor(const std::vector<T>& values, const char* type, int component, int target,
                  std::size_t count, Json extra = Json::object()) {
    Json accessor{{"bufferView", addView(std::as_bytes(std::span(values)), target)},
                  {"componentType", component},
                  {"count", count},
                  {"type", type}};
    accessor.update(extra);
    root_["accessors"].push_back(accessor);
    return static_cast<int>(root_["accessors"].size()) - 1;
  }

  void writePictures() {
    // 9729 linear, 9987 linear with mipmaps; 10497 repeat, 33071 clamp.
    root_["samplers"] =
        Json::array({Json{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}},
                     Json{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}});
    for (std::size_t i = 0; i < model_.pictures.size(); ++i) {
      const Picture& picture = model_.pictures[i];
      root_["images"].push_back({{"name", picture.name},
                                 {"mimeType", picture.jpeg ? "image/jpeg" : "image/png"},
                                 {"bufferView", addView(picture.bytes, 0)}});
      root_["textures"].push_back(
          {{"name", picture.name}, {"sampler", picture.repeats ? 0 : 1}, {"source", i}});
    }
  }

  void writeMaterials() {
    for (const Material& m : model_.materials) {
      Json pbr{{"baseColorFactor", list(std::span(glm::value_ptr(m.baseColour), 4))},
               {"metallicFactor", plain(m.metallic)},
               {"roughnessFactor", plain(m.roughness)}};
      if (m.picture >= 0) pbr["baseColorTexture"] = {{"index", m.picture}};
      Json out{{"name", m.name}, {"pbrMetallicRoughness", pbr}};
      if (m.normalPicture >= 0) out["normalTexture"] = {{"index", m.normalPicture}};
      if (m.emission != glm::vec3(0)) {
        out["emissiveFactor"] = list(m.emission);
        if (m.emissionStrength != 1) {
          out["extensions"]["KHR_materials_emissive_strength"] = {
              {"emissiveStrength", plain(m.emissionStrength)}};
          extensions_["KHR_materials_emissive_strength"] = false;
        }
      }
      if (m.transmission > 0) {
        out["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", plain(m.transmission)}};
        extensions_["KHR_materials_transmission"] = false;
      }
      if (m.alphaCutoff) {
        out["alphaMode"] = "MASK";
        out["alphaCutoff"] = plain(*m.alphaCutoff);
      }
      if (m.doubleSided) out["doubleSided"] = true;
      root_["materials"].push_back(out);
    }
  }

  bool textured(const Material& material) const {
    return material.picture >= 0 || material.normalPicture >= 0;
  }

  /// Rows as `coded` has them; those without the extension see them in a buffer that has no bytes.
  int addCodedAccessor(const std::vector<std::byte>& coded, std::size_t rows, std::size_t stride,
                       const std::string& filter, int target, int component, bool normalized,
                       const std::string& type, Json extra = Json::object()) {
    const int at = addView(coded, target);
    Json& view = root_["bufferViews"].back();
    const bool attributes = target == kVertices;
    Json how{{"buffer", 0},
             {"byteOffset", view["byteOffset"]},
             {"byteLength", view["byteLength"]},
             {"byteStride", stride},
             {"count", rows},
             {"mode", attributes ? "ATTRIBUTES" : "TRIANGLES"}};
    if (!filter.empty()) how["filter"] = filter;
    view["buffer"] = 1, view["byteOffset"] = decoded_, view["byteLength"] = rows * stride;
    if (attributes) view["byteStride"] = stride;
    view["extensions"] = {{kMeshopt, how}};
    decoded_ += rows * stride;  // a multiple of four
    extensions_[kMeshopt] = true;
    Json accessor{{"bufferView", at}, {"componentType", component}, {"count", rows}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    accessor.update(extra);
    root_["accessors"].push_back(accessor);
    return static_cast<int>(root_["accessors"].size()) - 1;
  }

  Json compactPrimitive(const Part& part, double error) {
    const Shape& shape = part.shape;
    const Material& material = model_.materials[static_cast<std::size_t>(part.material)];
    DrawMesh mesh;
    std::vector<glm::vec3> normals;
    for (const glm::vec3& p : shape.positions) mesh.positions.push_back(yUp(p));
    for (const glm::vec3& n : shape.normals) normals.push_back(yUp(n));
    if (textured(material)) {
      mesh.uv = shape.uv;
      if (material.metres > 0)
        for (glm::vec2& t : mesh.uv) t /= material.metres;
    }
    mesh.colours = shape.colours;
    for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3)
      mesh.triangles.emplace_back(shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]);
    const PackedMesh packed = packMesh(mesh, error, normals);
    const auto add = [&](const PackedAttribute& a, Json extra = Json::object()) {
      return addCodedAccessor(a.coded, packed.vertices, a.stride, a.filter, kVertices, a.componentType,
                              a.normalized, a.type, std::move(extra));
    };
    Json attributes;
    attributes["POSITION"] = add(packed.positions, {{"min", list(packed.low)}, {"max", list(packed.high)}});
    attributes["NORMAL"] = add(packed.normals);
    extensions_["KHR_mesh_quantization"] = true;  // its bytes
    if (!packed.uv.coded.empty()) attributes["TEXCOORD_0"] = add(packed.uv);
    if (!packed.colour.coded.empty()) attributes["COLOR_0"] = add(packed.colour);
    Json out{{"attributes", attributes}};
    out["indices"] = addCodedAccessor(packed.coded, 3 * packed.triangles, sizeof(std::uint32_t), "", kIndices,
                                      kUnsignedInt, false, "SCALAR");
    out["material"] = part.material;
    return out;
  }

  /// EXT_mesh_gpu_instancing.
  Json instances(const std::vector<glm::mat4>& placements) {
    std::vector<glm::vec3> places, scales;
    std::vector<glm::i16vec4> turns;
    const auto stepped = [](float v) { return std::round(v * kPlaceSteps) / kPlaceSteps; };
    for (const glm::mat4& placement : placements) {
      const glm::mat4 m = yUp(placement);
      const float scale = stepped(glm::length(glm::vec3(m[0])));
      const glm::quat turn = glm::quat_cast(glm::mat3(
          glm::normalize(glm::vec3(m[0])), glm::normalize(glm::vec3(m[1])), glm::normalize(glm::vec3(m[2]))));
      require(scale > 0 && glm::determinant(glm::mat3(m)) > 0, "a placement turns and scales");
      places.emplace_back(stepped(m[3].x), stepped(m[3].y), stepped(m[3].z));
      turns.emplace_back(glm::round(32767.0f * glm::vec4(turn.x, turn.y, turn.z, turn.w)));
      scales.emplace_back(scale);
    }
    const auto add = [&](const auto& rows, const char* type, int component, bool normalized) {
      constexpr std::size_t kStride = sizeof(rows[0]);
      return addCodedAccessor(codedRows(rows.data(), rows.size(), kStride), rows.size(), kStride, "",
                              kVertices, component, normalized, type);
    };
    extensions_[kInstancing] = true;
    return {{"attributes",
             {{"TRANSLATION", add(places, "VEC3", kFloat, false)},
              {"ROTATION", add(turns, "VEC4", kGltfShort, true)},
              {"SCALE", add(scales, "VEC3", kFloat, false)}}}};
  }

  Json primitive(const Part& part, bool instanced) {
    if (coding_ == ModelCoding::compact)
      return compactPrimitive(part, instanced ? kInstancedError : kPlacedError);
    const Shape& shape = part.shape;
    const Material& material = model_.materials[static_cast<std::size_t>(part.material)];
    std::vector<glm::vec3> positions, normals;
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : shape.positions) {
      positions.push_back(yUp(p));
      low = glm::min(low, positions.back());
      high = glm::max(high, positions.back());
    }
    for (const glm::vec3& n : shape.normals) normals.push_back(yUp(n));
    const std::size_t count = positions.size();
    Json attributes;
    attributes["POSITION"] =
        addAccessor(positions, "VEC3", kFloat, kVertices, count, {{"min", list(low)}, {"max", list(high)}});
    attributes["NORMAL"] = addAccessor(normals, "VEC3", kFloat, kVertices, count);
    if (textured(material)) {
      std::vector<glm::vec2> uv = shape.uv;
      if (material.metres > 0)
        for (glm::vec2& t : uv) t /= material.metres;
      attributes["TEXCOORD_0"] = addAccessor(uv, "VEC2", kFloat, kVertices, count);
    }
    if (!shape.colours.empty()) {
      std::vector<std::array<unsigned char, 4>> colours;
      for (const glm::vec3& c : shape.colours) {
        const glm::vec3 v = glm::round(glm::clamp(c, 0.0f, 1.0f) * 255.0f);
        colours.push_back({static_cast<unsigned char>(v.x), static_cast<unsigned char>(v.y),
                           static_cast<unsigned char>(v.z), 255});
      }
      attributes["COLOR_0"] =
          addAccessor(colours, "VEC4", kUnsignedByte, kVertices, count, {{"normalized", true}});
    }
    Json out{{"attributes", attributes}};
    if (count <= 65535) {
      const std::vector<std::uint16_t> narrow(shape.indices.begin(), shape.indices.end());
      out["indices"] = addAccessor(narrow, "SCALAR", kUnsignedShort, kIndices, narrow.size());
    } else {
      out["indices"] = addAccessor(shape.indices, "SCALAR", kUnsignedInt, kIndices, shape.indices.size());
    }
    out["material"] = part.material;
    return out;
  }

  void writeThings() {
    for (const Thing& thing : model_.things) {
      Json primitives = Json::array();
      for (const Part& part : thing.parts)
        if (!part.shape.indices.empty()) primitives.push_back(primitive(part, thing.placements.size() > 1));
      root_["meshes"].push_back({{"name", thing.name}, {"primitives", primitives}});
      const std::size_t mesh = root_["meshes"].size() - 1;
      if (coding_ == ModelCoding::compact && thing.placements.size() > 1) {
        root_["nodes"].push_back({{"name", thing.name},
                                  {"mesh", mesh},
                                  {"extensions", {{kInstancing, instances(thing.placements)}}}});
        continue;
      }
      for (std::size_t i = 0; i < thing.placements.size(); ++i) {
        Json node{
            {"name", thing.placements.size() > 1 ? fmt::format("{} {}", thing.name, i + 1) : thing.name},
            {"mesh", mesh}};
        if (thing.placements[i] != glm::mat4(1)) {
          const glm::mat4 matrix = yUp(thing.placements[i]);
          node["matrix"] = list(std::span(glm::value_ptr(matrix), 16));
        }
        root_["nodes"].push_back(node);
      }
    }
  }

  void writeLights() {
    Json lights = Json::array();
    for (const Light& light : model_.lights) {
      lights.push_back({{"name", light.name},
                        {"type", light.directional ? "directional" : "point"},
                        {"color", list(light.colour)},
                        {"intensity", plain(light.intensity)}});
      Json node{{"name", light.name},
                {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}};
      if (light.directional) {
        // A light shines along its node's -Z: the shortest turn from there to its direction.
        const glm::vec3 to = glm::normalize(yUp(light.direction)), from(0, 0, -1);
        const glm::vec4 turn(glm::cross(from, to), 1 + glm::dot(from, to));
        const glm::vec4 unit = glm::normalize(turn);
        node["rotation"] = list(std::span(glm::value_ptr(unit), 4));
      } else {
        node["translation"] = list(yUp(light.position));
      }
      root_["nodes"].push_back(node);
    }
    if (lights.empty()) return;
    root_["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    extensions_["KHR_lights_punctual"] = false;
  }

  const Model& model_;
  Json root_ = Json::object();
  std::vector<std::byte> buffer_;
  ModelCoding coding_;
  std::map<std::string, bool> extensions_;  ///< is it required?
  std::size_t decoded_ = 0;                 ///< bytes of what is coded, once it is decoded
};

void appendWord(std::vector<std::byte>& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::array<std::byte, 4> bytes{};
  std::memcpy(bytes.data(), &word, 4);
  out.insert(out.end(), bytes.begin(), bytes.end());
}

std::vector<std::byte> binaryFile(std::string json, std::vector<std::byte> buffer) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4);
  std::vector<std::byte> out;
  appendWord(out, 0x46546C67);  // "glTF"
  appendWord(out, 2);
  appendWord(out, 12 + 8 + json.size() + 8 + buffer.size());
  appendWord(out, json.size());
  appendWord(out, 0x4E4F534A);  // "JSON"
  const auto text = std::as_bytes(std::span(json));
  out.insert(out.end(), text.begin(), text.end());
  appendWord(out, buffer.size());
  appendWord(out, 0x004E4942);  // "BIN"
  out.insert(out.end(), buffer.begin(), buffer.end());
  return out;
}

}  // namespace

int Model::add(Picture picture) {
  pictures.push_back(std::move(picture));
  return static_cast<int>(pictures.size()) - 1;
}
int Model::add(Material material) {
  materials.push_back(std::move(material));
  return static_cast<int>(materials.size()) - 1;
}
void Model::add(std::string name, int material, Shape shape) {
  things.push_back({std::move(name), {{material, std::move(shape)}}, {glm::mat4(1)}});
}

Status writeModel(const Model& model, const std::filesystem::path& path, ModelCoding coding) {
  const std::string ending = path.extension().string();
  if (ending != ".glb" && ending != ".gltf")
    return fail(ErrorKind::invalidArgument, "the name must end in .glb or .gltf", path.string());
  Writer writer(model, coding);
  Json document = writer.document();
  if (ending == ".glb") return writeFileAtomically(path, binaryFile(jsonText(document), writer.buffer()));
  std::filesystem::path buffer = path;
  buffer.replace_extension(".bin");
  document["buffers"][0]["uri"] = buffer.filename().string();
  if (const Status done = writeFileAtomically(buffer, writer.buffer()); !done) return done;
  return writeTextAtomically(path, jsonText(document, 2) + "\n");
}

}  // namespace acentric::gallery
