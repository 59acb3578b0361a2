#include <array>
#include <cmath>

#include "engine/base/contract.h"
#include "engine/measure/compare.h"

namespace acentric {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kLargestCode = 255;
// Wang et al. 2004, section III.B: the constants that keep the quotients finite in flat, dark places.
constexpr double kC1 = (0.01 * kLargestCode) * (0.01 * kLargestCode);
constexpr double kC2 = (0.03 * kLargestCode) * (0.03 * kLargestCode);

using Luma = Image<double>;

/// Rec.601 luma of the codes, as the paper's own implementation takes it.
Luma lumaOf(const ColourImage& picture) {
  Luma luma(picture.width, picture.height);
  for (std::size_t i = 0; i < luma.pixels.size(); ++i) {
    const Rgba8& code = picture.pixels[i];
    luma.pixels[i] = 0.299 * code.r + 0.587 * code.g + 0.114 * code.b;
  }
  return luma;
}

/// Gaussian weights that sum to 1. A picture narrower than the window gets a window of its own width.
std::vector<double> windowFor(int extent) {
  std::vector<double> weights(static_cast<std::size_t>(std::min(extent, kWindow)));
  const double centre = 0.5 * static_cast<double>(weights.size() - 1);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double offset = (static_cast<double>(i) - centre) / kSigma;
    sum += weights[i] = std::exp(-0.5 * offset * offset);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Weighted means of a, b, a^2, b^2 and ab.
using Moments = std::array<double, 5>;

/// Means over all windows.
struct Similarity {
  double whole = 0;      ///< equation 13
  double structure = 0;  ///< without the comparison of luminances: of contrast and structure alone
};

Similarity similarityOf(const Moments& m) {
  const double varianceA = m[2] - m[0] * m[0], varianceB = m[3] - m[1] * m[1],
               covariance = m[4] - m[0] * m[1];
  const double structure = (2 * covariance + kC2) / (varianceA + varianceB + kC2);
  return {structure * (2 * m[0] * m[1] + kC1) / (m[0] * m[0] + m[1] * m[1] + kC1), structure};
}

Similarity similarityOf(const Luma& a, const Luma& b) {
  const std::vector<double> across = windowFor(a.width), down = windowFor(a.height);
  const std::size_t width = static_cast<std::size_t>(a.width), height = static_cast<std::size_t>(a.height);
  const std::size_t outWidth = width - across.size() + 1, outHeight = height - down.size() + 1;

  // The window is separable: rows first. Only the last rows that a window spans are kept.
  std::vector<Moments> rows(outWidth * down.size());
  std::vector<Moments> line(width);
  Similarity sum;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const double p = a.pixels[y * width + x], q = b.pixels[y * width + x];
      line[x] = {p, q, p * p, q * q, p * q};
    }
    Moments* row = &rows[(y % down.size()) * outWidth];
    for (std::size_t x = 0; x < outWidth; ++x) {
      row[x] = {};
      for (std::size_t i = 0; i < across.size(); ++i)
        for (std::size_t m = 0; m < 5; ++m) row[x][m] += across[i] * line[x + i][m];
    }
    if (y + 1 < down.size()) continue;
    const std::size_t top = y + 1 - down.size();
    for (std::size_t x = 0; x < outWidth; ++x) {
      Moments moments{};
      for (std::size_t i = 0; i < down.size(); ++i)
        for (std::size_t m = 0; m < 5; ++m)
          moments[m] += down[i] * rows[((top + i) % down.size()) * outWidth + x][m];
      const Similarity here = similarityOf(moments);
      sum.whole += here.whole, sum.structure += here.structure;
    }
  }
  const double windows = static_cast<double>(outWidth * outHeight);
  return {sum.whole / windows, sum.structure / windows};
}

/// Half the size: means of 2 x 2 pixels; beyond an odd last row or column it is repeated.
Luma halved(const Luma& picture) {
  Luma half((picture.width + 1) / 2, (picture.height + 1) / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const int right = std::min(2 * x + 1, picture.width - 1),
                below = std::min(2 * y + 1, picture.height - 1);
      half.at(x, y) = (picture.at(2 * x, 2 * y) + picture.at(right, 2 * y) + picture.at(2 * x, below) +
                       picture.at(right, below)) /
                      4;
    }
  return half;
}

/// Wang, Simoncelli and Bovik 2003, section 3.2: the exponents of the scales, the finest first.
constexpr std::array kScaleWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};

}  // namespace

double ssimOf(const ColourImage& a, const ColourImage& b) {
  require(a.width == b.width && a.height == b.height, "similarity is between pictures of one size");
  return a.empty() ? 1 : similarityOf(lumaOf(a), lumaOf(b)).whole;
}

double msSsimOf(const ColourImage& a, const ColourImage& b) {
  require(a.width == b.width && a.height == b.height, "similarity is between pictures of one size");
  if (a.empty()) return 1;
  Luma p = lumaOf(a), q = lumaOf(b);
  double product = 1;
  for (std::size_t scale = 0; scale < kScaleWeights.size(); ++scale) {
    if (scale > 0) p = halved(p), q = halved(q);
    const Similarity here = similarityOf(p, q);
    const double value = scale + 1 < kScaleWeights.size() ? here.structure : here.whole;
    product *= std::pow(std::max(value, 0.0), kScaleWeights[scale]);
  }
  return product;
}

}  // namespace acentric
