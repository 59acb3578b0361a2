#pragma once
/// The arrays of a file of local geometry, in the order of FORMAT.md, for its writer and its reader.

#include <array>

#include "engine/scene/local_geometry.h"
#include "engine/store/block_file.h"

namespace acentric::local_file {

/// What a file has, or a mesh of it (the last three).
inline constexpr std::uint8_t kLight = 1, kMirrors = 2, kUv0 = 4, kUv1 = 8, kColours = 16;

/// In place of each of its vertices' numbers: a triangle that is all of its source triangle, whose corners
/// are its vertices, in their order.
inline constexpr std::uint32_t kWhole = 0xffffffff;
inline constexpr std::uint64_t kVerticesBytes = 3 * sizeof(LocalVertex);  ///< of one
inline constexpr glm::vec2 kCorners[3] = {{0, 0}, {1, 0}, {0, 1}};

inline std::uint8_t flagsOf(const Mesh& mesh) {
  return std::uint8_t((mesh.uv[0].empty() ? 0 : kUv0) | (mesh.uv[1].empty() ? 0 : kUv1) |
                      (mesh.colours.empty() ? 0 : kColours));
}

/// Of all meshes, one after the other; zeros where a mesh lacks what another has.
struct Arrays {
  std::uint8_t flags = 0;
  std::vector<glm::uvec4> triangle;  ///< three local vertices, source triangle
  struct Place {
    glm::vec3 position, normal;
  };
  std::vector<Place> place;  ///< by vertex of the source triangles
  std::vector<glm::vec2> uv[2];
  std::vector<glm::u8vec4> colour;
  std::vector<glm::uvec3> source;   ///< corners among all vertices
  std::vector<std::uint8_t> plane;  ///< by source triangle

  /// Returns the mesh's flags.
  std::uint8_t append(const Mesh& mesh) {
    const glm::uvec3 first(std::uint32_t(place.size()));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      place.push_back({mesh.positions[v], mesh.normals.empty() ? glm::vec3(0) : mesh.normals[v]});
    for (std::size_t set = 0; set < 2; ++set) {
      uv[set].insert(uv[set].end(), mesh.uv[set].begin(), mesh.uv[set].end());
      uv[set].resize(place.size(), glm::vec2(0));
    }
    colour.insert(colour.end(), mesh.colours.begin(), mesh.colours.end());
    colour.resize(place.size(), glm::u8vec4(0));
    for (const glm::uvec3& corners : mesh.triangles) source.push_back(first + corners);
    return flagsOf(mesh);
  }
};
static_assert(sizeof(LocalVertex) == 20 && sizeof(Arrays::Place) == 24);

/// Lanes of `Count` fields of `Width` bytes each that lie one behind the other.
template <std::size_t Count, int Width, class Records>
auto lanesOf(Records& records) {
  std::array<decltype(laneOf(records)), Count> lanes;
  for (std::size_t i = 0; i < Count; ++i) lanes[i] = laneOf(records, i * std::size_t(Width), Width);
  return lanes;
}

/// visit(lanes, records) of each array that the flags call for; of light its tables.
template <class Vertices, class AnyArrays, class AnyLight, class Visit>
void forEachArray(Vertices& vertices, AnyArrays& arrays, AnyLight& light, const Visit& visit) {
  visit(lanesOf<5, 4>(vertices), vertices.size());
  visit(lanesOf<4, 4>(arrays.triangle), arrays.triangle.size());
  visit(lanesOf<6, 4>(arrays.place), arrays.place.size());
  if (arrays.flags & kUv0) visit(lanesOf<2, 4>(arrays.uv[0]), arrays.place.size());
  if (arrays.flags & kUv1) visit(lanesOf<2, 4>(arrays.uv[1]), arrays.place.size());
  if (arrays.flags & kColours) visit(lanesOf<4, 1>(arrays.colour), arrays.place.size());
  visit(lanesOf<3, 4>(arrays.source), arrays.source.size());
  if (arrays.flags & kLight)
    visit(std::array{laneOf(light.resolution), laneOf(light.hasBack)}, arrays.source.size());
  if (arrays.flags & kMirrors) visit(std::array{laneOf(arrays.plane)}, arrays.source.size());
}

}  // namespace acentric::local_file
