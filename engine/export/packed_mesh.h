#pragma once
/// Triangles in few bytes, for glTF's EXT_meshopt_compression: vertices are rounded, equal ones are merged,
/// and all is brought into an order that caches and meshoptimizer's codecs like.
///
/// A position has one binary exponent and as many bits as it takes to be off by at most a share of how far it
/// is from the origin, or of 1 where it is nearer: seen from there that is one angle, and so one number of
/// samples, near and far.

#include <cstddef>
#include <string>
#include <vector>

#include "engine/export/draw_model.h"

namespace acentric {

/// glTF's numbers for types of components.
inline constexpr int kGltfByte = 5120, kGltfShort = 5122, kGltfUnsignedShort = 5123, kGltfUnsignedInt = 5125,
                     kGltfFloat = 5126;

/// A vertex attribute, coded.
struct PackedAttribute {
  int componentType = 0;  ///< glTF's number
  bool normalized = false;
  std::string filter;      ///< "EXPONENTIAL", "OCTAHEDRAL"; empty = none
  std::string type;        ///< "VEC2" or "VEC3"
  std::size_t stride = 0;  ///< bytes of a vertex
  std::vector<std::byte> coded;
};

struct PackedMesh {
  std::size_t vertices = 0, triangles = 0;
  glm::vec3 low{0}, high{0};     ///< of positions as they are decoded
  PackedAttribute positions;     ///< floats
  PackedAttribute normals;       ///< 8 bits; no bytes without
  PackedAttribute uv;            ///< 16 bits of 0..1, or floats where they leave that; no bytes without
  PackedAttribute colour;        ///< 16 bits; no bytes without
  std::vector<std::byte> coded;  ///< the triangles, indices of 32 bits
};

/// Error of texture coordinates in 0..1; others have it relative to their size.
inline constexpr double kPackedUvError = 1.0 / 131070;
/// Error of colours, display-linear: less than half a code of 8 bits in sRGB's linear part.
inline constexpr double kPackedColourError = 0.5 / 4095;

/// `positionError`: at most so many times the distance from the origin (1 where that is less), down to 2^-22.
/// The mesh has triangles. `normals`: unit, none or one each; kept to about a degree.
PackedMesh packMesh(const DrawMesh& mesh, double positionError, const std::vector<glm::vec3>& normals = {});

/// Rows of `stride` bytes, a multiple of four, in mode ATTRIBUTES.
std::vector<std::byte> codedRows(const void* rows, std::size_t count, std::size_t stride);

}  // namespace acentric
