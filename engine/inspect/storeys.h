#pragma once
/// The walk planes of a scene with several storeys: height, area and outline of each, and the stairs and
/// ramps between them. The designer picks one or several: a layout is laid on one.

#include <vector>

#include "engine/inspect/walk_plane.h"
#include "engine/inspect/walkable_outline.h"

namespace acentric {

struct StoreyOptions {
  WalkableOptions walkable;  ///< its floorHeight is not used
  double leastShare = 0.05;  ///< of the largest plane's area: smaller planes are left out,
                             ///< but for the floor that a project stands on
  double leastArea = 2;      ///< square metres: likewise

  Status check() const;
};

/// Where one walks from one plane to another without crossing a third: a step, a stair, a ramp.
struct StoreyLink {
  int lower = 0, upper = 0;  ///< into Storeys::planes
  glm::dvec2 place{0};       ///< middle of the way in plan, metres
};

/// Ground of no plane that is walked from one plane to another: flights of steps, ramps, landings between.
struct StoreyWay {
  std::vector<int> planes;     ///< into Storeys::planes, ascending: two or more
  glm::dvec2 low{0}, high{0};  ///< corners of its box in plan, metres
};

struct Storeys {
  /// By height, lowest first; at one height, the larger first. A height has one for each part of the floor
  /// that is walked about without leaving it. What is within a head's height above a larger plane and cannot
  /// be stepped on from one (a table, a podium) is left out; so are slices of a slope between level planes,
  /// and the outside of a sky box.
  std::vector<WalkPlane> planes;
  std::vector<StoreyLink> links;  ///< by lower, then upper
  std::vector<StoreyWay> ways;    ///< in no particular order
  bool ignoredSides = false;      ///< see walkable_outline.h
};

/// Sides are ignored where they are for the floor that a project stands on: see walkable_outline.h. notFound
/// where there is no floor at all.
Result<Storeys> findStoreys(const Bounds& bounds, const StoreyOptions& options, const SurfaceProbe& probe);

}  // namespace acentric
