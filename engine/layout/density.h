#pragma once
/// Edits of LayoutSpec::density.

#include "engine/layout/layout.h"

namespace acentric {

/// Gives a region or a free APV so many times the project's samples per degree; 1: as many, also within a
/// whole that has others.
void giveDensity(LayoutSpec& spec, const CellId& cell, double density);

}  // namespace acentric
