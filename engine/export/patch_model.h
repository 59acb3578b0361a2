#pragma once
/// Patches of captures (view/display_patches.h) as textured triangles.
///
/// A patch is a picture of its samples on one plane. Seen from the capture the picture is a grid of angles,
/// so a texture laid on the plane by its corners would swim where the plane is seen aslant: a patch is cut
/// until that is below kTextureError samples. Alpha is the share of a sample that its surface covers: cut off
/// at a half, interpolated between samples, it follows the edge of the surface to a part of a sample.

#include <span>
#include <stop_token>

#include "engine/base/result.h"
#include "engine/export/draw_model.h"
#include "engine/view/walk_scene.h"

namespace acentric {

inline constexpr double kTextureError = 0.25;  ///< samples
inline constexpr int kLeastAtlas = 128;        ///< pixels a side
inline constexpr int kLargestAtlas = 16384;

/// The part of a capture that is drawn: samples that share a bit with these roles.
struct ShownCapture {
  const DisplayCapture* capture = nullptr;  ///< hasPatches()
  std::uint8_t roles = 0;
};

struct PatchModelCounts {
  std::size_t patches = 0, triangles = 0, textures = 0;
  std::size_t samples = 0;  ///< shown
};

/// Does a mesh hold samples of all of the roles that are shown, or only of the same roles?
enum class RoleMeshes { together, apart };

/// Adds what the captures show of surfaces, and what flat mirrors show at its place behind them; of the
/// mirrors themselves nothing, so that they are open. Textures have at
/// most `atlasPixels` a side. Stopped, it returns soon, with a model that is not whole.
PatchModelCounts addPatches(std::span<const ShownCapture> shown, RoleMeshes meshes, int atlasPixels,
                            DrawModel& model, const std::stop_token& stop = {});

}  // namespace acentric
