#pragma once
/// How a sample's surface is turned away from its camera, in two bytes. Free of the standard library, for the
/// kernels.

#include <cstdint>

namespace acentric {

/// Tangents of the angles by which the surface leans, along a row and along a column of the capture: the
/// change of the inverse distance from one sample to the next, by the inverse distance and the pitch. Each is
/// code / (127 - |code|), from -62.5 to 62.5, in steps that grow with it.
struct Slant {
  std::int8_t across = 0;  ///< towards rising columns
  std::int8_t down = 0;    ///< towards rising rows
  bool operator==(const Slant&) const = default;
};
inline constexpr int kLargestSlantCode = 125;

}  // namespace acentric
