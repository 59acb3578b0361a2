#pragma once
/// Finds the scene's triangles near a place of the plan: a uniform grid over part of the plan, triangles by
/// the cells that their boxes touch. Very large triangles are kept apart, so that memory follows the number
/// of triangles.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

struct PlanBounds {
  glm::dvec2 min{std::numeric_limits<double>::max()}, max{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec2& p) { min = glm::min(min, p), max = glm::max(max, p); }
  bool touches(const PlanBounds& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y;
  }
};

class TriangleGrid {
 public:
  struct Triangle {
    std::uint32_t mesh, index;
  };

  /// Cells of about `cellSize` metres over `area`; triangles that miss the area are left out.
  TriangleGrid(const Scene& scene, const PlanBounds& area, double cellSize);

  /// Triangles whose plan boxes touch `box`, each once. Not thread-safe: marks what was seen.
  const std::vector<Triangle>& near(const PlanBounds& box);

 private:
  struct CellRange {
    int x0, y0, x1, y1;
    std::int64_t cells() const { return std::int64_t(x1 - x0 + 1) * (y1 - y0 + 1); }
  };
  CellRange cellsOf(const PlanBounds& box) const;
  PlanBounds boundsOf(const Triangle& triangle) const;
  void consider(std::uint32_t entry, const PlanBounds& box);

  const Scene& scene_;
  PlanBounds area_;
  double cellSize_;
  int columns_, rows_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> large_;                  ///< entries that touch too many cells
  std::vector<std::uint32_t> firstOfCell_, entries_;  ///< compressed rows: entries of each cell
  std::vector<std::uint32_t> seenIn_;                 ///< number of the query that last met each triangle
  std::uint32_t query_ = 0;
  std::vector<Triangle> found_;
};

}  // namespace acentric
