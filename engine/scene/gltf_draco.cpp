#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cstring>

#include "engine/scene/gltf_accessors.h"
#include "engine/scene/gltf_compression.h"

namespace acentric {
namespace {

/// The attribute's values as the accessor declares them, point by point.
template <class T>
bool valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
              std::vector<unsigned char>& out) {
  const std::size_t row = sizeof(T) * std::size_t(components);
  out.resize(std::size_t(mesh.num_points()) * row);
  std::vector<T> values(static_cast<std::size_t>(components));
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    if (!attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(p)),
                                   static_cast<std::int8_t>(components), values.data()))
      return false;
    std::memcpy(out.data() + p * row, values.data(), row);
  }
  return true;
}

bool valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int componentType,
              int components, std::vector<unsigned char>& out) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return valuesOf<std::int8_t>(mesh, attribute, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return valuesOf<std::uint8_t>(mesh, attribute, components, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return valuesOf<std::int16_t>(mesh, attribute, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return valuesOf<std::uint16_t>(mesh, attribute, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return valuesOf<std::uint32_t>(mesh, attribute, components, out);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return valuesOf<float>(mesh, attribute, components, out);
    default:
      return false;
  }
}

int addAccessor(tinygltf::Model& model, tinygltf::Accessor accessor, std::vector<unsigned char> bytes,
                std::size_t count) {
  accessor.bufferView = addDecodedView(model, std::move(bytes), 0);
  accessor.byteOffset = 0;
  accessor.count = count;
  model.accessors.push_back(std::move(accessor));
  return int(model.accessors.size()) - 1;
}

}  // namespace

Status decodeDraco(const GltfCompression::Primitive& compressed, tinygltf::Model& model,
                   std::size_t& decodedBytes) {
  const std::string what =
      fmt::format("mesh {}, primitive {}, KHR_draco_mesh_compression", compressed.mesh, compressed.primitive);
  const auto malformed = [&](const char* why) {
    return fail(ErrorKind::malformed, fmt::format("{}: {}", what, why));
  };
  if (std::size_t(compressed.mesh) >= model.meshes.size() ||
      std::size_t(compressed.primitive) >= model.meshes[std::size_t(compressed.mesh)].primitives.size())
    return malformed("there is no such primitive");
  const auto bytes = readGltfView(model, compressed.bufferView);
  if (!bytes) return tl::unexpected(bytes.error());
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes->data), bytes->size);
  const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!type.ok() || type.value() != draco::TRIANGULAR_MESH) return malformed("its data is no Draco mesh");
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return malformed("its data is damaged");
  const draco::Mesh& mesh = *decoded.value();

  tinygltf::Primitive& primitive =
      model.meshes[std::size_t(compressed.mesh)].primitives[std::size_t(compressed.primitive)];
  const auto add = [&](std::size_t size) {
    decodedBytes += size;
    return decodedBytes <= kMaxDecodedBytes;
  };
  const auto tooLarge = [&] {
    return fail(ErrorKind::tooLarge, "its compressed geometry decodes to more than 4 GiB; split it");
  };
  for (const auto& [name, id] : compressed.attributes) {
    const auto declared = primitive.attributes.find(name);
    if (declared == primitive.attributes.end()) continue;
    if (declared->second < 0 || std::size_t(declared->second) >= model.accessors.size())
      return malformed("an attribute's accessor does not exist");
    const tinygltf::Accessor accessor = model.accessors[std::size_t(declared->second)];
    const int components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
    const int size = tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType));
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(std::uint32_t(id));
    if (attribute == nullptr || components <= 0 || components > 4 || size <= 0)
      return malformed("an attribute is not in its data");
    if (!add(std::size_t(mesh.num_points()) * std::size_t(components * size))) return tooLarge();
    std::vector<unsigned char> values;
    if (!valuesOf(mesh, *attribute, accessor.componentType, components, values))
      return malformed("an attribute has values that its accessor cannot hold");
    declared->second = addAccessor(model, accessor, std::move(values), mesh.num_points());
  }

  if (!add(std::size_t(mesh.num_faces()) * 3 * sizeof(std::uint32_t))) return tooLarge();
  std::vector<unsigned char> indices(std::size_t(mesh.num_faces()) * 3 * sizeof(std::uint32_t));
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = mesh.face(draco::FaceIndex(f))[corner].value();
      std::memcpy(indices.data() + (std::size_t(f) * 3 + corner) * sizeof index, &index, sizeof index);
    }
  tinygltf::Accessor accessor;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  primitive.indices = addAccessor(model, accessor, std::move(indices), std::size_t(mesh.num_faces()) * 3);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;  // a strip too is decoded to a list
  return {};
}

}  // namespace acentric
