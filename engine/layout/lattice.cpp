#include "engine/layout/lattice.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

glm::dvec2 inEdges(const LatticeTable& table, std::int64_t i, std::int64_t j, int corner) {
  return double(i) * table.stepI + double(j) * table.stepJ + table.cornerOffsets[std::size_t(corner)];
}

/// Lattice coordinates of a place given in edge lengths.
glm::dvec2 coordinates(const LatticeTable& table, const glm::dvec2& place) {
  const double determinant = cross(table.stepI, table.stepJ);
  return {cross(place, table.stepJ) / determinant, cross(table.stepI, place) / determinant};
}

}  // namespace

std::optional<Lattice> Lattice::of(const LayoutSpec& spec) {
  const LatticeTable* table = latticeTable(spec.configuration);
  if (table == nullptr) return std::nullopt;
  return Lattice(*table, spec);
}

Lattice::Lattice(const LatticeTable& table, const LayoutSpec& spec)
    : table_(&table),
      cellSize_(spec.cellSize),
      origin_(spec.latticeOrigin),
      rotation_(spec.rotationRadians),
      alongX_(spec.cellSize * directionOf(spec.rotationRadians)) {
  for (int slot = 0; slot < slots(); ++slot) {
    const auto& corners = table.regions[std::size_t(slot)].corners;
    Extent extent{glm::dvec2(0), 0};
    for (const CornerRef& ref : corners)
      extent.centre += inEdges(table, ref.di, ref.dj, ref.corner) / double(corners.size());
    for (const CornerRef& ref : corners) {
      const glm::dvec2 at = inEdges(table, ref.di, ref.dj, ref.corner);
      extent.radius = std::max(extent.radius, glm::distance(at, extent.centre));
      reachLow_ = glm::min(reachLow_, coordinates(table, at));
      reachHigh_ = glm::max(reachHigh_, coordinates(table, at));
    }
    extents_.push_back(extent);
    covers_.push_back(coverTemplates(table, slot));
    for (const CoverTemplate& cover : covers_.back())
      for (const PieceTemplate& piece : cover.pieces) {
        const CornerRef& ref = corners[std::size_t(piece.apex)];
        served_.push_back({ref.corner, piece.direction, {-ref.di, -ref.dj, slot}});
      }
  }
}

double Lattice::meanRegionArea() const { return table_->cellArea * cellSize_ * cellSize_ / slots(); }

glm::dvec2 Lattice::place(const glm::dvec2& p) const {
  return origin_ + glm::dvec2(alongX_.x * p.x - alongX_.y * p.y, alongX_.y * p.x + alongX_.x * p.y);
}

glm::dvec2 Lattice::cornerPosition(std::int64_t i, std::int64_t j, int corner) const {
  return place(inEdges(*table_, i, j, corner));
}

ConvexPolygon Lattice::polygonOf(const CellId& id) const {
  ConvexPolygon polygon;
  if (id.slot < 0 || id.slot >= slots()) return polygon;
  const auto& corners = table_->regions[std::size_t(id.slot)].corners;
  polygon.corners.reserve(corners.size());
  for (const CornerRef& ref : corners)
    polygon.corners.push_back(
        cornerPosition(std::int64_t(id.i) + ref.di, std::int64_t(id.j) + ref.dj, ref.corner));
  return polygon;
}

CameraId Lattice::cameraOf(const CellId& id, const PieceTemplate& piece) const {
  const CornerRef& ref = table_->regions[std::size_t(id.slot)].corners[std::size_t(piece.apex)];
  return {id.i + ref.di, id.j + ref.dj, ref.corner, piece.direction};
}

BorderLine Lattice::lineOf(const ConvexPolygon& polygon, const BorderTemplate& border) const {
  const glm::dvec2& from = polygon.corners[std::size_t(border.from)];
  if (border.to >= 0) return {from, polygon.corners[std::size_t(border.to)]};
  return {from, from + cellSize_ * directionOf(azimuthOf(border.direction))};
}

std::vector<CellId> Lattice::servedBy(const CameraId& camera) const {
  std::vector<CellId> cells;
  for (const Served& entry : served_)
    if (entry.corner == camera.corner && entry.direction == camera.direction)
      cells.push_back({camera.i + entry.region.di, camera.j + entry.region.dj, entry.region.slot});
  std::ranges::sort(cells);
  const auto repeats = std::ranges::unique(cells);
  cells.erase(repeats.begin(), repeats.end());
  return cells;
}

glm::dvec2 Lattice::cellCoordinates(const glm::dvec2& point) const {
  const glm::dvec2 offset = (point - origin_) / (cellSize_ * cellSize_);
  return coordinates(*table_, {glm::dot(alongX_, offset), cross(alongX_, offset)});
}

CellId Lattice::cellAt(const glm::dvec2& point) const {
  const glm::dvec2 at = cellCoordinates(point);
  const auto index = [](double value) {
    const double limit = kMaxCellIndex - 2;
    return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, -limit, limit))) : 0;
  };
  const CellId middle{index(at.x), index(at.y), 0};
  // The nearest region answers only where rounding leaves a point, extremely far out, in none.
  CellId nearest = middle;
  double nearestDistance = std::numeric_limits<double>::infinity();
  for (int di = -1; di <= 1; ++di)
    for (int dj = -1; dj <= 1; ++dj)
      for (int slot = 0; slot < slots(); ++slot) {
        const CellId id{middle.i + di, middle.j + dj, slot};
        const Extent& extent = extents_[std::size_t(slot)];
        const double distance = glm::distance(
            point, place(double(id.i) * table_->stepI + double(id.j) * table_->stepJ + extent.centre));
        if (distance < nearestDistance) nearestDistance = distance, nearest = id;
        if (distance <= extent.radius * cellSize_ * 1.001 && polygonOf(id).contains(point)) return id;
      }
  return nearest;
}

ConvexPolygon Lattice::hullOf(std::int64_t iLow, std::int64_t jLow, std::int64_t iHigh,
                              std::int64_t jHigh) const {
  const double margin = 1e-6;  // of a cell: rounding of far positions
  const double i0 = double(iLow) + reachLow_.x - margin, i1 = double(iHigh) + reachHigh_.x + margin;
  const double j0 = double(jLow) + reachLow_.y - margin, j1 = double(jHigh) + reachHigh_.y + margin;
  const auto at = [&](double i, double j) { return place(i * table_->stepI + j * table_->stepJ); };
  return {{at(i0, j0), at(i1, j0), at(i1, j1), at(i0, j1)}};
}

}  // namespace acentric
