#include "engine/inspect/triangle_grid.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr std::int64_t kMostCellsPerTriangle = 16;
constexpr int kMostCellsPerSide = 1024;

}  // namespace

TriangleGrid::TriangleGrid(const Scene& scene, const PlanBounds& area, double cellSize)
    : scene_(scene), area_(area) {
  const glm::dvec2 size = glm::max(area.max - area.min, glm::dvec2(0));
  cellSize_ = std::max({cellSize, std::max(size.x, size.y) / kMostCellsPerSide, 1e-9});
  columns_ = static_cast<int>(size.x / cellSize_) + 1;
  rows_ = static_cast<int>(size.y / cellSize_) + 1;

  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    for (std::size_t t = 0; t < scene.meshes[m].triangles.size(); ++t) {
      const Triangle triangle{std::uint32_t(m), std::uint32_t(t)};
      if (boundsOf(triangle).touches(area_)) triangles_.push_back(triangle);
    }
  seenIn_.assign(triangles_.size(), 0);

  // Two passes: count, then fill.
  firstOfCell_.assign(std::size_t(columns_) * std::size_t(rows_) + 1, 0);
  const auto forEachCell = [&](std::uint32_t entry, const auto& visit) {
    const CellRange range = cellsOf(boundsOf(triangles_[entry]));
    if (range.cells() > kMostCellsPerTriangle) return false;
    for (int y = range.y0; y <= range.y1; ++y)
      for (int x = range.x0; x <= range.x1; ++x)
        visit(std::size_t(y) * std::size_t(columns_) + std::size_t(x));
    return true;
  };
  for (std::uint32_t entry = 0; entry < triangles_.size(); ++entry)
    if (!forEachCell(entry, [&](std::size_t cell) { ++firstOfCell_[cell + 1]; })) large_.push_back(entry);
  for (std::size_t cell = 1; cell < firstOfCell_.size(); ++cell) firstOfCell_[cell] += firstOfCell_[cell - 1];
  entries_.resize(firstOfCell_.back());
  std::vector<std::uint32_t> next(firstOfCell_.begin(), firstOfCell_.end() - 1);
  for (std::uint32_t entry = 0; entry < triangles_.size(); ++entry)
    forEachCell(entry, [&](std::size_t cell) { entries_[next[cell]++] = entry; });
}

TriangleGrid::CellRange TriangleGrid::cellsOf(const PlanBounds& box) const {
  const auto index = [&](double value, double low, int count) {
    return static_cast<int>(std::clamp((value - low) / cellSize_, 0.0, double(count - 1)));
  };
  return {index(box.min.x, area_.min.x, columns_), index(box.min.y, area_.min.y, rows_),
          index(box.max.x, area_.min.x, columns_), index(box.max.y, area_.min.y, rows_)};
}

PlanBounds TriangleGrid::boundsOf(const Triangle& triangle) const {
  const Mesh& mesh = scene_.meshes[triangle.mesh];
  const glm::uvec3& corners = mesh.triangles[triangle.index];
  PlanBounds bounds;
  for (int k = 0; k < 3; ++k) bounds.add(glm::dvec2(mesh.positions[corners[k]]));
  return bounds;
}

void TriangleGrid::consider(std::uint32_t entry, const PlanBounds& box) {
  if (seenIn_[entry] == query_) return;
  seenIn_[entry] = query_;
  if (boundsOf(triangles_[entry]).touches(box)) found_.push_back(triangles_[entry]);
}

const std::vector<TriangleGrid::Triangle>& TriangleGrid::near(const PlanBounds& box) {
  ++query_;
  found_.clear();
  if (!box.touches(area_)) return found_;
  for (const std::uint32_t entry : large_) consider(entry, box);
  const CellRange range = cellsOf(box);
  for (int y = range.y0; y <= range.y1; ++y)
    for (int x = range.x0; x <= range.x1; ++x) {
      const std::size_t cell = std::size_t(y) * std::size_t(columns_) + std::size_t(x);
      for (std::uint32_t e = firstOfCell_[cell]; e < firstOfCell_[cell + 1]; ++e) consider(entries_[e], box);
    }
  return found_;
}

}  // namespace acentric
