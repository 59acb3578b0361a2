#pragma once
/// One region of a walk as glTF: what its captures show as textured meshes, the geometry near it beside, for
/// any engine that draws triangles with a depth test. Axes are glTF's: Y up, metres, relative to the
/// project's origin: (x, y, z) of ours is (x, z, -y) there.
///
/// Captures are drawn as their patches (patch_model.h), near geometry as triangles with the baked light in
/// their textures (near_model.h), and what lies infinitely far is a sphere (sky_model.h).

#include <filesystem>
#include <stop_token>
#include <string>

#include "engine/base/result.h"
#include "engine/image/colour_quality.h"
#include "engine/view/walk_scene.h"

namespace acentric {

struct GltfOptions {
  bool bothHands = true;   ///< in rings: the other hand's cameras fill what one hand's leave open
  int atlasPixels = 4096;  ///< side of a texture, at least 128
  std::string generator;
  /// Geometry by EXT_meshopt_compression, its positions rounded by at most kPackedError.
  bool meshopt = false;
  bool webp = false;                          ///< textures: EXT_texture_webp; else PNG
  int colourQuality = kShippedColourQuality;  ///< of WebP: its own 0..99, or kLosslessColours
  Status check() const;
};

inline constexpr double kPackedError = 1.0 / 64;  ///< samples

struct GltfRegionReport {
  std::size_t cameras = 0, missing = 0;  ///< missing: without capture
  std::size_t patches = 0, triangles = 0, localTriangles = 0, textures = 0;
  std::size_t samples = 0;  ///< shown
  std::uint64_t bytes = 0;
  Bounds bounds;  ///< of all that it shows, Z up
};

/// The captures of the region's cameras and its local geometry are loaded. Captures without planes are
/// refused.
Result<GltfRegionReport> writeGltfRegion(const WalkScene& walk, int region, const GltfOptions& options,
                                         const std::filesystem::path& file, const std::stop_token& stop = {});

/// The cameras that it reads.
std::vector<int> gltfCameras(const Layout& layout, int region, const GltfOptions& options);

}  // namespace acentric
