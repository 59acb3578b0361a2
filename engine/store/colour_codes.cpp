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
/// Parts of 2^16, for the way back.
constexpr std::int64_t fixed(float value) { return std::int64_t(value * 65536 + 0.5f); }
constexpr std::int64_t kRedFromCr = fixed(kFromRed), kBlueFromCb = fixed(kFromBlue),
                       kGreenFromCr = fixed(kRed * kFromRed / kGreen),
                       kGreenFromCb = fixed(kBlue * kFromBlue / kGreen);

}  // namespace

ColourCodes lumaAndChroma(const glm::vec3& codes, int bits) {
  const auto rounded = [&](float code) {
    return std::uint16_t(std::clamp(int(code + 0.5f), 0, (1 << bits) - 1));
  };
  const float luma = kRed * codes.r + kGreen * codes.g + kBlue * codes.b;
  const float middle = float(1 << (bits - 1));
  return {rounded(luma), rounded((codes.b - luma) / kFromBlue + middle),
          rounded((codes.r - luma) / kFromRed + middle)};
}

ColourCoder::ColourCoder(ColourScale scale, float exposure) : scale_(scale), exposure_(exposure) {
  const std::size_t parts = (std::size_t(mostCodeOf(scale)) << kFraction) + 1;
  const auto codeOfPart = [](std::size_t part) { return float(part) / (1 << kFraction); };
  if (scale == ColourScale::display) {
    for (std::size_t part = 0; part < parts; ++part)
      shownOfCode_.push_back(linearFromSrgb(codeOfPart(part) / float(mostCodeOf(scale))));
    return;
  }
  for (std::uint16_t half = 0; half < kHalfInfinity; ++half)
    codeOfHalf_.push_back(codeOf(floatFromHalf(half)));
  for (std::size_t part = 0; part < parts; ++part)
    halfOfCode_.push_back(packColour(glm::vec4(radianceOf(codeOfPart(part)))).r);
}

ColourCodes ColourCoder::codesOf(const HalfColour& radiance) const {
  glm::vec3 codes;
  if (scale_ == ColourScale::radiance) {
    codes = {codeOfHalf_[radiance.r], codeOfHalf_[radiance.g], codeOfHalf_[radiance.b]};
  } else {
    const glm::vec3 shown = toneMap(glm::vec3(unpackColour(radiance)), exposure_);
    for (int c = 0; c < 3; ++c) codes[c] = float(mostCodeOf(scale_)) * srgbFromLinear(shown[c]);
  }
  return lumaAndChroma(codes, bitsOf(scale_));
}

HalfColour ColourCoder::colourOf(const ColourCodes& codes) const {
  const int most = mostCodeOf(scale_), middle = 1 << (bitsOf(scale_) - 1);
  const std::int64_t luma = std::int64_t(std::min<int>(codes[0], most)) << 16,
                     cb = std::min<int>(codes[1], most) - middle, cr = std::min<int>(codes[2], most) - middle;
  const auto partOf = [&](std::int64_t code) {
    const std::int64_t part = (code + (1 << (15 - kFraction))) >> (16 - kFraction);
    return std::size_t(std::clamp<std::int64_t>(part, 0, std::int64_t(most) << kFraction));
  };
  const std::size_t r = partOf(luma + kRedFromCr * cr),
                    g = partOf(luma - kGreenFromCr * cr - kGreenFromCb * cb),
                    b = partOf(luma + kBlueFromCb * cb);
  if (scale_ == ColourScale::radiance) return {halfOfCode_[r], halfOfCode_[g], halfOfCode_[b], kHalfOne};
  return packColour({shownOfCode_[r], shownOfCode_[g], shownOfCode_[b], 1});
}

}  // namespace acentric
