#pragma once
/// Samples of facets that are turned towards the camera (edge_on.h), and how a capture takes them in.

#include <vector>

#include "engine/image/capture.h"
#include "engine/image/sample_counts.h"

namespace acentric {

struct TurnedSample {
  std::uint32_t pixel = 0;  ///< column * rows + row
  float inverseDistance = 0;
  HalfColour colour{0};
  std::uint8_t roles = 0, mirror = 0;
  std::uint16_t coverage = 0;
  SurfacePlane plane;
  SurfacePlane met;  ///< the plane of what rays meet of the same facet
};

/// Adds samples to a list, in the order of captures. What rays met of the same facets in the same parts gives
/// way to them.
void mergeTurned(std::vector<TurnedSample> added, int rows, CaptureSamples& list);

/// Of a list's samples those that are kept, by their place in the pixel.
SampleCounts countsOf(const CaptureSamples& list);

}  // namespace acentric
