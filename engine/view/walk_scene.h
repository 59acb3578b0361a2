#pragma once
/// All that a renderer reads: layout, captures made ready for display, and local geometry with its light.
/// Parts that are not loaded yet are null: the picture then has holes there, never a stall.

#include <memory>
#include <vector>

#include "engine/base/large_vector.h"
#include "engine/image/capture.h"
#include "engine/image/colour.h"
#include "engine/layout/layout.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/surface_light.h"
#include "engine/view/slant_code.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

inline constexpr std::uint32_t kSamplesPerBlock = 32;

/// What is known of each block: of that many successive samples of a column, or of the fewer at its end. The
/// arrays have room for kSampleRoom more.
struct SampleBlocks {
  std::vector<float> leastInverse, mostInverse;  ///< smallest and largest inverse distance
  std::vector<float> lowTangent, highTangent;    ///< of its rows
  std::vector<std::uint8_t> roles;               ///< that need any of them
};

/// Where a capture shows the background, and the borders of its columns and rows.
struct DisplayBackground {
  CaptureBackground runs;
  std::vector<glm::dvec2> columnBorder;  ///< columns + 1 unit directions; empty without runs
  std::vector<double> rowBorder;         ///< rows + 1 tangents, falling; empty without runs
};

/// A capture with display colours and what the kernels need beside the samples. Sample order as in Capture.
struct DisplayCapture {
  ColumnCamera camera;
  std::vector<std::uint32_t> columnStart;  ///< columns + 1
  LargeVector<std::uint16_t> row;
  LargeVector<float> inverseDistance;      ///< 1/m, horizontal
  LargeVector<Rgba8> colour;               ///< sRGB, straight alpha
  LargeVector<std::uint8_t> roles;         ///< that need the sample
  LargeVector<Slant> slant;                ///< how its surface is turned (slant.h)
  std::vector<glm::vec2> columnDirection;  ///< unit, at column centres
  std::vector<float> rowTangent;           ///< at row centres
  std::vector<glm::vec2> columnRange;  ///< per column: smallest and largest inverse distance (for culling)
  SampleBlocks blocks;
  std::vector<std::uint32_t> columnBlock;  ///< columns + 1: where each column's blocks start
  DisplayBackground background;
  bool layered = false;              ///< some pixel has more than one sample
  bool blended = false;              ///< some sample has alpha < 255
  LargeVector<std::uint8_t> mirror;  ///< the mirror that each sample belongs to, 0 = none; empty: none does
  /// What mirrors show, at its virtual place; null = nothing. Its `mirror` says which of them shows a sample.
  std::shared_ptr<const DisplayCapture> reflections;
};

DisplayCapture prepareForDisplay(const Capture& capture, float exposure);

struct WalkScene {
  ScenePtr scene;
  std::shared_ptr<const Layout> layout;
  EffectPlan plan;
  float exposure = 1;
  std::vector<std::shared_ptr<const DisplayCapture>> captures;  ///< by camera; null = not loaded
  std::vector<std::shared_ptr<const LocalGeometry>> local;      ///< by region; null = not loaded
  std::shared_ptr<const SurfaceLight> surfaceLight;             ///< null = not baked
};

}  // namespace acentric
