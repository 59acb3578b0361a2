#pragma once
/// What one column camera saw: a layered depth image stored column by column, which is the drawing order of
/// list priority (apv.md section 2). This is the data type that bake, store and view share.
///
/// Within a column samples are sorted by row, and within one pixel by decreasing inverseDistance (nearest
/// first). An opaque sample has alpha 1, a blended one (glass, alpha blend) less. A pixel without any sample
/// was not needed by any region. Each sample says who needs it: bit r for role r of the camera (layout.h).
///
/// The background, infinitely far behind all samples, looks the same from everywhere. So it needs no samples:
/// each column tells in which rows it is seen, and by whom.
///
/// What flat mirrors show is a second list of samples at their virtual places: seen in a plane mirror a point
/// lies at its mirror image, the same one for every eye, and on the camera's own ray as far behind the mirror
/// as the reflected ray went. It is drawn where the mirror itself is what a pixel shows. A capture without
/// flat mirrors has no such list and no byte for it.
///
/// A capture may know its silhouettes: then each sample tells the plane of its surface, and which of the 4x4
/// parts of its pixel that surface covers, as multisampling does. Several surfaces of one pixel may cover the
/// same part: they lie behind one another. A capture that does not know them has no byte for them.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/column_camera.h"
#include "engine/image/sky.h"

namespace acentric {

/// Linear radiance with straight alpha, as four half floats. Packing makes every colour storable: NaN and
/// negative values become 0, radiance above 65504 (the largest half) becomes 65504, alpha is clamped to
/// [0,1].
using HalfColour = glm::u16vec4;
HalfColour packColour(const glm::vec4& linearRgba);

/// Exact, and without denormal floats on the way: they may be switched off.
inline float floatFromHalf(std::uint16_t half) {
  const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16, size = std::uint32_t(half & 0x7fffu) << 13;
  constexpr std::uint32_t kRebias = (127u - 15u) << 23;
  float value = std::bit_cast<float>(size + kRebias);
  if (size < 0x400u << 13) value = std::bit_cast<float>(size + kRebias + (1u << 23)) - 0x1p-14f;
  if (size >= 0x7c00u << 13) value = std::bit_cast<float>(size | 0x7f800000u);
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) | sign);
}
inline glm::vec4 unpackColour(const HalfColour& colour) {
  return {floatFromHalf(colour.r), floatFromHalf(colour.g), floatFromHalf(colour.b), floatFromHalf(colour.a)};
}

/// An inverse distance as captures store it: the nearest of those `step` apart, and of the floats with 16
/// significant bits, so that its last 8 bits are zero. Off by at most half a step, or by 2^-16 of itself;
/// what is not 0 stays at least one step. `step` is a power of two, or 0 for the second alone.
inline float storedInverseDistance(double inverseDistance, double step) {
  if (!(inverseDistance > 0)) return 0;
  // The power of two at or below the number, by its exponent's bits.
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  const double power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(inverseDistance) & kExponent);
  const double own = power * 0x1p-15;     // of 16 significant bits
  constexpr double kSmallest = 0x1p-141;  // of the smallest floats the last 8 bits
  const double coarser = std::max({step, own, kSmallest});
  constexpr double kRound = 0x1.8p52;  // leaves no bit behind the point
  // A power of two times 2^52 is no less exact as a summand than as a divisor, and faster.
  const double shift = kRound * coarser;
  const double stored = inverseDistance + shift - shift;
  return float(std::max(stored, step));
}

/// The plane of a surface, relative to the camera's centre of projection P: of points P + X with
/// dot(normal, X) = 1. A ray of column direction c and row tangent t meets it at the inverse distance
/// dot(normal, (c, t)).
struct SurfacePlane {
  glm::vec3 normal{0};     ///< 1/m
  std::uint32_t away = 0;  ///< 1: regions see the side of it that the camera's ray does not meet
  double inverseDistance(const glm::dvec2& column, double tangent) const {
    return normal.x * column.x + normal.y * column.y + normal.z * tangent;
  }
  bool operator==(const SurfacePlane&) const = default;
};

/// Parts of a pixel on either side, and the mask of all of them: bit 4 * y + x is of the part that is y-th
/// from the top, x-th from the clockwise border.
inline constexpr int kCoverageParts = 4;
inline constexpr std::uint16_t kWholePixel = 0xffff;

/// Samples of all pixels, in capture order.
struct CaptureSamples {
  std::vector<std::uint32_t> columnStart;  ///< columns + 1 offsets into the arrays below
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;  ///< 1/m, horizontal; 0 = infinitely far, of reflections alone
  std::vector<HalfColour> colour;
  std::vector<std::uint8_t> roles;  ///< that need the sample, at least one
  /// Of a surface: which of the scene's mirrors it belongs to, 0 = none; the array is empty in a capture
  /// without reflections. Of a reflection: the mirror that shows it, never 0.
  std::vector<std::uint8_t> mirror;
  /// Silhouettes; all three empty in a capture without.
  std::vector<std::uint16_t> coverage{};  ///< never 0
  std::vector<std::uint32_t> plane{};     ///< into `planes`
  std::vector<SurfacePlane> planes{};

  bool hasSilhouettes() const { return !plane.empty(); }
  std::size_t sampleCount() const { return row.size(); }
  /// What the arrays hold, without their slack.
  std::size_t bytes() const;
  /// Largest number of samples in one pixel.
  int maxLayers() const;
  bool operator==(const CaptureSamples&) const = default;
};

/// Of a surface sample without a mirror or silhouettes.
inline constexpr std::size_t kCaptureSampleBytes =
    sizeof(std::uint16_t) + sizeof(float) + sizeof(HalfColour) + sizeof(std::uint8_t);

/// Where a capture's pixels show the background behind their samples. Of a column the runs of rows lie one
/// below the other; those that touch differ in their roles.
struct CaptureBackground {
  Sky sky;                                 ///< linear radiance by direction; all zero without runs
  std::vector<std::uint32_t> columnStart;  ///< columns + 1 offsets into the arrays below; empty without runs
  std::vector<std::uint16_t> firstRow;
  std::vector<std::uint16_t> endRow;  ///< one below the last
  std::vector<std::uint8_t> roles;    ///< that need it, at least one

  std::size_t runCount() const { return firstRow.size(); }
  std::size_t pixelCount() const;
  std::size_t bytes() const;
  bool operator==(const CaptureBackground&) const = default;
};

/// Gathers the background of one column after the other.
class BackgroundBuilder {
 public:
  /// Rows of a column from top to bottom; each once.
  void add(int row, std::uint8_t roles);
  void closeColumn() { runs_.columnStart.push_back(std::uint32_t(runs_.runCount())); }
  /// The columns that the other has closed, behind the own.
  void append(const BackgroundBuilder& other);
  /// Of as many columns as were closed.
  CaptureBackground finish(const Sky& sky) &&;

 private:
  CaptureBackground runs_;
};

/// The surfaces, the background behind them, and what mirrors among them show.
struct Capture : CaptureSamples {
  ColumnCamera camera;
  double distanceStep = 0;  ///< 1/m, see storedInverseDistance
  CaptureBackground background;
  CaptureSamples reflections;  ///< opaque; all arrays empty where there are none
  double planeTolerance = 0;   ///< 1/m, of captures with silhouettes: see makePatches
  bool shown = false;          ///< colours are what is shown, linear in [0, 1], in place of radiance

  bool hasReflections() const { return !reflections.row.empty(); }
  /// What all arrays hold.
  std::size_t bytes() const;
  /// Every invariant above that a single capture shows: the camera, array sizes, order of rows and layers,
  /// finite inverseDistance > 0 (of reflections >= 0) with 16 significant bits, finite radiance >= 0, alpha
  /// in [0,1], runs of the background, mirrors.
  /// Used on whatever comes from a file.
  Status check() const;
};

/// Wrong extremes that a capture may hold by the format: samples of a list are limited to 2^31.
inline constexpr std::size_t kMaxCaptureSamples = std::size_t(1) << 31;

}  // namespace acentric
