#pragma once
/// Cells of a new project, and how many cameras it has at most.

#include <optional>
#include <set>
#include <stop_token>
#include <utility>

#include "engine/inspect/near_ground.h"
#include "engine/layout/layout.h"

namespace acentric {

/// firstCellSize gives larger ones only where the walkable area is vast.
inline constexpr double kLargestUsualCell = 6.0;  ///< metres

// Where not all ground is laid out, a ring's room (the radius of the circle within it) is the middle distance
// to what stands about, on the ground where the walk begins. Where rings can be split, others have twice
// that.
inline constexpr double kLeastRoom = 1.5, kMostRoom = 3;  ///< metres
inline constexpr double kGroundToMeasure = 10'000;        ///< square metres
/// Split where the mean distance to what stands about is less than so many times a region's room. In a street
/// three times as wide as the region it would be as much.
inline constexpr double kRoomToSplit = 1.5;
/// Regions with less floor than this share of their area are left out: their cameras stand in houses.
inline constexpr double kLeastFloor = 0.2;

struct FirstLayoutLimit {
  std::size_t cameras = 0;  ///< 0 = none
  std::optional<glm::dvec2>
      around;                       ///< plan: where the part begins that is laid out; none: see near_ground.h
  bool chooseCell = true;           ///< else the spec's own size is kept
  bool chooseConfiguration = true;  ///< likewise; with chooseCell alone
};

/// Lowest and highest corner of the box around an outline.
std::pair<glm::dvec2, glm::dvec2> extentOf(const Outline& outline);

/// Has buildLayout(spec) more cameras than the limit?
bool exceeds(const LayoutSpec& spec, const FirstLayoutLimit& limit);

/// A spec for as much of the spec's outline as the limit lets, for one that exceeds it. Where something
/// stands about: the ground that is walked first, its cells as large as suits the distance to what stands
/// about, the lattice shifted to where its cameras stand freest; of configuration e if it may be chosen.
/// Where nothing does: all of it with larger cells, if they may be chosen, else what is around its middle.
Result<LayoutSpec> keepWithin(const LayoutSpec& spec, const FirstLayoutLimit& limit, const Bounds& bounds,
                              bool ignoredSides, const SurfaceProbe& probe, std::stop_token stop = {});

/// Regions of the pattern's cell size, and their parts, that are to be split (see kRoomToSplit; none of
/// configurations that cannot be), and those to be left out (kLeastFloor). No parts are made with less room
/// than `leastRoom`, metres.
struct CellChoice {
  std::set<CellId> split, removed;
};
CellChoice chooseCells(const LayoutSpec& pattern, const NearGround& ground, double leastRoom);

/// The most of the ground, in the order of its ways, that a layout of this pattern has no more cameras for.
/// Nothing if the least has more.
std::optional<Outline> largestOutline(const LayoutSpec& pattern, const NearGround& ground,
                                      std::size_t mostCameras);

}  // namespace acentric
