#pragma once
/// How visible it is where local geometry meets what captures painted, and how much a picture changes when
/// the eye changes region. Differences are root mean squares over red, green and blue, in sRGB codes
/// (0..255).

#include <cstddef>

#include "engine/image/image.h"
#include "engine/view/frame.h"

namespace acentric {

/// A jump in colour that the truth has not, of at least so many codes, counts as visible.
inline constexpr double kVisibleStep = 8;

/// Of pairs of neighbouring pixels (in a row or in a column): how much more the picture changes across a pair
/// than the truth does.
struct StepSums {
  std::size_t pairs = 0;
  double excess = 0;        ///< summed; 0 for a pair across which the picture changes less
  std::size_t visible = 0;  ///< pairs with an excess of at least kVisibleStep

  void add(double pairExcess);
  double meanExcess() const { return pairs == 0 ? 0 : excess / double(pairs); }
  double visibleShare() const { return pairs == 0 ? 0 : double(visible) / double(pairs); }
  StepSums& operator+=(const StepSums& other);
};

/// Sums over a frame, or over many. Only pairs are counted that show one surface, going on from one pixel to
/// the next: at silhouettes the truth itself jumps, and where it does so hides any seam.
struct SeamSums {
  StepSums across;              ///< one pixel painted by local geometry, the other by a camera
  StepSums within;              ///< both by local geometry, or both by one camera: what else goes wrong there
  std::size_t silhouettes = 0;  ///< pairs across the border that do not show one surface
  double localSquares = 0, capturedSquares = 0;  ///< of the errors on either side of `across`

  double localError() const;     ///< RMS
  double capturedError() const;  ///< RMS
  SeamSums& operator+=(const SeamSums& other);
};

/// All of one size. `truthDistance`: metres along the ray, infinity where there is no surface. Holes, filled
/// or not, and their neighbours are left out.
SeamSums measureSeam(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance);

/// How much a picture changes.
struct Change {
  double psnr = 0;          ///< dB; 99 if it does not
  double ssim = 0;          ///< 1 if it does not
  double changedShare = 0;  ///< of the pixels, those that differ by at least kVisibleStep
};
/// Both of one size.
Change changeBetween(const ColourImage& before, const ColourImage& after);

}  // namespace acentric
