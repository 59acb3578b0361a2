#include "engine/export/packed_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/contract.h"

namespace acentric {
namespace {

/// Of the extension: version 0 of vertices, 1 of indices.
constexpr int kVertexVersion = 0, kIndexVersion = 1;
constexpr int kMostBits = 23;  // rounded, 24 could overflow
constexpr int kUvBits = 20;    // of coordinates outside of 0..1
constexpr const char* kExponential = "EXPONENTIAL";

/// Attributes before they are coded, one after the other.
struct Stream {
  std::vector<std::byte> bytes;
  std::size_t stride = 0;
};

/// Values of `components` floats with one exponent for each.
Stream exponentialStream(const float* values, std::size_t count, std::size_t components, int bits) {
  Stream out{{}, components * sizeof(float)};
  out.bytes.resize(count * out.stride);
  meshopt_encodeFilterExp(out.bytes.data(), count, out.stride, bits, values);
  return out;
}

/// Unit vectors, 8 bits a component.
Stream octahedralStream(const std::vector<glm::vec3>& normals) {
  Stream out{{}, 4};
  std::vector<glm::vec4> padded;
  for (const glm::vec3& normal : normals) padded.emplace_back(normal, 0);
  out.bytes.resize(normals.size() * out.stride);
  meshopt_encodeFilterOct(out.bytes.data(), normals.size(), out.stride, 8, &padded.front().x);
  return out;
}

/// 0..1 as 16 bits, `components` of them and zeros up to four bytes. `levels`: so many of them, evenly.
Stream shortStream(const float* values, std::size_t count, std::size_t components, float levels) {
  Stream out{{}, (components + 1) / 2 * 4};
  out.bytes.resize(count * out.stride);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const float level = std::round(std::clamp(values[i * components + c], 0.0F, 1.0F) * levels) / levels;
      const auto code = std::uint16_t(std::lround(level * 65535));
      std::memcpy(&out.bytes[i * out.stride + 2 * c], &code, sizeof code);
    }
  return out;
}

bool withinOne(const std::vector<glm::vec2>& uv) {
  return std::ranges::all_of(uv,
                             [](const glm::vec2& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; });
}

void remap(Stream& stream, std::size_t before, std::size_t after, const std::vector<unsigned>& to) {
  std::vector<std::byte> moved(after * stream.stride);
  meshopt_remapVertexBuffer(moved.data(), stream.bytes.data(), before, stream.stride, to.data());
  stream.bytes = std::move(moved);
}

}  // namespace

std::vector<std::byte> codedRows(const void* rows, std::size_t count, std::size_t stride) {
  meshopt_encodeVertexVersion(kVertexVersion);
  std::vector<std::byte> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), rows, count,
                                        stride));
  return out;
}

PackedMesh packMesh(const DrawMesh& mesh, double positionError, const std::vector<glm::vec3>& normals) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  require(normals.empty() || normals.size() == mesh.positions.size(), "each position has a normal");
  meshopt_encodeIndexVersion(kIndexVersion);
  // A coordinate is off by at most half of a step of 2^(1 - bits) times the largest one's power of two.
  const int bits = std::clamp(1 + int(std::ceil(std::log2(std::sqrt(3.0) / positionError))), 2, kMostBits);
  PackedMesh out;
  std::size_t vertices = mesh.positions.size();
  std::vector<Stream> streams{exponentialStream(&mesh.positions.front().x, vertices, 3, bits)};
  out.positions = {kGltfFloat, false, kExponential, "VEC3", streams[0].stride, {}};
  if (!normals.empty()) {
    streams.push_back(octahedralStream(normals));
    out.normals = {kGltfByte, true, "OCTAHEDRAL", "VEC3", streams.back().stride, {}};
  }
  if (!mesh.uv.empty()) {
    const bool within = withinOne(mesh.uv);
    streams.push_back(within ? shortStream(&mesh.uv.front().x, vertices, 2, 65535)
                             : exponentialStream(&mesh.uv.front().x, vertices, 2, kUvBits));
    out.uv = {within ? kGltfUnsignedShort : kGltfFloat,
              within,
              within ? "" : kExponential,
              "VEC2",
              streams.back().stride,
              {}};
  }
  if (!mesh.colours.empty()) {
    streams.push_back(shortStream(&mesh.colours.front().x, vertices, 3, 4095));
    out.colour = {kGltfUnsignedShort, true, "", "VEC3", streams.back().stride, {}};
  }

  std::vector<unsigned> indices(3 * mesh.triangles.size());
  std::memcpy(indices.data(), mesh.triangles.data(), indices.size() * sizeof(unsigned));
  std::vector<meshopt_Stream> views;
  for (const Stream& stream : streams) views.push_back({stream.bytes.data(), stream.stride, stream.stride});
  std::vector<unsigned> to(vertices);
  const std::size_t unique = meshopt_generateVertexRemapMulti(to.data(), indices.data(), indices.size(),
                                                              vertices, views.data(), views.size());
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), to.data());
  for (Stream& stream : streams) remap(stream, vertices, unique, to);
  vertices = unique;
  meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), vertices);
  to.resize(vertices);
  out.vertices = meshopt_optimizeVertexFetchRemap(to.data(), indices.data(), indices.size(), vertices);
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), to.data());
  for (Stream& stream : streams) remap(stream, vertices, out.vertices, to);

  std::size_t next = 0;
  for (PackedAttribute* attribute : {&out.positions, &out.normals, &out.uv, &out.colour})
    if (attribute->stride > 0) {
      const Stream& stream = streams[next++];
      attribute->coded = codedRows(stream.bytes.data(), out.vertices, stream.stride);
    }
  out.triangles = mesh.triangles.size();
  out.coded.resize(meshopt_encodeIndexBufferBound(indices.size(), out.vertices));
  out.coded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.coded.data()),
                                             out.coded.size(), indices.data(), indices.size()));

  std::vector<glm::vec3> decoded(out.vertices);
  std::memcpy(decoded.data(), streams[0].bytes.data(), streams[0].bytes.size());
  meshopt_decodeFilterExp(decoded.data(), out.vertices, sizeof(glm::vec3));
  out.low = out.high = decoded.front();
  for (const glm::vec3& p : decoded) out.low = glm::min(out.low, p), out.high = glm::max(out.high, p);
  return out;
}

}  // namespace acentric
