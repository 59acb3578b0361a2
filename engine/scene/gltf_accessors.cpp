#include "engine/scene/gltf_accessors.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace acentric {
namespace {

constexpr std::size_t kMaxCount = std::size_t(1) << 31;
/// An accessor without data is all zeros; nothing real has so many.
constexpr std::size_t kMaxZeros = std::size_t(1) << 26;

struct Rows {
  const unsigned char* data = nullptr;  ///< null = all zero
  std::size_t stride = 0;
  std::size_t count = 0;
  int components = 0;
  int componentType = 0;
  bool normalized = false;
};

Result<Rows> rowsAt(const tinygltf::Model& model, int bufferView, std::size_t byteOffset, std::size_t stride,
                    Rows rows, const std::string& what) {
  const int componentSize = tinygltf::GetComponentSizeInBytes(std::uint32_t(rows.componentType));
  if (componentSize <= 0)
    return malformed(fmt::format("{} has an unknown component type {}", what, rows.componentType));
  const auto view = readGltfView(model, bufferView);
  if (!view) return tl::unexpected(view.error());
  const std::size_t rowSize = std::size_t(componentSize) * std::size_t(rows.components);
  rows.stride = stride ? stride : rowSize;
  if (rows.stride < rowSize || rows.stride > 4096)
    return malformed(fmt::format("{} has a byte stride of {}", what, stride));
  const bool fits =
      rows.count == 0 || (byteOffset <= view->size && rowSize <= view->size - byteOffset &&
                          (rows.count - 1) <= (view->size - byteOffset - rowSize) / rows.stride);
  if (!fits)
    return malformed(
        fmt::format("{} reaches past the end of buffer view {} ({} bytes)", what, bufferView, view->size));
  rows.data = view->data + byteOffset;
  return rows;
}

template <class T>
T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class T, class Out, class Convert>
void convertRows(const Rows& rows, Out* out, const Convert& convert) {
  for (std::size_t i = 0; i < rows.count; ++i)
    for (int c = 0; c < rows.components; ++c)
      *out++ = convert(load<T>(rows.data + i * rows.stride + std::size_t(c) * sizeof(T)));
}

template <class T>
void toFloats(const Rows& rows, float* out) {
  if constexpr (std::is_floating_point_v<T>) {
    convertRows<T>(rows, out, [](T v) { return float(v); });
  } else if (rows.normalized) {
    const float scale = 1.0f / float(std::numeric_limits<T>::max());
    convertRows<T>(rows, out, [scale](T v) { return std::max(float(v) * scale, -1.0f); });
  } else {
    convertRows<T>(rows, out, [](T v) { return float(v); });
  }
}

void toFloats(const Rows& rows, float* out) {
  switch (rows.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return toFloats<std::int8_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return toFloats<std::uint8_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return toFloats<std::int16_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return toFloats<std::uint16_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return toFloats<std::int32_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return toFloats<std::uint32_t>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return toFloats<float>(rows, out);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return toFloats<double>(rows, out);
    default:
      return;
  }
}

bool toIntegers(const Rows& rows, std::uint32_t* out) {
  const auto widen = [](auto v) { return std::uint32_t(v); };
  switch (rows.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      convertRows<std::uint8_t>(rows, out, widen);
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      convertRows<std::uint16_t>(rows, out, widen);
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      convertRows<std::uint32_t>(rows, out, widen);
      return true;
    default:
      return false;
  }
}

struct Accessor {
  const tinygltf::Accessor* source = nullptr;
  Rows rows;
  std::string what;
};

Result<Accessor> accessorAt(const tinygltf::Model& model, int index) {
  if (index < 0 || std::size_t(index) >= model.accessors.size())
    return malformed(fmt::format("accessor {} does not exist", index));
  Accessor out{&model.accessors[std::size_t(index)], {}, fmt::format("accessor {}", index)};
  const tinygltf::Accessor& source = *out.source;
  out.rows.components = tinygltf::GetNumComponentsInType(std::uint32_t(source.type));
  if (out.rows.components <= 0) return malformed(out.what + " has an unknown type");
  out.rows.count = source.count;
  out.rows.componentType = source.componentType;
  out.rows.normalized = source.normalized;
  if (source.count > kMaxCount)
    return fail(ErrorKind::tooLarge,
                fmt::format("{} has {} elements; the limit is 2^31", out.what, source.count));
  if (source.bufferView < 0) {
    if (source.count > kMaxZeros)
      return fail(ErrorKind::tooLarge, fmt::format("{} has {} elements and no data", out.what, source.count));
    return out;
  }
  if (std::size_t(source.bufferView) >= model.bufferViews.size())
    return malformed(
        fmt::format("{} names buffer view {}, which does not exist", out.what, source.bufferView));
  const std::size_t stride = model.bufferViews[std::size_t(source.bufferView)].byteStride;
  auto rows = rowsAt(model, source.bufferView, source.byteOffset, stride, out.rows, out.what);
  if (!rows) return tl::unexpected(rows.error());
  out.rows = *rows;
  return out;
}

/// Replaces the rows that a sparse accessor lists.
Status overlaySparse(const tinygltf::Model& model, const Accessor& accessor, std::vector<float>& values) {
  const auto& sparse = accessor.source->sparse;
  if (!sparse.isSparse) return {};
  if (sparse.count < 0 || std::size_t(sparse.count) > accessor.rows.count || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0)
    return malformed(accessor.what + " has broken sparse data");
  Rows wanted;
  wanted.count = std::size_t(sparse.count);
  wanted.components = 1;
  wanted.componentType = sparse.indices.componentType;
  const auto indexRows = rowsAt(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), 0,
                                wanted, accessor.what + " (sparse indices)");
  if (!indexRows) return tl::unexpected(indexRows.error());
  std::vector<std::uint32_t> indices(wanted.count);
  if (!toIntegers(*indexRows, indices.data())) return malformed(accessor.what + " has broken sparse indices");

  Rows valueWanted = accessor.rows;
  valueWanted.count = wanted.count;
  const auto valueRows = rowsAt(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), 0,
                                valueWanted, accessor.what + " (sparse values)");
  if (!valueRows) return tl::unexpected(valueRows.error());
  const std::size_t components = std::size_t(accessor.rows.components);
  std::vector<float> replacement(wanted.count * components);
  toFloats(*valueRows, replacement.data());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= accessor.rows.count)
      return malformed(accessor.what + " has a sparse index out of range");
    std::copy_n(&replacement[i * components], components, &values[indices[i] * components]);
  }
  return {};
}

}  // namespace

Result<GltfBytes> readGltfView(const tinygltf::Model& model, int bufferView) {
  if (bufferView < 0 || std::size_t(bufferView) >= model.bufferViews.size())
    return malformed(fmt::format("buffer view {} does not exist", bufferView));
  const tinygltf::BufferView& view = model.bufferViews[std::size_t(bufferView)];
  if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size())
    return malformed(
        fmt::format("buffer view {} names buffer {}, which does not exist", bufferView, view.buffer));
  const std::vector<unsigned char>& data = model.buffers[std::size_t(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return malformed(fmt::format("buffer view {} reaches past the end of buffer {} ({} bytes)", bufferView,
                                 view.buffer, data.size()));
  return GltfBytes{data.data() + view.byteOffset, view.byteLength};
}

Result<GltfNumbers> readGltfNumbers(const tinygltf::Model& model, int index, bool normalize) {
  auto accessor = accessorAt(model, index);
  if (!accessor) return tl::unexpected(accessor.error());
  accessor->rows.normalized = accessor->rows.normalized || normalize;
  GltfNumbers out;
  out.components = accessor->rows.components;
  out.count = accessor->rows.count;
  out.values.resize(out.count * std::size_t(out.components));
  if (accessor->rows.data) toFloats(accessor->rows, out.values.data());
  if (auto status = overlaySparse(model, *accessor, out.values); !status)
    return tl::unexpected(status.error());
  return out;
}

Result<std::vector<std::uint32_t>> readGltfIndices(const tinygltf::Model& model, int index) {
  const auto accessor = accessorAt(model, index);
  if (!accessor) return tl::unexpected(accessor.error());
  if (accessor->rows.components != 1) return malformed(accessor->what + " holds indices but is not scalar");
  if (accessor->source->sparse.isSparse) return malformed(accessor->what + " holds indices and is sparse");
  std::vector<std::uint32_t> out(accessor->rows.count);
  if (accessor->rows.data && !toIntegers(accessor->rows, out.data()))
    return malformed(accessor->what + " holds indices that are not unsigned integers");
  return out;
}

}  // namespace acentric
