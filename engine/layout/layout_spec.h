#pragma once
/// What the designer chooses: a plain value, stored in the project. buildLayout(spec) turns it into geometry.

#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/geometry/outline.h"
#include "engine/layout/apv.h"

namespace acentric {

/// The paper's Fig. 7, apv.md section 3.
enum class Configuration : std::uint8_t { a, b, c, d, e, f, g };
const char* nameOf(Configuration configuration);    ///< "a" ... "g"
const char* describe(Configuration configuration);  ///< "60° cameras, hexagons and triangles (3.6.3.6)"
Result<Configuration> parseConfiguration(std::string_view name);
/// Can single cells be split into four of half the size? (e and g: a full panorama stands at each corner)
bool canSplit(Configuration configuration);

/// Integer address of a region in the lattice. `slot` numbers the regions of one lattice cell (0 = ring).
struct CellId {
  int i = 0, j = 0, slot = 0;
  int level = 0;  ///< of the lattice of 2^level times smaller cells
  auto operator<=>(const CellId&) const = default;
};

/// The region of free APV `number` has the address {number, 0, kFreeSlot}.
inline constexpr int kFreeSlot = -1;
/// Cells are split at most this often.
inline constexpr int kMaxLevel = 6;
inline constexpr int kMaxFreeApvs = 1000;
/// How many times the project's samples per degree a region may have.
inline constexpr double kLeastRegionDensity = 0.25, kMostRegionDensity = 4;
/// Metres; a project may be drawn in any unit.
inline constexpr double kLeastCellSize = 1e-4, kLargestCellSize = 1e5;

/// Ground that rises evenly, as an eye is carried over stairs or a ramp: at a place of the plan its z is the
/// floor's height and dot(rise, place - at).
struct GroundSlope {
  glm::dvec2 at{0};    ///< where it has the floor's height, metres
  glm::dvec2 rise{0};  ///< metres up per metre, 0..kSteepestGround
  bool operator==(const GroundSlope&) const = default;
};
inline constexpr double kSteepestGround = 2;

struct LayoutSpec {
  Configuration configuration = Configuration::b;
  double cellSize = 2.0;        ///< metres, edge length of the regular polygon, within the limits above
  glm::dvec2 latticeOrigin{0};  ///< a ring polygon's centre, metres
  double rotationRadians = 0;
  double floorHeight = 0;  ///< z of the walk plane, metres
  double eyeHeight = 1.6;  ///< metres above the floor: height of every centre of projection
  double nearBand = 1.0;   ///< metres, local geometry beyond the region's border
  /// Of a piece of stairs or of a ramp; its cameras stand at one height nevertheless. None: level ground.
  std::optional<GroundSlope> slope;
  Outline outline;           ///< every region that overlaps it is placed ...
  std::set<CellId> added;    ///< ... and these ...
  std::set<CellId> removed;  ///< ... but not these
  std::set<CellId> split;    ///< regions that give way to four of half the size (which may be split again)
  std::map<int, Apv>
      freeApvs;  ///< beside the lattice, by number; where polygons overlap, these are preferred
  /// Regions whose captures have so many times the project's samples per degree, within the limits above; of
  /// a split one, its parts too, where these are not named themselves. A camera of several regions has the
  /// most of those that are placed.
  std::map<CellId, double> density;

  double groundAt(const glm::dvec2& place) const {  ///< z, metres
    return floorHeight + (slope ? glm::dot(slope->rise, place - slope->at) : 0);
  }
  /// Forgets what names regions of this lattice one by one: they are others in another lattice.
  void forgetCells();
  Status check() const;  ///< finite, within the limits above, no more than kMaxRegions regions
  void addTo(Hasher& hasher) const;
  bool operator==(const LayoutSpec&) const = default;
};

/// Loops of three corners or more, within 1e7 m, no more corners than an outline may have.
Status checkOutline(const Outline& outline);

inline constexpr int kMaxRegions = 250'000;

}  // namespace acentric
