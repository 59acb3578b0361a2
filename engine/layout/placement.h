#pragma once
/// Which lattice regions a spec places: those that share area with its outline, those added, less those
/// removed.

#include <vector>

#include "engine/layout/lattice.h"

namespace acentric {

/// Is a cell among placedCells? Looks at this one alone.
bool isPlaced(const LayoutSpec& spec, const Lattice& lattice, const CellId& cell);

/// Addresses in order. Stops as soon as the limit is passed, however large the outline.
Result<std::vector<CellId>> placedCells(const LayoutSpec& spec, const Lattice& lattice);

/// Addresses, in order, of lattice regions that share area with the outline; stops beyond `limit` of them.
std::vector<CellId> cellsOverlapping(const Outline& outline, const Lattice& lattice, std::size_t limit);

}  // namespace acentric
