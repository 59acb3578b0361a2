#pragma once
/// Finds how the surfaces of a capture are turned, from the samples beside each sample. A surface that a
/// camera sees at a slant and the eye does not is sampled farther apart on the picture: splats that know it
/// leave no cracks there, and need not be larger everywhere for fear of it.

#include <span>
#include <vector>

#include "engine/geometry/column_camera.h"
#include "engine/view/slant_code.h"

namespace acentric {

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
