#pragma once
/// Cells of a new project, and how many cameras it has at most.

#include <functional>
#include <optional>
#include <set>
#include <stop_token>
#include <utility>

#include "engine/inspect/lattice_fit.h"
#include "engine/inspect/near_ground.h"
#include "engine/layout/layout.h"

namespace acentric {

/// firstCellSize gives larger ones only where the walkable area is vast.
inline constexpr double kLargestUsualCell = 6.0;  ///< metres

// Where not all ground is laid out, a ring's room (the radius of the circle within it) is the middle distance
// to what stands about, on the ground where the walk begins. Where rings can be split, it is up to kWidest
// times as much, so that a ring may be as wide as a street, if cameras serve more floor then; twice or four
// times that in the open, and half as much where a corner or the middle of a larger one would stand in a
// house.
inline constexpr double kLeastRoom = 1.5, kMostRoom = 3;  ///< metres
inline constexpr double kWidest = 1.6;
inline constexpr double kLargestOverUsual = 4, kLeastOverUsual = 0.5;
inline constexpr double kGroundToMeasure = 10'000;  ///< square metres
/// Split where the mean distance to what stands about is less than so many times a region's room. In a street
/// three times as wide as the region it would be as much.
inline constexpr double kRoomToSplit = 1.5;
/// That a camera needs about it, metres: a nearer surface hides all else.
inline constexpr double kCameraRoom = 0.1;

struct FirstLayoutLimit {
  std::size_t cameras = 0;  ///< 0 = none
  std::optional<glm::dvec2>
      around;                       ///< plan: where the part begins that is laid out; none: see near_ground.h
  bool chooseCell = true;           ///< else the spec's own size is kept
  bool chooseConfiguration = true;  ///< likewise; with chooseCell alone
  /// Where all is laid out, the lattice may be turned and cells with hardly any floor left out
  /// (lattice_fit.h).
  bool fit = true;
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

/// May a centre of projection, or the middle of a region, lie at a place of the plan?
using FreePlace = std::function<bool(const glm::dvec2&)>;
/// Places at eye height that are not inside a house, whichever way its walls are wound: from which some of
/// the floor within `reach` metres is seen, and about which there is room. Remembers what it was asked; for
/// one thread. Refers to the ground and the probe.
FreePlace freePlaces(const NearGround& ground, double eyeZ, double reach, const SurfaceProbe& probe);

/// Regions of the pattern's cell size, and their parts, that are to be split, and those to be left out.
struct CellChoice {
  std::set<CellId> split, removed;
};
struct CellRules {
  double usualRoom = kMostRoom;  ///< metres: parts have no less where they are split for want of room
  double leastRoom = kMostRoom;  ///< metres: likewise where corners and middles would not be free
};
/// Split is what has too little room (kRoomToSplit), or a corner or its middle where none is free; left out
/// is what cannot be split further and has too little floor (kLeastFloor), no free middle, or, of
/// configurations that can be split, a corner that is not free; of others most of them.
/// `within`: only regions that overlap this outline are looked at.
CellChoice chooseCells(const LayoutSpec& pattern, const NearGround& ground, const CellRules& rules,
                       const FreePlace& isFree, const Outline* within = nullptr);
/// The pattern with its cells, moved to where few cameras serve much of the floor of its outline: of places
/// so many `steps` each way over a square of `size` metres.
struct FittedCells {
  LayoutSpec spec;
  double worth = 0;  ///< more for more floor and for fewer cameras; of the same outline
};
FittedCells fitCells(const LayoutSpec& pattern, const NearGround& ground, const CellRules& rules,
                     const FreePlace& isFree, double size, int steps);

/// The same layout with fewer splits and removals: none beyond the outline, none that all cells have in
/// common, which are then smaller, and one removal for a region all of whose parts are left out.
Result<LayoutSpec> withoutIdleChoices(const LayoutSpec& spec);

/// The most of the ground, in the order of its ways, that a layout of this pattern has no more cameras for;
/// without what its regions do not serve. Nothing if the least has more.
std::optional<Outline> largestOutline(const LayoutSpec& pattern, const NearGround& ground,
                                      std::size_t mostCameras);

}  // namespace acentric
