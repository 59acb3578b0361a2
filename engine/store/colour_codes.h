#pragma once
/// Linear radiance as codes of 10 bits that lossy pictures keep (FORMAT.md, "Colours as pictures"): up to 1
/// as sRGB has it, above by the logarithm, up to the largest half float. So what a picture is off by looks
/// alike at any exposure that shows something. Luma and two chromas of ITU-R BT.709, full range.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

inline constexpr int kColourBits = 10;
inline constexpr int kMostColourCode = (1 << kColourBits) - 1;
/// Codes from radiance 0 to 1.
inline constexpr float kCodesToOne = 271;

/// Luma, blue and red chroma of a sample.
using ColourCodes = std::array<std::uint16_t, 3>;

class ColourCoder {
 public:
  ColourCoder();
  ColourCodes codesOf(const HalfColour& colour) const;
  /// Opaque. Codes beyond kMostColourCode count as that.
  HalfColour colourOf(const ColourCodes& codes) const;

 private:
  static constexpr int kFraction = 3;  ///< bits of a code's parts in the table back
  std::vector<float> codeOfHalf_;
  std::vector<std::uint16_t> halfOfCode_;
};

}  // namespace acentric
