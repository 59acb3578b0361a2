#include "engine/image/colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/image/tone_curve.h"

namespace acentric {
namespace {

using namespace tone_curve;

/// A finite value >= 0: NaN and negative radiance are black, infinity is the brightest there is.
float usable(float value) { return value > 0 ? std::min(value, kBrightest) : 0.0f; }

double decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

struct CodeTable {
  std::array<float, 257> threshold{};
  std::array<std::uint8_t, kCodeBuckets + 1 + DisplayCodes::kRoom> firstCode{};

  CodeTable() {
    threshold[0] = 0;
    for (int code = 1; code < 256; ++code)
      threshold[static_cast<std::size_t>(code)] = static_cast<float>(decode((code - 0.5) / 255.0));
    threshold[256] = 2;  // never reached
    std::size_t code = 0;
    for (int bucket = 0; bucket <= kCodeBuckets; ++bucket) {
      while (threshold[code + 1] <= static_cast<float>(bucket) / kCodeBuckets) ++code;
      firstCode[static_cast<std::size_t>(bucket)] = static_cast<std::uint8_t>(code);
    }
  }

  std::uint8_t codeOf(float linear) const {
    if (!(linear > 0)) return 0;  // NaN too
    if (linear >= 1) return 255;
    const std::size_t code = firstCode[static_cast<std::size_t>(static_cast<int>(linear * kCodeBuckets))];
    return static_cast<std::uint8_t>(code + (linear >= threshold[code + 1] ? 1 : 0));
  }
};

const CodeTable& codeTable() {
  static const CodeTable table;
  return table;
}

std::uint8_t roundToByte(float unit) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit > 0 ? unit : 0.0f, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

float linearFromSrgb(float encoded) { return static_cast<float>(decode(std::clamp(encoded, 0.0f, 1.0f))); }

float srgbFromLinear(float linear) {
  const double value = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return static_cast<float>(value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055);
}

const std::array<float, 256>& linearFromSrgbTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t code = 0; code < values.size(); ++code)
      values[code] = static_cast<float>(decode(static_cast<double>(code) / 255.0));
    return values;
  }();
  return table;
}

DisplayCodes displayCodes() { return {codeTable().threshold.data(), codeTable().firstCode.data()}; }

std::uint8_t srgbCodeFromLinear(float linear) { return codeTable().codeOf(linear); }

glm::vec3 toneMap(const glm::vec3& radiance, float exposure) {
  const glm::vec3 colour(usable(radiance.x * exposure), usable(radiance.y * exposure),
                         usable(radiance.z * exposure));
  const float peak = std::max({colour.x, colour.y, colour.z});
  if (peak <= kShoulderStart) return colour;
  // The shoulder 1 - r^2 / (peak - start + r), with r the room above the start, meets the identity with equal
  // value and slope, and tends to 1.
  constexpr float room = 1 - kShoulderStart;
  const float mappedPeak = 1 - room * room / (peak - kShoulderStart + room);
  const glm::vec3 scaled = colour * (mappedPeak / peak);
  // Mixing towards the grey of the same peak keeps the hue and never lowers a channel.
  const float keep = 1 / (kHighlightDesaturation * (peak - mappedPeak) + 1);
  const glm::vec3 mixed = glm::vec3(mappedPeak) + (scaled - glm::vec3(mappedPeak)) * keep;
  return glm::clamp(mixed, 0.0f, 1.0f);
}

Rgba8 encodeForDisplay(const glm::vec3& radiance, float exposure, float alpha) {
  return encodeShown(toneMap(radiance, exposure), alpha);
}

Rgba8 encodeShown(const glm::vec3& display, float alpha) {
  const CodeTable& table = codeTable();
  return Rgba8(table.codeOf(display.x), table.codeOf(display.y), table.codeOf(display.z),
               alpha == 1 ? std::uint8_t(255) : roundToByte(alpha));
}

Rgba8 blendOver(const Rgba8& source, const Rgba8& destination) {
  if (source.a == 255) return source;
  if (source.a == 0) return Rgba8(destination.r, destination.g, destination.b, 255);
  const std::array<float, 256>& linear = linearFromSrgbTable();
  const float alpha = static_cast<float>(source.a) / 255.0f;
  const auto mix = [&](std::uint8_t over, std::uint8_t under) {
    return srgbCodeFromLinear(linear[under] + (linear[over] - linear[under]) * alpha);
  };
  return Rgba8(mix(source.r, destination.r), mix(source.g, destination.g), mix(source.b, destination.b), 255);
}

bool isOpaque(const ColourImage& image) {
  return std::ranges::all_of(image.pixels, [](const Rgba8& p) { return p.a == 255; });
}

}  // namespace acentric
