#pragma once
/// WebP in memory.

#include <cstddef>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

inline constexpr int kLargestWebp = 16383;  ///< pixels a side

/// `quality`: WebP's own, 0..99, or kLosslessColours. Alpha is kept exactly. Pixels that are clear keep their
/// colours as all others do, for filters that reach across a mask's edge.
Result<std::vector<std::byte>> encodeWebp(const ColourImage& image, int quality);

}  // namespace acentric
