#pragma once
/// One region's local geometry as a graphics card takes it: corners of triangles, batches of one material,
/// and the surface light of just these triangles.

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// One corner as the shader reads it. All attributes of the source triangle are evaluated here, once.
struct LocalCorner {
  glm::vec3 position;  ///< relative to an origin
  glm::vec2 barycentric;
  glm::vec2 baseUv;               ///< transformed
  glm::vec2 emissiveUv;           ///< transformed
  glm::u16vec4 colour;            ///< vertex colour, 0..65535
  std::uint32_t lightFirst;       ///< into the light buffer
  std::uint32_t lightResolution;  ///< resolution, bit 16: has a back side
  glm::vec3 normal;               ///< shading normal
};
static_assert(sizeof(LocalCorner) == 64, "the vertex layout has no padding");

/// Consecutive triangles of one material and one set of attributes.
struct LocalBatch {
  int material = 0;
  bool vertexColours = false;
  bool baseUv = false;
  bool emissiveUv = false;
  std::uint8_t mirrorPlane = FlatMirrors::kNoPlane;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
  bool isMirror() const { return mirrorPlane != FlatMirrors::kNoPlane; }
};

struct LocalCorners {
  std::vector<LocalCorner> corners;  ///< three a triangle
  std::vector<LocalBatch> batches;
  /// Corners of the triangles whose material can be clear, three each, for sorting: these come last, from
  /// this one on.
  std::vector<glm::vec3> clearCorners;
  std::uint32_t firstClear = 0;
  std::vector<HalfColour> light;  ///< samples; alpha unused
  bool lit = false;               ///< a surface light was there
  bool mirrors = false;           ///< some batch is a mirror
};

/// Positions are relative to `origin`, amid the region, so that floats do not lose digits far from the
/// project's. Fails where the geometry does not fit the scene.
Result<LocalCorners> localCorners(const WalkScene& walk, const LocalGeometry& geometry,
                                  const glm::dvec3& origin);

}  // namespace acentric
