#pragma once
/// How near a frame is to the truth.

#include <string>
#include <vector>

#include "engine/geometry/perspective_view.h"
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

/// How far a frame's surfaces lie from the truth's, along the rays: the mean over all pixels with a real
/// sample of |1/d - 1/t| over the larger of both, 0..1; d the frame's distance, t the truth's, infinity where
/// there is no surface. 0 if both are infinite. `inverseZDepth` (1/m) is along the view's axis. Same sizes.
double depthErrorOf(const Frame& frame, const FloatImage& inverseZDepth, const PerspectiveView& view,
                    const FloatImage& truthDistance);

/// Both need pictures of one size. Alpha is not looked at.
double psnrOf(const ColourImage& a, const ColourImage& b);
/// `squares`: sum of squared differences of red, green and blue codes over so many pixels. 99 dB if there is
/// no error.
double psnrOfSquares(double squares, std::size_t pixels);
double ssimOf(const ColourImage& a, const ColourImage& b);
/// Multi-scale structural similarity of luma (Wang, Simoncelli and Bovik 2003, equation 7): five scales, each
/// half the size of the one before. Where the structure of a scale is opposed it counts as 0.
double msSsimOf(const ColourImage& a, const ColourImage& b);
/// |a - b| per colour channel, times `gain`; opaque.
ColourImage differenceImage(const ColourImage& a, const ColourImage& b, int gain = 4);

/// Pictures side by side in a grid, `columns` per row, `gap` pixels between, for contact sheets. Cells are as
/// large as the largest picture; smaller ones lie in their cell's upper left corner.
ColourImage contactSheet(const std::vector<ColourImage>& pictures, int columns, int gap = 4);

}  // namespace acentric
