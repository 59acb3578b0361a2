#pragma once
/// How near a frame is to the truth.

#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/view/frame.h"

namespace acentric {

struct Comparison {
  double psnr = 0;       ///< dB over sRGB codes, red, green and blue of all pixels; 99 if identical
  double ssim = 0;       ///< mean structural similarity of luma, 11x11 Gaussian window (Wang et al. 2004)
  double holeShare = 0;  ///< pixels without real sample where the truth has a surface, of all pixels
};

/// Same sizes. `truthDistance`: metres, infinity where the truth has no surface.
Result<Comparison> compare(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance);

/// Pixels without real sample where the truth has a surface, of all pixels. Same sizes.
double holeShareOf(const Frame& frame, const FloatImage& truthDistance);

/// Both need pictures of one size. Alpha is not looked at.
double psnrOf(const ColourImage& a, const ColourImage& b);
double ssimOf(const ColourImage& a, const ColourImage& b);
/// |a - b| per colour channel, times `gain`; opaque.
ColourImage differenceImage(const ColourImage& a, const ColourImage& b, int gain = 4);

/// Pictures side by side in a grid, `columns` per row, `gap` pixels between, for contact sheets. Cells are as
/// large as the largest picture; smaller ones lie in their cell's upper left corner.
ColourImage contactSheet(const std::vector<ColourImage>& pictures, int columns, int gap = 4);

}  // namespace acentric
