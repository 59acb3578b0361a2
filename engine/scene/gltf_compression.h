#pragma once
/// Compressed geometry of a glTF file (EXT_meshopt_compression, KHR_draco_mesh_compression). tinygltf knows
/// neither and refuses what they leave out: before it reads the JSON, what they say is taken out of it; after
/// that, what is decoded stands in ordinary buffers, views and accessors. Private to this folder.

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace tinygltf {
class Model;
}

namespace acentric {

struct GltfCompression {
  /// A buffer view whose bytes are encoded elsewhere.
  struct View {
    int bufferView = 0, buffer = 0;
    std::size_t offset = 0, length = 0;  ///< of what is encoded, bytes
    std::size_t stride = 0, count = 0;   ///< of what is decoded: bytes a row, rows
    std::string mode, filter;
  };
  /// A primitive whose indices and attributes are one Draco mesh.
  struct Primitive {
    int mesh = 0, primitive = 0, bufferView = 0;
    std::map<std::string, int> attributes;  ///< Draco's unique id by name
  };
  std::vector<View> views;
  std::vector<Primitive> primitives;

  bool any() const { return !views.empty() || !primitives.empty(); }
};

/// Takes it out of `json`, so that tinygltf reads the rest. `binary`: the first buffer may be the GLB's own
/// chunk.
Result<GltfCompression> takeCompression(nlohmann::json& json, bool binary);

/// Decodes into `model`. Sizes are checked against the encoded bytes before memory is taken for them.
Status decompress(const GltfCompression& compression, tinygltf::Model& model);

/// Bytes that the compressed parts of one file may decode to together.
inline constexpr std::size_t kMaxDecodedBytes = std::size_t(4) << 30;

/// Adds a buffer of decoded bytes and a view of it all; gives the view.
int addDecodedView(tinygltf::Model& model, std::vector<unsigned char> bytes, std::size_t stride);

/// One Draco mesh; `decodedBytes` counts against kMaxDecodedBytes.
Status decodeDraco(const GltfCompression::Primitive& primitive, tinygltf::Model& model,
                   std::size_t& decodedBytes);

}  // namespace acentric
