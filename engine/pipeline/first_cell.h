#pragma once
/// Cells of a new project, and how many cameras it has at most.

#include <optional>
#include <set>
#include <stop_token>

#include "engine/inspect/near_ground.h"
#include "engine/layout/layout.h"

namespace acentric {

/// firstCellSize gives larger ones only where the walkable area is vast.
inline constexpr double kLargestUsualCell = 6.0;  ///< metres

// Where not all ground is laid out, a ring's room (the radius of the circle within it) is twice the middle
// distance to what stands about, on the ground where the walk begins: as large as the street is wide. Where
// rings can be split, it is so of each region, between half and twice that.
inline constexpr double kLeastRoom = 1.5, kMostRoom = 6;  ///< metres
inline constexpr double kRoomOfClearance = 2;
inline constexpr double kGroundToMeasure = 10'000;  ///< square metres
/// Split where the mean distance to what stands about is less than this share of a region's room: in a street
/// as wide as the region it is half of it, less what a survey's steps and the lattice's place take.
inline constexpr double kRoomToSplit = 0.45;
/// Where regions are large because nothing is near, so is what is drawn as polygons around them: pictures
/// then look the same, only larger.
inline constexpr double kBandOfRoom = 0.75;

struct FirstLayoutLimit {
  std::size_t cameras = 0;  ///< 0 = none
  std::optional<glm::dvec2>
      around;                       ///< plan: where the part begins that is laid out; none: see near_ground.h
  bool chooseCell = true;           ///< else the spec's own size is kept
  bool chooseConfiguration = true;  ///< likewise; with chooseCell alone
};

/// Has buildLayout(spec) more cameras than the limit?
bool exceeds(const LayoutSpec& spec, const FirstLayoutLimit& limit);

/// A spec for as much of the spec's outline as the limit lets, for one that exceeds it. Where something
/// stands about: the ground that is walked first, its cells as large as suits the distance to what stands
/// about, the lattice shifted to where its cameras stand freest; of configuration e if it may be chosen.
/// Where nothing does: all of it with larger cells, if they may be chosen, else what is around its middle.
Result<LayoutSpec> keepWithin(const LayoutSpec& spec, const FirstLayoutLimit& limit, const Bounds& bounds,
                              bool ignoredSides, const SurfaceProbe& probe, std::stop_token stop = {});

/// Regions of the pattern's cell size, and their parts, that are to be split: see kRoomToSplit. No parts are
/// made with less room than `leastRoom`, metres. None of configurations that cannot be split.
std::set<CellId> splitsFor(const LayoutSpec& pattern, const NearGround& ground, double leastRoom);

/// The most of the ground, in the order of its ways, that a layout of this pattern has no more cameras for.
/// Nothing if the least has more.
std::optional<Outline> largestOutline(const LayoutSpec& pattern, const NearGround& ground,
                                      std::size_t mostCameras);

}  // namespace acentric
