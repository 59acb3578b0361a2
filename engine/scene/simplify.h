#pragma once
/// Simplifies one region's local geometry to a budget of triangles, within an error in metres that is
/// measured on the result. What was cut at the region's rim stays exactly as it is, and so do borders of
/// materials, texture seams and open edges. The result carries meshes of its own (LocalSurfaces): vertices
/// are those of the scene with all their attributes, and each light sample knows the place on the scene's
/// surfaces whose light it takes, so that the light can be baked before or after.

#include <cstdint>
#include <glm/glm.hpp>
#include <stop_token>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/surface_light.h"

namespace acentric {

struct SimplifyOptions {
  std::size_t mostTriangles = 200'000;  ///< 0 = as few as the error allows
  double maxError = 0.005;              ///< metres
  double lightTexel = 0.05;             ///< metres between light samples
  bool reach = false;                   ///< the budget comes first, whatever the error (DecimationOptions)

  Status check() const;
};

/// A place on the scene's surfaces.
struct SurfacePlace {
  std::uint32_t sceneTriangle = 0;
  glm::vec2 barycentric{0};
};

struct SimplifyReport {
  std::size_t before = 0, after = 0;   ///< triangles
  std::size_t rim = 0;                 ///< of them cut at the region's border, kept as they are
  std::size_t split = 0;               ///< triangles set apart where the mesh is not manifold
  double maxError = 0, meanError = 0;  ///< metres between the surfaces, both ways
  std::size_t errorSamples = 0;
  bool withinError = true;   ///< maxError <= what was asked
  bool withinBudget = true;  ///< after <= what was asked
  double seconds = 0;
  /// What it costs in pictures, where somebody rendered both: over pixels of local geometry, in 8-bit codes.
  int comparedFrames = 0;
  double psnr = 0;            ///< dB; 99 if identical
  double meanDifference = 0;  ///< of red, green and blue
  /// Decimation.
  std::size_t loosenedFrom = 0, piecesLeftOut = 0, trianglesLeftOut = 0;
};

/// Triangles of one scene mesh's vertices.
struct SimplifiedMesh {
  std::uint32_t sceneMesh = 0;
  std::vector<std::uint32_t> sceneVertices;  ///< of that mesh
  std::vector<glm::uvec3> triangles;         ///< into sceneVertices
};

struct SimplifiedLocal {
  std::vector<LocalVertex> vertices;
  std::vector<LocalTriangle> triangles;  ///< of `meshes`
  std::vector<SimplifiedMesh> meshes;
  /// By triangle through the meshes in order: the scene triangle whose light it takes as it is, or
  /// kResampled.
  std::vector<std::uint32_t> lightFrom;
  std::vector<std::uint16_t> lightResolution;  ///< of resampled ones (as SurfaceLight::resolution), else 0
  std::vector<SurfacePlace> lightPlaces;       ///< of resampled ones, one after the other
  SimplifyReport report;

  static constexpr std::uint32_t kResampled = 0xffffffff;

  /// Does every number in it name something of this scene? For what comes from a file.
  Status check(const Scene& scene) const;
};

/// `full` is clipped from `scene`. Fails when cancelled or out of memory; a budget or an error that cannot be
/// kept is told in the report.
Result<SimplifiedLocal> simplify(const Scene& scene, const LocalGeometry& full,
                                 const SimplifyOptions& options, std::stop_token stop = {});

/// Ready to draw, with light taken from the scene's (null or empty: not baked).
LocalGeometry localGeometryOf(const SimplifiedLocal& simplified, const Scene& scene,
                              const ConvexPolygon& polygon, const SurfaceLight* sceneLight);

}  // namespace acentric
