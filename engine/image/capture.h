#pragma once
/// What one column camera saw: a layered depth image stored column by column, which is the drawing order of
/// list priority (apv.md section 2). This is the data type that bake, store and view share.
///
/// Within a column samples are sorted by row, and within one pixel by decreasing inverseDistance (nearest
/// first). An opaque sample has alpha 1. Blended samples (glass, alpha blend) have alpha < 1 and never stand
/// alone by design: what is behind them follows in the same pixel. A pixel without any sample was not needed
/// by any region.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/column_camera.h"

namespace acentric {

/// Linear radiance with straight alpha, as four half floats. Packing makes every colour storable: NaN and
/// negative values become 0, radiance above 65504 (the largest half) becomes 65504, alpha is clamped to
/// [0,1].
using HalfColour = glm::u16vec4;
HalfColour packColour(const glm::vec4& linearRgba);
glm::vec4 unpackColour(const HalfColour& colour);

struct Capture {
  ColumnCamera camera;
  std::vector<std::uint32_t> columnStart;  ///< columns + 1 offsets into the arrays below
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;  ///< 1/m, horizontal; 0 = sky
  std::vector<HalfColour> colour;

  std::size_t sampleCount() const { return row.size(); }
  /// Largest number of samples in one pixel.
  int maxLayers() const;
  /// Every invariant above that a single capture shows: the camera, array sizes, order of rows and layers,
  /// finite inverseDistance >= 0, finite radiance >= 0, alpha in [0,1]. Used on whatever comes from a file.
  Status check() const;
};

/// Wrong extremes that a capture may hold by the format: sample counts are limited to 2^31.
inline constexpr std::size_t kMaxCaptureSamples = std::size_t(1) << 31;

}  // namespace acentric
