#include "engine/layout/lattice.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace acentric {
namespace {

glm::dvec2 inEdges(const LatticeTable& table, std::int64_t i, std::int64_t j, int corner, int level) {
  const double scale = std::ldexp(1.0, -level);  // exact, so a corner is the same place at every level
  return double(i) * scale * table.stepI + double(j) * scale * table.stepJ +
         table.cornerOffsets[std::size_t(corner)];
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
      extent.centre += inEdges(table, ref.di, ref.dj, ref.corner, 0) / double(corners.size());
    for (const CornerRef& ref : corners) {
      const glm::dvec2 at = inEdges(table, ref.di, ref.dj, ref.corner, 0);
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
  std::set<std::pair<int, int>> cameras;
  for (const Served& entry : served_) cameras.emplace(entry.corner, entry.direction);
  panoramas_ = cameras.size() * std::size_t(table.cameraSteps) == 24 * table.cornerOffsets.size();
}

double Lattice::meanRegionArea() const { return table_->cellArea * cellSize_ * cellSize_ / slots(); }

glm::dvec2 Lattice::place(const glm::dvec2& p) const {
  return origin_ + glm::dvec2(alongX_.x * p.x - alongX_.y * p.y, alongX_.y * p.x + alongX_.x * p.y);
}

glm::dvec2 Lattice::cornerPosition(std::int64_t i, std::int64_t j, int corner, int level) const {
  return place(inEdges(*table_, i, j, corner, level));
}

std::span<const glm::dvec2> Lattice::cornersOf(const CellId& id, std::array<glm::dvec2, 8>& room) const {
  const auto& corners = table_->regions[std::size_t(id.slot)].corners;
  for (std::size_t k = 0; k < corners.size(); ++k)
    room[k] = cornerPosition(std::int64_t(id.i) + corners[k].di, std::int64_t(id.j) + corners[k].dj,
                             corners[k].corner, id.level);
  return std::span(room).first(corners.size());
}

ConvexPolygon Lattice::polygonOf(const CellId& id) const {
  ConvexPolygon polygon;
  if (id.slot < 0 || id.slot >= slots()) return polygon;
  std::array<glm::dvec2, 8> room;
  const auto corners = cornersOf(id, room);
  polygon.corners.assign(corners.begin(), corners.end());
  return polygon;
}

bool Lattice::holds(const CellId& id, const glm::dvec2& point) const {
  std::array<glm::dvec2, 8> room;
  return containsHalfOpen(cornersOf(id, room), point);
}

CameraId Lattice::cameraOf(const CellId& id, const PieceTemplate& piece) const {
  const CornerRef& ref = table_->regions[std::size_t(id.slot)].corners[std::size_t(piece.apex)];
  CameraId camera{id.i + ref.di, id.j + ref.dj, ref.corner, piece.direction, id.level};
  for (; camera.level > 0 && camera.i % 2 == 0 && camera.j % 2 == 0; --camera.level)
    camera.i /= 2, camera.j /= 2;
  return camera;
}

BorderLine Lattice::lineOf(const ConvexPolygon& polygon, const BorderTemplate& border) const {
  const auto corner = [&](int k) { return polygon.corners[std::size_t(k) % polygon.size()]; };
  switch (border.through) {
    case BorderTemplate::Through::corners:
      return {corner(border.from), corner(border.to)};
    case BorderTemplate::Through::middles:
      return {0.5 * (corner(border.from) + corner(border.from + 1)),
              0.5 * (corner(border.to) + corner(border.to + 1))};
    case BorderTemplate::Through::direction:
      break;
  }
  const glm::dvec2 from = corner(border.from);
  return {from, from + glm::distance(corner(0), corner(1)) * directionOf(azimuthOf(border.to))};
}

CellId Lattice::parentOf(const CellId& id) const {
  CellId parent{id.i >> 1, id.j >> 1, id.slot, id.level - 1};
  if (slots() == 1) return parent;
  // The middle part of a triangle stands the other way round (childrenOf).
  const bool oddI = (id.i & 1) != 0, oddJ = (id.j & 1) != 0;
  if (id.slot == 0 && oddI && oddJ) parent.slot = 1;
  if (id.slot == 1 && !oddI && !oddJ) parent.slot = 0;
  return parent;
}

std::array<CellId, 4> Lattice::childrenOf(const CellId& id) const {
  const auto child = [&](int di, int dj, int slot) {
    return CellId{2 * id.i + di, 2 * id.j + dj, slot, id.level + 1};
  };
  if (slots() == 1) return {child(0, 0, 0), child(1, 0, 0), child(0, 1, 0), child(1, 1, 0)};
  if (id.slot == 0) return {child(0, 0, 0), child(1, 0, 0), child(0, 1, 0), child(0, 0, 1)};
  return {child(1, 0, 1), child(1, 1, 1), child(0, 1, 1), child(1, 1, 0)};
}

std::vector<CellId> Lattice::servedOfLevel(const CameraId& camera) const {
  std::vector<CellId> cells;
  for (const Served& entry : served_)
    if (entry.corner == camera.corner && entry.direction == camera.direction)
      cells.push_back(
          {camera.i + entry.region.di, camera.j + entry.region.dj, entry.region.slot, camera.level});
  std::ranges::sort(cells);
  const auto repeats = std::ranges::unique(cells);
  cells.erase(repeats.begin(), repeats.end());
  return cells;
}

void Lattice::addServed(const CameraId& camera, const CellId& within, const std::set<CellId>& split,
                        std::vector<CellId>& cells) const {
  if (!split.contains(within)) {
    cells.push_back(within);
    return;
  }
  // Of the smaller regions at the same corner, those that this one gave way to.
  const CameraId finer{2 * camera.i, 2 * camera.j, camera.corner, camera.direction, camera.level + 1};
  const auto children = childrenOf(within);
  for (const CellId& cell : servedOfLevel(finer))
    if (std::ranges::find(children, cell) != children.end()) addServed(finer, cell, split, cells);
}

std::vector<CellId> Lattice::servedBy(const CameraId& camera, const std::set<CellId>& split) const {
  std::vector<CellId> cells = servedOfLevel(camera);
  if (split.empty()) return cells;
  std::vector<CellId> leaves;
  for (const CellId& cell : cells)
    if (cell.level == 0 || split.contains(parentOf(cell))) addServed(camera, cell, split, leaves);
  std::ranges::sort(leaves);
  return leaves;
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
        if (distance <= extent.radius * cellSize_ * 1.001 && holds(id, point)) return id;
      }
  return nearest;
}

CellId Lattice::leafAt(const glm::dvec2& point, const std::set<CellId>& split) const {
  CellId cell = cellAt(point);
  while (split.contains(cell)) {
    const auto children = childrenOf(cell);
    auto child = std::ranges::find_if(children, [&](const CellId& id) { return holds(id, point); });
    // Rounding of the middle corners may leave a point of the whole in no part of it: the nearest takes it.
    if (child == children.end())
      child = std::ranges::min_element(children, {}, [&](const CellId& id) {
        return glm::distance(polygonOf(id).nearestPoint(point), point);
      });
    cell = *child;
  }
  return cell;
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
