#pragma once
/// A rendered picture and where each pixel came from.

#include <array>
#include <cstdint>

#include "engine/image/image.h"

namespace acentric {

/// Source of a pixel: 0 = hole; 1.. = camera index + 1; the values below are special.
using PixelSource = std::uint16_t;
inline constexpr PixelSource kSourceHole = 0;
inline constexpr PixelSource kSourceLocal = 0xffff;  ///< local geometry
inline constexpr PixelSource kSourceInvented =
    0xfffe;  ///< screen-space fill: counts as a hole, never as covered
inline constexpr PixelSource kSourceBackground =
    0xfffd;  ///< steeper than anything that a capture could hold (background.h)

/// Painted from something that is there, not a hole.
constexpr bool isReal(PixelSource source) { return source != kSourceHole && source != kSourceInvented; }

/// Source of what a camera captured.
constexpr PixelSource sourceOfCamera(int camera) {
  return camera + 1 < kSourceBackground ? static_cast<PixelSource>(camera + 1) : kSourceBackground - 1;
}

struct FrameStats {
  int images = 0;         ///< captures drawn
  int missingImages = 0;  ///< captures that the view needs and that are not there to be drawn
  std::uint64_t samplesRead = 0;
  std::uint64_t samplesDrawn = 0;  ///< that fell on the picture
  int capturesAwaited = 0;         ///< captures that are loaded and not on the graphics card yet
  int standIns = 0;             ///< of these: drawn as what their camera had before; the others are missing
  std::uint64_t bytesSent = 0;  ///< of captures, to the graphics card since the frame before
  std::uint64_t localTriangles = 0;
  double sendSeconds = 0;  ///< for that, and for packing what the frame packed itself
  double planSeconds = 0;  ///< choosing pieces and columns
  double warpSeconds = 0;  ///< the background, from captures to pixels
  double localSeconds = 0;
  double fillSeconds = 0;
  double totalSeconds = 0;
};

struct Frame {
  ColourImage colour;  ///< opaque; holes are 0,0,0 with alpha 0 (invented pixels: alpha 255)
  Image<PixelSource> source;
  FrameStats stats;

  /// Pixels without a real sample (hole or invented).
  std::size_t holeCount() const;
  /// White = hole or invented, black = covered.
  ColourImage holeMask() const;
};

}  // namespace acentric
