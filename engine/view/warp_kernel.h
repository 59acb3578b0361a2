#pragma once
/// The inner loop of the warp: from samples of one capture column to squares on the picture.
///
/// One template (warp_kernel_body.h) is compiled three times: one sample at a time for any processor, eight
/// at a time with AVX2 and sixteen with AVX-512 (and once in double precision, as a reference). All do the
/// same operations in the same order without fused multiply-adds, so their results are the same bits.
/// kernels.h chooses.
///
/// This header and everything the AVX sources include must stay free of the standard library and of glm: an
/// inline function compiled there could otherwise be the one copy that the linker keeps for the whole
/// program.

#include <cstdint>

#include "engine/view/packed_sample.h"

namespace acentric {

/// The splats of a column, an array for each thing that is known of them, with room for all its samples and
/// kSampleRoom more. A splat is a square of whole pixels.
struct SplatArrays {
  /// What its pixels become: CanvasPixel, of the colour without its alpha.
  std::uint64_t* pixels = nullptr;
  /// For painting all pixels by their corners: 0 if the splat is more than two pixels wide, reaches beyond
  /// the canvas, or is not opaque. Else kWholeSplat, and from its first pixel to the others: in bits 0..15
  /// the step to the right, in bit 16 the step down.
  std::uint32_t* steps = nullptr;
  std::uint32_t* firsts = nullptr;   ///< where steps start: the first pixel on the canvas
  std::uint32_t* corners = nullptr;  ///< of the top left pixel: x, and y in the upper half, both signed
  std::uint32_t* sides = nullptr;    ///< pixels
  std::uint32_t* indices = nullptr;  ///< of the sample in its column
};
inline constexpr std::uint32_t kWholeSplat = 1u << 17;

enum class PartTest : std::int32_t {
  none,
  within,   ///< part at most half a turn wide: left of its low border and right of its high one
  without,  ///< wider: not within the rest
};

/// Everything that is constant over a column. Directions are in view axes with focal length and picture
/// centre multiplied in: sample (t, w) has q = a + t * z + w * b, image position u = q.x / q.z, v = q.y /
/// q.z, and depth q.z / w along the view axis.
template <class T>
struct ProjectColumnOf {
  T a[3], z[3], b[3];
  T maxInverseDistance;  ///< nearer samples are dropped
  T minInverseDistance;  ///< farther ones too; 0: none
  T footprint;           ///< splat side at q.z = 1, straight ahead, row tangent 0; 0: points
  T maxSide;
  std::uint32_t roles;          ///< samples that none of these needs are dropped
  T centreX, centreY;           ///< picture centre, pixels
  T inverseFocal;               ///< 1/pixels
  std::int32_t x0, y0, x1, y1;  ///< the canvas: splats that miss it are dropped
  std::uint32_t slot;           ///< of the canvas, 1..255
  PartTest partTest;
  T direction[2];     ///< column direction in plan
  T baseline[2];      ///< b in plan, metres
  T low[2], high[2];  ///< border directions of the part
};
using ProjectColumn = ProjectColumnOf<float>;

/// What kernels read and write beyond the end of arrays that have room for it.
inline constexpr int kSampleRoom = 16;

/// The samples of a column from its first on.
template <class T>
struct SampleColumnOf {
  const T* rowTangent = nullptr;          ///< the capture's table
  const PackedSample* samples = nullptr;  ///< rows do not fall
  const unsigned char* colour = nullptr;  ///< Rgba8, four bytes each
};
using SampleColumn = SampleColumnOf<float>;

/// Writes the splats of the column's first `count` samples that touch the canvas to `out`, in the order of
/// the samples, and returns how many.
using ProjectSamples = int (*)(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                               const SplatArrays& out);

int projectSamplesScalar(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                         const SplatArrays& out);
/// The same in double precision, from constants and tangents that were never rounded to floats: what the
/// others are measured against. Distances are those of the samples, the depths of pixels are floats.
int projectSamplesDouble(const ProjectColumnOf<double>& column, const SampleColumnOf<double>& samples,
                         std::uint32_t count, const SplatArrays& out);
int projectSamplesAvx2(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                       const SplatArrays& out);
int projectSamplesAvx512(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                         const SplatArrays& out);

}  // namespace acentric
