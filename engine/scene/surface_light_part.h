#pragma once
/// A part of a surface light that is being baked, as it is kept on disk: what the bake before this one had
/// left need not be baked again.

#include <cstdint>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

/// The bake counts its runs of triangles; these are some of them, and their samples one behind the other.
struct SurfaceLightPart {
  std::vector<std::uint32_t> runs;   ///< ascending; as made finer they are counted on behind the others
  std::vector<std::uint32_t> sizes;  ///< of each: its number of samples
  std::vector<HalfColour> light;
};

}  // namespace acentric
