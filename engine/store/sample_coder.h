#pragma once
/// Everything of a list of samples but its colours as one range-coded stream (FORMAT.md, "Range-coded
/// streams"): how many samples each pixel holds, and of each sample its inverse distance, roles, opacity and,
/// where there are any, mirror, coverage and plane, each plane's numbers where it is met first. Each is
/// predicted by the samples above it and in the column before. Exact.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/capture.h"

namespace acentric {

/// Which arrays a list has, and how its distances are numbered.
struct SampleShape {
  ColumnCamera camera;
  std::size_t samples = 0;
  bool mirrors = false;     ///< each sample has a number
  std::size_t planes = 0;   ///< of silhouettes; 0 = it does not know them
  double distanceStep = 0;  ///< of which all inverse distances are multiples; 0 = they are numbered by bits
};

/// The step if all of the list are multiples of it within reach of 32 bits, else 0.
double codedStep(const CaptureSamples& samples, double distanceStep);

/// `samples` are sound (Capture::check).
std::vector<std::byte> codeSamples(const CaptureSamples& samples, const SampleShape& shape);

/// Fills all arrays; of colours alpha alone. Numbers are in range; that the
/// whole is a capture Capture::check tells. `malformed` without a place.
Status decodeSamples(std::span<const std::byte> bytes, const SampleShape& shape, CaptureSamples& out);

}  // namespace acentric
