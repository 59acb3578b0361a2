#pragma once
/// Finds how the surfaces of a capture are turned, from the samples beside each sample.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/column_camera.h"

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

/// The code nearest to a tangent; those beyond the largest are cut off.
std::int8_t slantCode(double tangent);
double slantTangent(std::int8_t code);

/// Of every sample of a list in capture order (CaptureSamples). Of the samples in the next pixel on either
/// side the one nearest in depth counts, and of the two sides the flatter one, unless both still look like
/// one surface: then the steeper. Zero where no side does, where it would be steeper than some 84 degrees and
/// does not go on evenly, where a surface turns away at its edge (drawn as steep as it is there, it would
/// reach far beyond it), and for the sky. At the rim of a round body that the camera looks past, where the
/// side towards it and the one away from it run together, the samples of both reach for each other: between
/// them lies what an eye beside the camera looks at.
std::vector<Slant> slantsOf(const ColumnCamera& camera, std::span<const std::uint32_t> columnStart,
                            std::span<const std::uint16_t> row, std::span<const float> inverseDistance);

}  // namespace acentric
