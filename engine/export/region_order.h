#pragma once
/// Regions of a layout as a bundle lists them.

#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

/// Numbers of the regions so that the first one that holds a point is the one where an eye stands: free ones
/// before those of the lattice.
std::vector<int> searchOrder(const Layout& layout);

/// By region the others that it touches or overlaps, rising.
std::vector<std::vector<int>> touching(const std::vector<Region>& regions);

}  // namespace acentric
