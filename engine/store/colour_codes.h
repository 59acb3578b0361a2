#pragma once
/// Colours as the codes that lossy pictures keep (FORMAT.md, "Colours as pictures"): luma and two chromas of
/// ITU-R BT.709, full range. Stores keep radiance in 10 bits, up to 1 as sRGB has it, above by the logarithm,
/// up to the largest half float: what a picture is off by looks alike at any exposure that shows something.
/// Bundles keep what is shown at their exposure, sRGB in 8 bits, which browsers decode themselves.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

enum class ColourScale : std::uint8_t { radiance, display };

constexpr int bitsOf(ColourScale scale) { return scale == ColourScale::radiance ? 10 : 8; }
constexpr int mostCodeOf(ColourScale scale) { return (1 << bitsOf(scale)) - 1; }
/// Codes from radiance 0 to 1.
inline constexpr float kCodesToOne = 271;

/// Luma, blue and red chroma of a sample.
using ColourCodes = std::array<std::uint16_t, 3>;

/// Of red, green and blue as codes of so many bits.
ColourCodes lumaAndChroma(const glm::vec3& codes, int bits);

class ColourCoder {
 public:
  /// `exposure` at which display codes show radiance.
  explicit ColourCoder(ColourScale scale, float exposure = 1);
  ColourCodes codesOf(const HalfColour& radiance) const;
  /// Opaque. Codes beyond the scale's largest count as that. Of display codes what is shown, linear.
  HalfColour colourOf(const ColourCodes& codes) const;

 private:
  static constexpr int kFraction = 3;  ///< bits of a code's parts in the table back
  ColourScale scale_;
  float exposure_;
  std::vector<float> codeOfHalf_;          ///< of radiance
  std::vector<std::uint16_t> halfOfCode_;  ///< the same back, by part of a code
  std::vector<float> shownOfCode_;         ///< of display codes, by part of a code: linear
};

}  // namespace acentric
