#include "engine/store/colour_codes.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"

namespace acentric {
namespace {

constexpr std::uint16_t kHalfInfinity = 0x7c00, kHalfOne = 0x3c00;
constexpr float kPerNeper = 0.25f;  ///< of the codes to 1: how much e times the radiance adds

float codeOf(float radiance) {
  return kCodesToOne * (radiance <= 1 ? srgbFromLinear(radiance) : 1 + kPerNeper * std::log(radiance));
}
float radianceOf(float code) {
  const float part = code / kCodesToOne;
  return part <= 1 ? linearFromSrgb(part) : std::exp((part - 1) / kPerNeper);
}

/// BT.709.
constexpr float kRed = 0.2126f, kBlue = 0.0722f, kGreen = 1 - kRed - kBlue;
constexpr float kFromBlue = 2 * (1 - kBlue), kFromRed = 2 * (1 - kRed);
constexpr int kMiddle = 1 << (kColourBits - 1);
/// Parts of 2^16, for the way back.
constexpr std::int64_t fixed(float value) { return std::int64_t(value * 65536 + 0.5f); }
constexpr std::int64_t kRedFromCr = fixed(kFromRed), kBlueFromCb = fixed(kFromBlue),
                       kGreenFromCr = fixed(kRed * kFromRed / kGreen),
                       kGreenFromCb = fixed(kBlue * kFromBlue / kGreen);

std::uint16_t rounded(float code) { return std::uint16_t(std::clamp(int(code + 0.5f), 0, kMostColourCode)); }

}  // namespace

ColourCoder::ColourCoder() : codeOfHalf_(kHalfInfinity), halfOfCode_((kMostColourCode << kFraction) + 1) {
  for (std::size_t half = 0; half < codeOfHalf_.size(); ++half)
    codeOfHalf_[half] = codeOf(floatFromHalf(std::uint16_t(half)));
  for (std::size_t code = 0; code < halfOfCode_.size(); ++code)
    halfOfCode_[code] = packColour(glm::vec4(radianceOf(float(code) / (1 << kFraction)))).r;
}

ColourCodes ColourCoder::codesOf(const HalfColour& colour) const {
  const float r = codeOfHalf_[colour.r], g = codeOfHalf_[colour.g], b = codeOfHalf_[colour.b];
  const float luma = kRed * r + kGreen * g + kBlue * b;
  return {rounded(luma), rounded((b - luma) / kFromBlue + kMiddle), rounded((r - luma) / kFromRed + kMiddle)};
}

HalfColour ColourCoder::colourOf(const ColourCodes& codes) const {
  const std::int64_t luma = std::int64_t(std::min<int>(codes[0], kMostColourCode)) << 16,
                     cb = std::min<int>(codes[1], kMostColourCode) - kMiddle,
                     cr = std::min<int>(codes[2], kMostColourCode) - kMiddle;
  const auto half = [&](std::int64_t code) {
    const std::int64_t part = (code + (1 << (15 - kFraction))) >> (16 - kFraction);
    return halfOfCode_[std::size_t(
        std::clamp<std::int64_t>(part, 0, std::int64_t(kMostColourCode) << kFraction))];
  };
  return {half(luma + kRedFromCr * cr), half(luma - kGreenFromCr * cr - kGreenFromCb * cb),
          half(luma + kBlueFromCb * cb), kHalfOne};
}

}  // namespace acentric
