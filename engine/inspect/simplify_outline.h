#pragma once
/// Fewer corners for an outline, without loops that cross or touch.

#include "engine/geometry/outline.h"

namespace acentric {

/// Do no two edges of the outline meet, but neighbours at their common corner? (exact)
bool isSimple(const Outline& outline);

/// Douglas-Peucker, corners within `tolerance` metres of the result; loops that shrink to nothing are dropped
/// (but never the first, the outer one). Halves the tolerance where the result would not be simple; a simple
/// outline stays simple.
Outline simplifyOutline(const Outline& outline, double tolerance);

}  // namespace acentric
