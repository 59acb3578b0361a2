#pragma once
/// Of ground that is too large for a layout, the part that is walked first: which cells of a grid are floor,
/// how far what stands about is from each, and how far they are from where the walk begins. Open ground
/// counts as farther than it is, so that a layout of limited size follows streets and facades and leaves
/// fields out, and every part of it is reached on foot from the beginning.

#include <optional>
#include <vector>

#include "engine/inspect/cell_mask.h"
#include "engine/inspect/walkable_outline.h"

namespace acentric {

struct NearGroundOptions {
  WalkableOptions walkable;  ///< its floorHeight is the walk plane's; its gridStep is not used
  /// Plan, metres: where to begin; none: in the middle of a street or a room, where most floor is enclosed.
  std::optional<glm::dvec2> around;
  double window = 600;  ///< metres: side of the square around it that is looked at closely
  double step = 2;      ///< metres between the places looked at in it, at least

  Status check() const;
};

// What a metre of way counts by what stands about: 1 in streets, more in the open and in gaps that one hardly
// fits through.
inline constexpr double kStreetClearance = 10;  ///< metres: in the middle of a street 20 m wide
inline constexpr double kGapClearance = 2;      ///< metres
/// Nothing farther away counts: see StandingRules::farthestWall.
inline constexpr double kOpenClearance = 100;
/// From kStreetClearance on in proportion to it; below kGapClearance up to three times as much.
double wayCost(double clearance);

struct NearGround {
  ProbeGrid grid;
  CellMask floor;   ///< connected
  CellLinks links;  ///< which of its cells are a step apart
  std::vector<float>
      clearance;             ///< by cell of the floor: metres to what stands about, at most kOpenClearance
  std::vector<float> wayTo;  ///< by cell: metres from `start`, open ground counted as farther; infinite: none
  int start = -1;            ///< a cell of the floor
  glm::dvec2 startPlace() const;
};

/// Where most floor is enclosed, of a survey of all the ground: the middle of the square of about 150 m that
/// has most. Nothing where no surface is near anywhere, or where the places are too far apart to know.
std::optional<glm::dvec2> mostEnclosedPlace(const Standing& standing);

/// notFound where there is no floor near the beginning, and where nothing stands about it that would say
/// where to begin.
Result<NearGround> surveyNearGround(const Bounds& bounds, const NearGroundOptions& options,
                                    const SurfaceProbe& probe);

/// Shortest ways along the links, and across corners where both ways around them are linked.
std::vector<float> waysFrom(int start, const ProbeGrid& grid, const CellMask& floor, const CellLinks& links,
                            const std::vector<float>& clearance);
/// What is `felt` about a cell bounds the clearance of the others by their distance from it along rows,
/// columns and diagonals: least over all cells of felt + that.
void spreadClearance(std::vector<float>& felt, const ProbeGrid& grid);

/// Of the floor within `reach` metres of a place, the cell to begin at: the roomiest middle of a street or a
/// room, where clearance is least to no side and no more than kStreetClearance, the nearest of these. Where
/// there is none, the cell of the floor nearest to the place; -1 without any floor.
int startNear(const NearGround& ground, const glm::dvec2& place, double reach);

/// The middle clearance of the floor nearest to the start, so many square metres of it.
double middleClearance(const NearGround& ground, double squareMetres);
/// The floor whose way is at most so long, without cells that touch at corners only: the largest part of it
/// that holds together.
CellMask partWithin(const NearGround& ground, double way);

}  // namespace acentric
