#include "engine/inspect/cell_mask.h"

#include <algorithm>
#include <numeric>

namespace acentric {

std::size_t CellMask::count() const { return std::accumulate(cells.begin(), cells.end(), std::size_t(0)); }

CellMask largestPart(const CellMask& mask, const CellLinks& links) {
  CellMask seen(mask.columns, mask.rows);
  std::vector<glm::ivec2> best, part;
  for (int y0 = 0; y0 < mask.rows; ++y0)
    for (int x0 = 0; x0 < mask.columns; ++x0) {
      if (!mask.at(x0, y0) || seen.at(x0, y0)) continue;
      part.assign(1, {x0, y0});
      seen.cells[seen.index(x0, y0)] = 1;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto [x, y] = std::pair{part[k].x, part[k].y};
        const auto visit = [&](int nx, int ny, std::uint8_t linked) {
          if (linked == 0 || !mask.at(nx, ny) || seen.at(nx, ny)) return;
          seen.cells[seen.index(nx, ny)] = 1;
          part.emplace_back(nx, ny);
        };
        visit(x + 1, y, links.right[mask.index(x, y)]);
        visit(x, y + 1, links.up[mask.index(x, y)]);
        if (x > 0) visit(x - 1, y, links.right[mask.index(x - 1, y)]);
        if (y > 0) visit(x, y - 1, links.up[mask.index(x, y - 1)]);
      }
      if (part.size() > best.size()) best.swap(part);
    }
  CellMask result(mask.columns, mask.rows);
  for (const glm::ivec2& cell : best) result.cells[result.index(cell.x, cell.y)] = 1;
  return result;
}

void removeCornerContacts(CellMask& mask) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y + 1 < mask.rows; ++y)
      for (int x = 0; x + 1 < mask.columns; ++x) {
        const bool a = mask.at(x, y), b = mask.at(x + 1, y), c = mask.at(x, y + 1), d = mask.at(x + 1, y + 1);
        if (a != d || b != c || a == b) continue;
        mask.cells[a ? mask.index(x, y) : mask.index(x + 1, y)] = 0;
        changed = true;
      }
  }
}

std::vector<std::vector<glm::ivec2>> traceLoops(const CellMask& mask) {
  // Walk along the lower edges of cells first: every loop has one. Directions: 0 right, 1 up, 2 left, 3 down.
  static constexpr glm::ivec2 kStep[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  // The cell on the left of a step from a lattice corner, relative to that corner.
  static constexpr glm::ivec2 kLeftCell[] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
  const auto isBorder = [&](const glm::ivec2& corner, int direction) {
    const glm::ivec2 left = corner + kLeftCell[direction], right = corner + kLeftCell[(direction + 3) % 4];
    return mask.at(left.x, left.y) && !mask.at(right.x, right.y);
  };
  std::vector<std::vector<glm::ivec2>> loops;
  std::vector<std::uint8_t> walked(mask.cells.size(), 0);  // lower edge of each cell
  for (int y0 = 0; y0 < mask.rows; ++y0)
    for (int x0 = 0; x0 < mask.columns; ++x0) {
      if (walked[mask.index(x0, y0)] != 0 || !isBorder({x0, y0}, 0)) continue;
      std::vector<glm::ivec2> loop;
      glm::ivec2 corner(x0, y0);
      int direction = 0;
      do {
        if (direction == 0) walked[mask.index(corner.x, corner.y)] = 1;
        corner += kStep[direction];
        // Left first keeps to the same cell where two cells meet at a corner.
        int next = (direction + 1) % 4;
        if (!isBorder(corner, next)) next = direction;
        if (!isBorder(corner, next)) next = (direction + 3) % 4;
        if (next != direction) loop.push_back(corner);
        direction = next;
      } while (corner != glm::ivec2(x0, y0) || direction != 0);
      loops.push_back(std::move(loop));
    }
  return loops;
}

}  // namespace acentric
