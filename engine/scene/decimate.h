#pragma once
/// Quadric edge collapse (Garland and Heckbert) of an indexed triangle mesh, by OpenMesh. A vertex collapses
/// into a neighbour, so every vertex that is left is one of the input's, with all its attributes. Borders of
/// the mesh stay as they are: whatever the caller keeps apart by separate vertices (materials, texture seams,
/// the rim of a cut) has its border there, and does not move.
/// Where a budget must be reached all of that is let go, in steps (DecimationOptions::reach).
///
/// Meshes that are not manifold are split where they are not: a triangle that OpenMesh cannot join gets
/// copies of its vertices, and every vertex that has copies is held in place. No triangle is lost.

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <stop_token>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

struct DecimationMesh {
  std::vector<glm::vec3> positions;  ///< metres
  std::vector<glm::vec2> uv;         ///< empty, or by vertex
  std::vector<glm::vec4> colours;    ///< empty, or by vertex, in [0, 1]
  std::vector<glm::uvec3> triangles;
};

struct DecimationOptions {
  std::size_t mostTriangles = 0;  ///< stop at so many
  /// Metres that a vertex taken away may lie from what is left, and what is painted on it from its place.
  double tolerance = 0.005;
  /// Go on to `mostTriangles` whatever it costs: borders move too, what is painted on the surface counts no
  /// more, and in the end the smallest pieces (by area) are left out.
  bool reach = false;
};

struct DecimatedTriangle {
  static constexpr std::uint32_t kChanged = 0xffffffff;
  glm::uvec3 vertices{0};             ///< of the input
  std::uint32_t original = kChanged;  ///< the input's triangle that this one still is
};

struct Decimation {
  std::vector<DecimatedTriangle> triangles;
  std::size_t split = 0;  ///< triangles that needed vertices of their own
  /// With DecimationOptions::reach: triangles when only that helped any more, 0 = never; then pieces of the
  /// surface left out in the end, and their triangles.
  std::size_t loosenedFrom = 0, piecesLeftOut = 0, trianglesLeftOut = 0;
};

/// Indices must be valid and triangles have three different corners. Fails only when cancelled or out of
/// memory.
Result<Decimation> decimate(const DecimationMesh& mesh, const DecimationOptions& options,
                            std::stop_token stop = {});

}  // namespace acentric
