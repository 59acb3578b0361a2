#pragma once
/// The tessellation made explicit: regions, capture cameras, and each region's covers (apv.md sections 1, 3).
/// Pure geometry; no scene needed. Cameras are identified by integers (lattice corner, direction index), so
/// that corners computed from different polygons are the same camera.

#include <array>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/geometry/conventions.h"
#include "engine/geometry/convex_polygon.h"
#include "engine/layout/layout_spec.h"

namespace acentric {

enum class RegionKind : std::uint8_t { ring, gapTriangle, gapSquare, gapHexagon };

/// Integer identity of a capture camera: a lattice corner and its low border's direction in 15-degree steps
/// relative to the lattice. A corner has the lowest level at which it is one, so that regions of different
/// sizes share its cameras. For camera k of free APV n: {n, 0, kFreeCorner, k}.
struct CameraId {
  int i = 0, j = 0, corner = 0;  ///< corner numbers the distinct corners of a lattice cell
  int direction = 0;             ///< 0..23
  int level = 0;                 ///< of the lattice of 2^level times smaller cells
  auto operator<=>(const CameraId&) const = default;
};
inline constexpr int kFreeCorner = -1;

/// A border of a sector as the line through two points, directed away from the sector's apex. Neighbouring
/// pieces share the very same points, so that an exact predicate puts each point on one side for both of
/// them.
struct BorderLine {
  glm::dvec2 from{0}, to{0};  ///< plan, metres
  glm::dvec2 direction() const { return to - from; }
  bool operator==(const BorderLine&) const = default;
};

/// One side of a line: with `left`, points left of it and on it; else those right of it.
struct HalfPlane {
  BorderLine line;
  bool left = true;
  bool holds(const glm::dvec2& point) const;  ///< exact
  bool operator==(const HalfPlane&) const = default;
};

/// Where the sectors of a gap's cameras overlap, the part that is one piece's.
struct Clip {
  HalfPlane side;
  /// The neighbour's claim: `side` decides only between points that it holds too. Three lines that meet in
  /// one point never quite do after rounding; this way nothing is lost between them.
  std::optional<HalfPlane> claim = std::nullopt;
  bool holds(const glm::dvec2& point) const { return (claim && !claim->holds(point)) || side.holds(point); }
  bool operator==(const Clip&) const = default;
};

/// One of the things that a camera is for: a lattice region, placed or not (so that placing a neighbour makes
/// no capture stale; splitting it does), and the part of the camera's sector that the region draws from it.
struct Role {
  CellId region;
  ConvexPolygon polygon;  ///< where the eye stands, plan
  ConvexPolygon grown;    ///< by the near band: nothing in it is drawn from captures
  std::optional<Clip> clip = std::nullopt;
};

/// A capture camera: at most 60 degrees; wider lattice cameras are several of these at one corner.
struct LayoutCamera {
  CameraId id;
  glm::dvec2 position{0};  ///< plan, metres
  double lowAzimuth = 0;   ///< sector [low, low + fov), half-open
  double fovRadians = 0;
  std::vector<Role> roles;  ///< of one region next to each other
  double density = 1;       ///< samples per degree, times the project's
};

/// A sample says by one bit a role which ones need it. A camera with more roles than bits shares them out.
inline constexpr int kRoleBits = 8;
/// The bit of one role; all of them for -1, what draws whatever the camera has.
std::uint8_t roleBit(const LayoutCamera& camera, int role);

/// Nothing nearer to the camera than this is captured, horizontal metres: so that inverse distances stay
/// finite and a wall through the centre of projection leaves no rounding noise; a share of the regions' size,
/// whatever their unit.
double nearestSample(const LayoutCamera& camera);
/// Where the camera's rays of a direction (plan, unit) begin for a role, horizontal metres: as they leave its
/// grown polygon.
double exitDistance(const LayoutCamera& camera, const Role& role, const glm::dvec2& direction);

/// A surface that crosses the border of a grown polygon is captured up to one sample within it: else what
/// lies between the border and the first sample beyond it would be neither's. So much of the border's
/// distance is as far as such samples may lie within.
inline constexpr double kBorderOverlap = 0.05;

/// One piece of a cover: what of the camera's sector lies outside the region, within `clip`.
struct Piece {
  int camera = 0;        ///< into Layout::cameras
  glm::dvec2 apex{0};    ///< the camera's position
  BorderLine low, high;  ///< of the camera's sector; half-open: points on `low` belong to it
  /// Gap squares and hexagons. `side` holds the sector's beginning at the apex, so a ray from the apex leaves
  /// the piece once, or never.
  std::optional<Clip> clip = std::nullopt;
  int role = -1;  ///< of the camera's; -1: a panorama that helps out, drawn whole

  /// Does the piece's sector hold the point? (exact; only meaningful outside the region)
  bool holds(const glm::dvec2& point) const;
};

/// Pieces that tile the outside of a region exactly once, as seen from any eye in it.
/// A ring's pieces are in ring order (counter-clockwise by centre of projection).
struct Cover {
  Hand hand = Hand::counterClockwise;  ///< of gap squares and hexagons: their strips are seen from the corner
                                       ///< at the right (counter-clockwise) or left; gap triangles: unused
  std::vector<Piece> pieces;
  /// Gap regions: pieces [0, wedges) are corner wedges, the rest edge strips (wedges are farther).
  int wedges = 0;
};

struct Region {
  CellId id;
  RegionKind kind = RegionKind::ring;
  ConvexPolygon polygon;  ///< counter-clockwise
  ConvexPolygon grown;    ///< by the near band
  /// Rings, gap squares and hexagons: [counterClockwise, clockwise]; gap triangles and free APVs: [0].
  std::vector<Cover> covers;
};

class RegionIndex;

struct Layout {
  LayoutSpec spec;
  std::vector<Region> regions;
  std::vector<LayoutCamera> cameras;         ///< those that some placed region needs, sorted by id
  std::shared_ptr<const RegionIndex> index;  ///< made by buildLayout: which region holds a point
  /// By region, what panoramasFor answers where there is no index: in layouts that come from bundles.
  std::vector<std::vector<Cover>> panoramas;

  double eyeZ() const { return spec.floorHeight + spec.eyeHeight; }
  /// Region that holds a point (exactly one on shared borders; of overlapping free APVs the one with the
  /// lowest number); nothing outside all. Without an index the first one whose closed polygon holds it.
  std::optional<int> regionAt(const glm::dvec2& point) const;
  /// Nearest placed region and the nearest point in it.
  struct Nearest {
    int region = -1;
    glm::dvec2 point{0};
  };
  Nearest nearestRegion(const glm::dvec2& point) const;
  std::optional<int> findRegion(const CellId& id) const;
  std::optional<int> findCamera(const CameraId& id) const;
  /// Traditional panoramas that can fill what a region's own cover leaves open: at its corners where the
  /// cameras look all round (c, e, g), and free ones that serve it. Nearest first is not implied.
  std::vector<Cover> panoramasFor(int region) const;
};

Result<Layout> buildLayout(const LayoutSpec& spec);

/// How far from a free panorama a region may lie that it helps, metres.
inline double panoramaReach(const LayoutSpec& spec) { return spec.cellSize; }

/// Address and outline of the lattice region that holds a point, placed or not (for adding, dragging and
/// splitting cells); of split regions, the smallest.
struct LatticeCell {
  CellId id;
  RegionKind kind;
  ConvexPolygon polygon;
};
LatticeCell cellAt(const LayoutSpec& spec, const glm::dvec2& point);
ConvexPolygon cellPolygon(const LayoutSpec& spec, const CellId& id);
/// Of a region, placed or not, as LayoutSpec::density gives it; 1 where it says nothing.
double densityOf(const LayoutSpec& spec, const CellId& id);
/// Does buildLayout(spec) place this cell, or have this free APV?
bool isPlaced(const LayoutSpec& spec, const CellId& id);
/// The four regions of half the size that tile a region; only of configurations that can be split.
std::array<CellId, 4> partsOf(const LayoutSpec& spec, const CellId& id);
/// The region that a region of level 1 or more is a part of.
CellId wholeOf(const LayoutSpec& spec, const CellId& id);
/// Lattice regions whose polygon overlaps a box, placed or not (for drawing the lattice), at most `limit`.
std::vector<LatticeCell> cellsIn(const LayoutSpec& spec, const glm::dvec2& min, const glm::dvec2& max,
                                 int limit);

}  // namespace acentric
