#pragma once
/// A configuration's lattice laid into the plan by a spec: integer addresses to positions and back. A
/// corner's position is a function of its integers alone, so every region that has the corner, of whatever
/// size, computes the same bits.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/layout/cover_template.h"
#include "engine/layout/lattice_table.h"

namespace acentric {

/// A region by its place relative to a cell.
struct RegionRef {
  int di = 0, dj = 0, slot = 0;
};

/// Addresses stay where integers and metres are both exact enough.
inline constexpr int kMaxCellIndex = 1'000'000'000;

class Lattice {
 public:
  /// Nothing for a configuration that does not exist. The spec's numbers have been checked.
  static std::optional<Lattice> of(const LayoutSpec& spec);

  int slots() const { return static_cast<int>(table_->regions.size()); }
  RegionKind kindOf(int slot) const { return table_->regions[std::size_t(slot)].kind; }
  double meanRegionArea() const;  ///< square metres, of regions that are not split
  const std::vector<CoverTemplate>& coversOf(int slot) const { return covers_[std::size_t(slot)]; }

  glm::dvec2 cornerPosition(std::int64_t i, std::int64_t j, int corner, int level) const;
  ConvexPolygon polygonOf(const CellId& id) const;
  /// Identity of a cover's camera for a region.
  CameraId cameraOf(const CellId& id, const PieceTemplate& piece) const;
  double azimuthOf(int direction) const { return wrapAngle(rotation_ + radians(15.0 * direction)); }
  double cameraFov() const { return radians(15.0 * table_->cameraSteps); }
  /// Does a camera of this direction stand at each corner?
  bool panoramas() const { return panoramas_; }
  int cameraSteps() const { return table_->cameraSteps; }
  BorderLine lineOf(const ConvexPolygon& polygon, const BorderTemplate& border) const;

  /// Addresses, in order, of the lattice regions (placed or not) that a camera serves.
  std::vector<CellId> servedBy(const CameraId& camera, const std::set<CellId>& split) const;
  /// The four regions of half the size that tile a region.
  std::array<CellId, 4> childrenOf(const CellId& id) const;
  /// The region that a region of level 1 or more came from.
  CellId parentOf(const CellId& id) const;

  /// The region of the first level that holds a point (by the half-open rule).
  CellId cellAt(const glm::dvec2& point) const;
  /// The smallest region that holds a point.
  CellId leafAt(const glm::dvec2& point, const std::set<CellId>& split) const;
  /// Exactly as polygonOf(id).contains(point).
  bool holds(const CellId& id, const glm::dvec2& point) const;
  /// Lattice coordinates: the cell (i, j)'s origin is at (i, j).
  glm::dvec2 cellCoordinates(const glm::dvec2& point) const;
  /// A quadrilateral that holds all the regions of the cells [iLow, iHigh] x [jLow, jHigh].
  ConvexPolygon hullOf(std::int64_t iLow, std::int64_t jLow, std::int64_t iHigh, std::int64_t jHigh) const;

 private:
  struct Served {
    int corner, direction;
    RegionRef region;
  };
  struct Extent {
    glm::dvec2 centre;  ///< of the region, from the cell's origin, edge lengths
    double radius;      ///< to its corners, edge lengths
  };

  Lattice(const LatticeTable& table, const LayoutSpec& spec);
  glm::dvec2 place(const glm::dvec2& inEdges) const;
  std::span<const glm::dvec2> cornersOf(const CellId& id, std::array<glm::dvec2, 8>& room) const;
  std::vector<CellId> servedOfLevel(const CameraId& camera) const;
  void addServed(const CameraId& camera, const CellId& within, const std::set<CellId>& split,
                 std::vector<CellId>& cells) const;

  const LatticeTable* table_;
  double cellSize_;
  glm::dvec2 origin_;
  double rotation_;
  glm::dvec2 alongX_;  ///< where the lattice's x axis points, times the edge length
  std::vector<std::vector<CoverTemplate>> covers_;
  std::vector<Served> served_;
  std::vector<Extent> extents_;
  bool panoramas_ = false;
  glm::dvec2 reachLow_{0}, reachHigh_{0};  ///< of a cell's regions, in lattice coordinates
};

}  // namespace acentric
