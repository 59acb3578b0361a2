#pragma once
/// What one column camera saw: a layered depth image stored column by column, which is the drawing order of
/// list priority (apv.md section 2). This is the data type that bake, store and view share.
///
/// Within a column samples are sorted by row, and within one pixel by decreasing inverseDistance (nearest
/// first). An opaque sample has alpha 1, a blended one (glass, alpha blend) less. A pixel without any sample
/// was not needed by any region. Each sample says who needs it: bit r for role r of the camera (layout.h).
///
/// What flat mirrors show is a second list of samples at their virtual places: seen in a plane mirror a point
/// lies at its mirror image, the same one for every eye, and on the camera's own ray as far behind the mirror
/// as the reflected ray went. It is drawn where the mirror itself is what a pixel shows. A capture without
/// flat mirrors has no such list and no byte for it.

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

/// An inverse distance as captures store it: the nearest of those `step` apart, and of the floats with 16
/// significant bits, so that its last 8 bits are zero. Off by at most half a step, or by 2^-17 of itself;
/// what is not 0 stays at least one step. `step` is a power of two, or 0 for the second alone.
float storedInverseDistance(double inverseDistance, double step);

/// Samples of all pixels, in capture order.
struct CaptureSamples {
  std::vector<std::uint32_t> columnStart;  ///< columns + 1 offsets into the arrays below
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;  ///< 1/m, horizontal; 0 = sky
  std::vector<HalfColour> colour;
  std::vector<std::uint8_t> roles;  ///< that need the sample, at least one
  /// Of a surface: which of the scene's mirrors it belongs to, 0 = none; the array is empty in a capture
  /// without reflections. Of a reflection: the mirror that shows it, never 0.
  std::vector<std::uint8_t> mirror;

  std::size_t sampleCount() const { return row.size(); }
  /// Largest number of samples in one pixel.
  int maxLayers() const;
  bool operator==(const CaptureSamples&) const = default;
};

/// The surfaces, and what mirrors among them show.
struct Capture : CaptureSamples {
  ColumnCamera camera;
  double distanceStep = 0;     ///< 1/m, see storedInverseDistance
  CaptureSamples reflections;  ///< opaque; all arrays empty where there are none

  bool hasReflections() const { return !reflections.row.empty(); }
  /// Every invariant above that a single capture shows: the camera, array sizes, order of rows and layers,
  /// finite inverseDistance >= 0 with 16 significant bits, finite radiance >= 0, alpha in [0,1], mirrors.
  /// Used on whatever comes from a file.
  Status check() const;
};

/// Wrong extremes that a capture may hold by the format: samples of a list are limited to 2^31.
inline constexpr std::size_t kMaxCaptureSamples = std::size_t(1) << 31;

}  // namespace acentric
