#pragma once
/// The inner loops of drawing patches: some pixels of one column of the picture, from one patch, and what is
/// done to all pixels before and after.
///
/// Each pixel's ray is put through the patch's plane to where the capture saw that place. What covers the
/// pixel is told by eight rays, each by the part of the texel that it meets (the texels' coverage); its
/// colour is interpolated at the pixel's centre. Pixels are painted front to back: `open` says which of the
/// eight parts nothing has covered yet.
///
/// One template (patch_kernel_body.h) is compiled for one lane, AVX2 and AVX-512. All do the same operations
/// in the same order without fused multiply-adds, so their results are the same bits. kernels.h chooses.
///
/// This header and everything the AVX sources include must stay free of the standard library and of glm: an
/// inline function compiled there could otherwise be the one copy that the linker keeps for the whole
/// program.

#include <cstdint>

namespace acentric {

/// Parts of a pixel of the picture: one bit for each of its rays.
inline constexpr int kPixelParts = 8;
inline constexpr std::uint32_t kAllParts = (1u << kPixelParts) - 1;

/// Of a texel's word in DisplayPatches::cover.
inline constexpr std::uint32_t kTexelParts = 0xffff;  ///< coverage, as in CaptureSamples
inline constexpr int kTexelRoles = 16;                ///< from this bit on, eight
/// The texel, the next ones right and below and the one right of that are whole, for the same roles.
inline constexpr std::uint32_t kBlockWhole = 1u << 24;
/// And so are all around these four.
inline constexpr std::uint32_t kBlockInner = 1u << 25;

/// Of PatchCanvasColumn::source.
inline constexpr int kSourceSlot = 8, kSourceDensity = 16;
/// A sample's pixel is about an ellipse in the picture. Where its axes are a and b pixels long,
/// (a^2 + b^2)^(-1/2), in steps of one to kMostDensity; more than one is told as one.
constexpr std::uint32_t densityOf(std::uint32_t source) { return source >> kSourceDensity; }
inline constexpr std::uint32_t kMostDensity = 4095;
/// What is sampled more thinly is painted again from the second cover, and shown so where that is denser by
/// this factor.
inline constexpr std::uint32_t kThinDensity = 2048;
inline constexpr float kDenser = 1.25f;

/// Of a column of the picture, by row. Arrays have room for kPatchRoom more.
struct PatchCanvasColumn {
  int rows = 0;
  std::uint32_t* open = nullptr;  ///< parts that are not covered
  float* red = nullptr;           ///< sums over covered parts of squared codes, as seen through what is clear
  float* green = nullptr;
  float* blue = nullptr;
  float* clear = nullptr;          ///< what comes through the clear surfaces before the next
  float* inverseZDepth = nullptr;  ///< of the surface that covers most parts, 1/m
  /// Of the same surface: how many parts it covers, its slot from bit kSourceSlot on, and how densely it is
  /// sampled (densityOf) from kSourceDensity on.
  std::uint32_t* source = nullptr;
  std::uint32_t* mirror =
      nullptr;  ///< null: none is wanted. Parts that show a mirror, and its number from bit 16
  /// Bit i: something may be open in rows [i << cellShift, (i + 1) << cellShift), or shows a mirror while
  /// reflections are painted. A patch costs nothing where all is covered.
  std::uint64_t* cells = nullptr;
  /// What that was when patches were painted since pixels were settled: no others need to be.
  const std::uint64_t* reached = nullptr;
  int cellShift = 0;
};
/// The least that does with 64 cells; at least 4.
constexpr int cellShiftOf(int rows) {
  int shift = 4;
  while (rows > 64 << shift) ++shift;
  return shift;
}
inline constexpr int kPatchRoom = 16;

/// A patch and a column of the picture. Places are linear in the picture's row y: value = start + y * step at
/// the centre of a pixel.
struct PatchColumn {
  /// Direction from the capture's centre of projection to the place on the plane, along the middle of its
  /// strip, left of that, and up; up to a positive factor.
  float start[3], step[3];
  float across[3];  ///< its change from one column of the picture to the next
  float depthStart, depthStep,
      depthAcross;  ///< of the inverse depth along the view axis, 1/m; >= 0 before the eye
  float columnOffset, columnsPerRadian;  ///< from the patch's first, of the strip's middle
  float middleTangent;                   ///< of a row near the patch
  float rowOffset, rowsPerRadian;        ///< from the patch's first, of that row
  std::int32_t columns, rows;            ///< of the patch, without its border
  const std::uint32_t* colour;           ///< texels of the patch
  const std::uint32_t* cover;
  std::uint32_t wantedRoles;  ///< bits of texels
  std::uint32_t slot;         ///< of the canvas
  std::uint32_t mirror;       ///< the patch's, 0 = none
  bool blended;
  bool settled;   ///< told as sampled most densely: the second cover is not worth a look (second_look.h)
  bool reflects;  ///< painted where the canvas shows that mirror, and nowhere else
  /// Parts of views: a pixel is painted where low >= 0 and high > 0, or with `eitherSide` one of both.
  bool limited, eitherSide;
  float lowStart, lowStep, highStart, highStep;
};

/// Variants of one processor. Rows are [first, end) of the column.
struct PatchKernel {
  /// Returns how many pixels were painted.
  int (*paint)(const PatchColumn& patch, int first, int end, const PatchCanvasColumn& canvas);
  /// The column's cells, from what is open or, for reflections, from what shows mirrors.
  void (*findCells)(const PatchCanvasColumn& canvas, bool reflections);
  /// From sums to colours in `pixels` (canvas.h), over what they hold: pixels that show mirrors, or all
  /// others.
  void (*settle)(const PatchCanvasColumn& canvas, bool mirrors, std::uint64_t* pixels);
  /// Opens pixels with slots below `frontSlot` for the second cover, but for what was closed before anything
  /// was painted.
  void (*reopen)(const PatchCanvasColumn& canvas, std::uint32_t frontSlot, const std::uint64_t* pixels);
};

extern const PatchKernel kPatchKernelScalar, kPatchKernelAvx2, kPatchKernelAvx512;

}  // namespace acentric
