#pragma once
/// All that a renderer reads: layout, captures made ready for display, and local geometry with its light.
/// Parts that are not loaded yet are null: the picture then has holes there, never a stall.

#include <bit>
#include <memory>
#include <vector>

#include "engine/base/large_vector.h"
#include "engine/image/capture.h"
#include "engine/image/colour.h"
#include "engine/layout/layout.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/flat_mirrors.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/surface_light.h"
#include "engine/view/display_patches.h"

namespace acentric {

/// Where a capture shows the background, and the borders of its columns and rows.
struct DisplayBackground {
  CaptureBackground runs;
  std::vector<glm::dvec2> columnBorder;  ///< columns + 1 unit directions; empty without runs
  std::vector<double> rowBorder;         ///< rows + 1 tangents, falling; empty without runs
};

/// A sample as it is projected: all that takes, side by side in eight bytes, because samples are read in
/// short runs here and there and each place in memory that a run begins at must be waited for.
struct PackedSample {
  /// 1/m, horizontal: the bits of a float but for its last eight, which captures do not use
  /// (storedInverseDistance). Instead of those: the roles that need the sample.
  std::uint32_t inverseDistanceAndRoles;
  std::uint32_t row;
  bool operator==(const PackedSample&) const = default;
};
static_assert(sizeof(PackedSample) == 8);

inline float inverseDistanceOf(const PackedSample& sample) {
  return std::bit_cast<float>(sample.inverseDistanceAndRoles & ~0xffu);
}
inline std::uint8_t rolesOf(const PackedSample& sample) {
  return static_cast<std::uint8_t>(sample.inverseDistanceAndRoles);
}
/// The inverse distance is rounded to the bits that are kept.
inline PackedSample packSample(float inverseDistance, std::uint8_t roles, std::uint32_t row) {
  return {((std::bit_cast<std::uint32_t>(inverseDistance) + 0x80u) & ~0xffu) | roles, row};
}

/// A capture with display colours and what the kernels need beside the samples. Sample order as in Capture.
struct DisplayCapture {
  ColumnCamera camera;
  std::vector<std::uint32_t> columnStart;  ///< columns + 1
  LargeVector<PackedSample> samples;       ///< rows do not fall within a column
  LargeVector<Rgba8> colour;               ///< sRGB, straight alpha
  std::vector<glm::vec2> columnDirection;  ///< unit, at column centres
  std::vector<float> rowTangent;           ///< at row centres
  std::vector<glm::vec2> columnRange;  ///< per column: smallest and largest inverse distance (for culling)
  DisplayBackground background;
  bool layered = false;                           ///< some pixel has more than one sample
  bool blended = false;                           ///< some sample has alpha < 255
  std::shared_ptr<const DisplayPatches> patches;  ///< of the samples; null where they have no planes
  LargeVector<std::uint8_t> mirror;  ///< the mirror that each sample belongs to, 0 = none; empty: none does
  /// Can it be drawn as patches? One that shows nothing but the background has none.
  bool hasPatches() const { return patches != nullptr || samples.empty(); }
  /// What mirrors show, at its virtual place; null = nothing. Its `mirror` says which of them shows a sample.
  std::shared_ptr<const DisplayCapture> reflections;
};

DisplayCapture prepareForDisplay(const Capture& capture, float exposure);
/// What it takes in memory, with what its mirrors show.
std::size_t bytesOf(const DisplayCapture& capture);

struct WalkScene {
  ScenePtr scene;
  std::shared_ptr<const Layout> layout;
  EffectPlan plan;
  float exposure = 1;
  std::vector<std::shared_ptr<const DisplayCapture>> captures;  ///< by camera; null = not loaded
  std::vector<std::shared_ptr<const LocalGeometry>> local;      ///< by region; null = not loaded
  std::shared_ptr<const SurfaceLight> surfaceLight;             ///< null = not baked
  /// Of the scene's triangles, for local geometry to show what captures keep of reflections; null = none.
  std::shared_ptr<const FlatMirrors> mirrors;
};

}  // namespace acentric
