#include "engine/scene/gltf_compression.h"

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/scene/gltf_accessors.h"

namespace acentric {
namespace {

using Json = nlohmann::json;
constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// The object `name` of `node`'s extensions; null where there is none.
const Json* extensionOf(const Json& node, const char* name) {
  if (!node.is_object()) return nullptr;
  const auto extensions = node.find("extensions");
  if (extensions == node.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found != extensions->end() && found->is_object() ? &*found : nullptr;
}

/// A whole number, at most 2^53; `otherwise` where the key is missing.
Result<std::size_t> sizeOf(const Json& object, const char* key, std::size_t otherwise,
                           const std::string& what) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  constexpr std::uint64_t kMost = std::uint64_t(1) << 53;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kMost)
    return malformed(fmt::format("{}: {} is not a whole number", what, key));
  return std::size_t(found->get<std::uint64_t>());
}

std::string textOf(const Json& object, const char* key, const char* otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

Json* arrayOf(Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_array() ? &*found : nullptr;
}

Result<GltfCompression::View> viewOf(const Json& meshopt, int index) {
  const std::string what = fmt::format("buffer view {}, {}", index, kMeshopt);
  GltfCompression::View view;
  view.bufferView = index;
  struct Field {
    const char* key;
    std::size_t* value;
  };
  std::size_t buffer = 0;
  for (const Field& field : {Field{"buffer", &buffer},
                             {"byteOffset", &view.offset},
                             {"byteLength", &view.length},
                             {"byteStride", &view.stride},
                             {"count", &view.count}}) {
    const auto value = sizeOf(meshopt, field.key, 0, what);
    if (!value) return tl::unexpected(value.error());
    *field.value = *value;
  }
  if (buffer > 1u << 30) return malformed(fmt::format("{}: buffer {} does not exist", what, buffer));
  view.buffer = int(buffer);
  view.mode = textOf(meshopt, "mode", "");
  view.filter = textOf(meshopt, "filter", "NONE");
  return view;
}

/// Buffers that only stand for what is decoded have no bytes of their own; tinygltf would take the GLB's
/// chunk for them, or refuse them.
void fillStandIns(Json& json, bool binary, const std::set<std::size_t>& replaced) {
  Json* buffers = arrayOf(json, "buffers");
  if (buffers == nullptr) return;
  for (std::size_t b = 0; b < buffers->size(); ++b) {
    Json& buffer = (*buffers)[b];
    const bool chunk = binary && b == 0 && extensionOf(buffer, kMeshopt) == nullptr;
    if (!buffer.is_object() || buffer.contains("uri") || chunk) continue;
    if (!replaced.contains(b) && extensionOf(buffer, kMeshopt) == nullptr) continue;
    buffer["uri"] = "data:application/octet-stream;base64,AA==";
    buffer["byteLength"] = 1;
  }
}

Status takeViews(Json& json, bool binary, GltfCompression& out) {
  Json* views = arrayOf(json, "bufferViews");
  if (views == nullptr) return {};
  std::set<std::size_t> replaced;
  for (std::size_t v = 0; v < views->size(); ++v) {
    Json& node = (*views)[v];
    const Json* meshopt = extensionOf(node, kMeshopt);
    if (meshopt == nullptr) continue;
    auto view = viewOf(*meshopt, int(v));
    if (!view) return tl::unexpected(view.error());
    out.views.push_back(std::move(*view));
    const auto buffer = sizeOf(node, "buffer", 0, fmt::format("buffer view {}", v));
    if (!buffer) return tl::unexpected(buffer.error());
    replaced.insert(*buffer);
    node.erase("extensions");
  }
  if (!out.views.empty()) fillStandIns(json, binary, replaced);
  return {};
}

Status takePrimitives(Json& json, GltfCompression& out) {
  Json* meshes = arrayOf(json, "meshes");
  if (meshes == nullptr) return {};
  for (std::size_t m = 0; m < meshes->size(); ++m) {
    Json* primitives = (*meshes)[m].is_object() ? arrayOf((*meshes)[m], "primitives") : nullptr;
    if (primitives == nullptr) continue;
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      const Json* draco = extensionOf((*primitives)[p], kDraco);
      if (draco == nullptr) continue;
      const std::string what = fmt::format("mesh {}, primitive {}, {}", m, p, kDraco);
      GltfCompression::Primitive primitive{int(m), int(p), 0, {}};
      const auto view = sizeOf(*draco, "bufferView", std::size_t(1) << 40, what);
      if (!view) return tl::unexpected(view.error());
      if (*view > 1u << 30) return malformed(fmt::format("{}: it names no buffer view", what));
      primitive.bufferView = int(*view);
      const auto attributes = draco->find("attributes");
      if (attributes == draco->end() || !attributes->is_object())
        return malformed(fmt::format("{}: it names no attributes", what));
      for (const auto& [name, id] : attributes->items()) {
        if (!id.is_number_unsigned() || id.get<std::uint64_t>() > 1u << 30)
          return malformed(fmt::format("{}: attribute {} has no sound number", what, name));
        primitive.attributes[name] = int(id.get<std::uint64_t>());
      }
      out.primitives.push_back(std::move(primitive));
      (*primitives)[p].erase("indices");  // tinygltf refuses indices without a buffer view
    }
  }
  return {};
}

/// What `length` encoded bytes can hold at most: a triangle and an index take a byte each, 64 bytes of rows
/// one.
bool plausible(const GltfCompression::View& view) {
  if (view.mode == "ATTRIBUTES")
    return view.count <= 64 * view.length / std::max<std::size_t>(view.stride, 1);
  return view.count <= (view.mode == "TRIANGLES" ? 3 : 1) * view.length;
}

Status checkView(const GltfCompression::View& view, const std::string& what) {
  const bool rows = view.mode == "ATTRIBUTES";
  if (!rows && view.mode != "TRIANGLES" && view.mode != "INDICES")
    return fail(ErrorKind::unsupported,
                fmt::format("{}: its mode '{}' is not known; export the file without it, "
                            "or with gltfpack 0.15 or later",
                            what, view.mode));
  const bool strideFits = rows ? view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0
                               : view.stride == 2 || view.stride == 4;
  if (!strideFits) return malformed(fmt::format("{}: rows of {} bytes", what, view.stride));
  if (view.mode == "TRIANGLES" && view.count % 3 != 0)
    return malformed(fmt::format("{}: {} indices are no triangles", what, view.count));
  if (!plausible(view))
    return malformed(fmt::format("{}: {} bytes cannot hold {} rows", what, view.length, view.count));
  const bool filterFits = view.filter == "NONE" || (rows && view.filter == "EXPONENTIAL") ||
                          (rows && view.filter == "QUATERNION" && view.stride == 8) ||
                          (rows && view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8));
  if (!filterFits)
    return malformed(fmt::format("{}: filter '{}' of {} with rows of {} bytes", what, view.filter, view.mode,
                                 view.stride));
  return {};
}

int decodeInto(std::vector<unsigned char>& out, const GltfCompression::View& view,
               const unsigned char* data) {
  if (view.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, data, view.length);
  if (view.mode == "INDICES")
    return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, data, view.length);
  return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, data, view.length);
}

Status decodeView(const GltfCompression::View& view, tinygltf::Model& model, std::size_t& decodedBytes) {
  const std::string what = fmt::format("buffer view {}, {}", view.bufferView, kMeshopt);
  if (Status sound = checkView(view, what); !sound) return sound;
  if (std::size_t(view.buffer) >= model.buffers.size())
    return malformed(fmt::format("{}: buffer {} does not exist", what, view.buffer));
  const auto& data = model.buffers[std::size_t(view.buffer)].data;
  if (view.offset > data.size() || view.length > data.size() - view.offset)
    return malformed(
        fmt::format("{}: it reaches past the end of buffer {} ({} bytes)", what, view.buffer, data.size()));
  decodedBytes += view.count * view.stride;
  if (decodedBytes > kMaxDecodedBytes)
    return fail(ErrorKind::tooLarge, "its compressed geometry decodes to more than 4 GiB; split it");
  std::vector<unsigned char> out(view.count * view.stride);
  if (view.count > 0) {
    if (decodeInto(out, view, data.data() + view.offset) != 0)
      return malformed(fmt::format("{}: its data is damaged", what));
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  }
  tinygltf::BufferView& target = model.bufferViews[std::size_t(view.bufferView)];
  target.byteLength = out.size();
  target.byteOffset = 0;
  target.buffer = int(model.buffers.size());
  model.buffers.emplace_back().data = std::move(out);
  return {};
}

}  // namespace

Result<GltfCompression> takeCompression(Json& json, bool binary) {
  GltfCompression out;
  if (Status taken = takeViews(json, binary, out); !taken) return tl::unexpected(taken.error());
  if (Status taken = takePrimitives(json, out); !taken) return tl::unexpected(taken.error());
  return out;
}

Status decompress(const GltfCompression& compression, tinygltf::Model& model) {
  std::size_t decodedBytes = 0;
  for (const GltfCompression::View& view : compression.views) {
    if (std::size_t(view.bufferView) >= model.bufferViews.size())
      return malformed(fmt::format("buffer view {} does not exist", view.bufferView));
    if (Status decoded = decodeView(view, model, decodedBytes); !decoded) return decoded;
  }
  for (const GltfCompression::Primitive& primitive : compression.primitives)
    if (Status decoded = decodeDraco(primitive, model, decodedBytes); !decoded) return decoded;
  return {};
}

int addDecodedView(tinygltf::Model& model, std::vector<unsigned char> bytes, std::size_t stride) {
  tinygltf::BufferView& view = model.bufferViews.emplace_back();
  view.buffer = int(model.buffers.size());
  view.byteLength = bytes.size();
  view.byteStride = stride;
  model.buffers.emplace_back().data = std::move(bytes);
  return int(model.bufferViews.size()) - 1;
}

}  // namespace acentric
