#pragma once
/// Colour: linear radiance (Rec.709) to display and back.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/image/image.h"

namespace acentric {

float linearFromSrgb(float encoded);  ///< [0,1] -> [0,1]
float srgbFromLinear(float linear);   ///< [0,1] -> [0,1]
/// 256 entries: linear value of each 8-bit sRGB code.
const std::array<float, 256>& linearFromSrgbTable();
/// The nearest 8-bit sRGB code, by tables (exact, no powers). Values outside [0,1] are clamped, NaN is 0.
std::uint8_t srgbCodeFromLinear(float linear);
/// Its tables, for inner loops: the code of a value in [0,1] is that of its bucket (tone_curve.h), or one
/// more from the next code's threshold on.
struct DisplayCodes {
  static constexpr int kRoom = 3;  ///< bytes that may be read behind the last
  const float* threshold;          ///< 257: the smallest linear value that rounds to each code; 2 at the end
  const std::uint8_t* firstCode;   ///< buckets + 1: the code at each one's lower end
};
DisplayCodes displayCodes();

/// Of linear Rec.709.
inline float luminance(const glm::vec3& colour) {
  return glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Neutral tone curve: identity up to 0.76 after exposure, a smooth shoulder to 1 above, hue kept: highlights
/// lose colour instead of clipping channel by channel. Returns display-linear values in [0,1]. `exposure` is
/// a factor. NaN and negative radiance count as 0, infinity as very bright.
glm::vec3 toneMap(const glm::vec3& radiance, float exposure);

/// sRGB codes of display-linear values; alpha is rounded as it is.
Rgba8 encodeShown(const glm::vec3& display, float alpha = 1);
/// The same after toneMap.
Rgba8 encodeForDisplay(const glm::vec3& radiance, float exposure, float alpha = 1);

/// Straight-alpha "source over destination" in display-linear light, both sRGB coded; the result's alpha is
/// 255.
Rgba8 blendOver(const Rgba8& source, const Rgba8& destination);

/// Has no pixel that anything behind it shows through?
bool isOpaque(const ColourImage& image);

}  // namespace acentric
