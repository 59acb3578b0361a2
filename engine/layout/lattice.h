#pragma once
/// A configuration's lattice laid into the plan by a spec: integer addresses to positions and back. A
/// corner's position is a function of its integers alone, so every region that has the corner computes the
/// same bits.

#include <optional>
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
  /// Nothing where the configuration cannot be laid out. The spec's numbers have been checked.
  static std::optional<Lattice> of(const LayoutSpec& spec);

  int slots() const { return static_cast<int>(table_->regions.size()); }
  RegionKind kindOf(int slot) const { return table_->regions[std::size_t(slot)].kind; }
  double meanRegionArea() const;  ///< square metres
  const std::vector<CoverTemplate>& coversOf(int slot) const { return covers_[std::size_t(slot)]; }

  glm::dvec2 cornerPosition(std::int64_t i, std::int64_t j, int corner) const;
  ConvexPolygon polygonOf(const CellId& id) const;
  /// Identity and place of a cover's camera for a region.
  CameraId cameraOf(const CellId& id, const PieceTemplate& piece) const;
  double azimuthOf(int direction) const { return wrapAngle(rotation_ + radians(15.0 * direction)); }
  double cameraFov() const { return radians(15.0 * table_->cameraSteps); }
  BorderLine lineOf(const ConvexPolygon& polygon, const BorderTemplate& border) const;

  /// Addresses, in order, of the lattice regions (placed or not) that a camera serves.
  std::vector<CellId> servedBy(const CameraId& camera) const;

  /// The region that holds a point (by the half-open rule).
  CellId cellAt(const glm::dvec2& point) const;
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

  const LatticeTable* table_;
  double cellSize_;
  glm::dvec2 origin_;
  double rotation_;
  glm::dvec2 alongX_;  ///< where the lattice's x axis points, times the edge length
  std::vector<std::vector<CoverTemplate>> covers_;
  std::vector<Served> served_;
  std::vector<Extent> extents_;
  glm::dvec2 reachLow_{0}, reachHigh_{0};  ///< of a cell's regions, in lattice coordinates
};

}  // namespace acentric
