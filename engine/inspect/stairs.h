#pragma once
/// Flights of steps and ramps between walk planes, cut into pieces that each rise so little that one eye
/// height serves all of a piece. Steps are smoothed over about a metre: ground that an eye is carried along.

#include <vector>

#include "engine/inspect/storeys.h"
#include "engine/layout/layout_spec.h"

namespace acentric {

struct StairOptions {
  WalkableOptions walkable;  ///< its floorHeight and gridStep are not used
  double pieceRise = 0.3;    ///< metres, 0.02..10: how far the ground of a piece rises at most

  Status check() const;
};

struct StairPiece {
  double floorHeight = 0;  ///< z, metres: of the smoothed ground, the mean
  GroundSlope slope;       ///< of the smoothed ground; `rise` is 0 on a landing
  /// What can be walked, one outer loop and its holes. It reaches a little over its neighbours', and over the
  /// planes at the ends.
  Outline outline;
};

/// By height, the lowest piece first. Empty where a finer look finds no way. tooLarge where the way takes
/// more of the plan than stairs do.
Result<std::vector<StairPiece>> findStairs(const Bounds& bounds, const Storeys& storeys, const StoreyWay& way,
                                           const StairOptions& options, const SurfaceProbe& probe);

}  // namespace acentric
