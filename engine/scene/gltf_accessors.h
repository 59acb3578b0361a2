#pragma once
/// Numbers out of a glTF file's buffers, every offset and count checked first. Private to this folder.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace tinygltf {
class Model;
}

namespace acentric {

/// `count` rows of `components` numbers.
struct GltfNumbers {
  std::vector<float> values;
  int components = 0;
  std::size_t count = 0;
};

/// Integers become fractions of their range where the accessor says normalized, or where `normalize` is set.
Result<GltfNumbers> readGltfNumbers(const tinygltf::Model& model, int accessor, bool normalize = false);
Result<std::vector<std::uint32_t>> readGltfIndices(const tinygltf::Model& model, int accessor);
/// The bytes of a buffer view.
struct GltfBytes {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};
Result<GltfBytes> readGltfView(const tinygltf::Model& model, int bufferView);

}  // namespace acentric
