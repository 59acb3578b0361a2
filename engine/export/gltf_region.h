#pragma once
/// One region of a walk as glTF: what its captures show as textured meshes, the geometry near it beside, for
/// any engine that draws triangles with a depth test. Axes are glTF's: Y up, metres, relative to the
/// project's origin: (x, y, z) of ours is (x, z, -y) there.
///
/// The background: adaptive meshes of the region's captures (capture_mesh.h), so no surface is off by more
/// than `meshError` samples for any eye in the region. A patch is a plane; a texture laid on it by its
/// corners would swim where it is seen aslant, so it is cut until that is below kTextureError samples.
/// Near geometry: its textures, and the baked light as vertex colours on triangles as fine as that light.
/// What captures hold of glass and of mirrors is left out, and counted.

#include <filesystem>
#include <stop_token>
#include <string>

#include "engine/base/task_runner.h"
#include "engine/image/colour_quality.h"
#include "engine/view/walk_scene.h"

namespace acentric {

inline constexpr double kTextureError = 0.25;

struct GltfOptions {
  double meshError = 0.5;  ///< samples, 0.01..64
  bool bothHands = true;   ///< in rings: the other hand's cameras fill what one hand's leave open
  int atlasPixels = 4096;  ///< side of a texture, at least 128
  std::string generator;
  /// Geometry by EXT_meshopt_compression, its positions rounded by at most kPackedShare of the mesh error.
  bool meshopt = false;
  bool webp = false;                          ///< textures: EXT_texture_webp; else PNG
  int colourQuality = kShippedColourQuality;  ///< of WebP: its own 0..99, or kLosslessColours
  Status check() const;
};

inline constexpr double kPackedShare = 1.0 / 32;

struct GltfRegionReport {
  std::size_t cameras = 0, missing = 0;  ///< missing: without capture
  std::size_t patches = 0, triangles = 0, localTriangles = 0, textures = 0;
  std::size_t samples = 0;  ///< shown
  std::size_t leftOut = 0;  ///< samples of glass and mirrors
  std::uint64_t bytes = 0;
  Bounds bounds;  ///< of all that it shows, Z up
};

/// The captures of the region's cameras and its local geometry are loaded.
Result<GltfRegionReport> writeGltfRegion(const WalkScene& walk, int region, const GltfOptions& options,
                                         const std::filesystem::path& file, TaskRunner& runner,
                                         const std::stop_token& stop = {});

/// The cameras that it reads.
std::vector<int> gltfCameras(const Layout& layout, int region, const GltfOptions& options);

}  // namespace acentric
