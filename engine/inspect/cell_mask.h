#pragma once
/// A mask of square cells, and the closed loops around its true cells.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace acentric {

struct CellMask {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> cells;  ///< row after row, 0 or 1

  CellMask() = default;
  CellMask(int columnCount, int rowCount)
      : columns(columnCount), rows(rowCount), cells(std::size_t(columnCount) * std::size_t(rowCount), 0) {}
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(columns) + std::size_t(x); }
  bool at(int x, int y) const {
    return x >= 0 && y >= 0 && x < columns && y < rows && cells[index(x, y)] != 0;
  }
  std::size_t count() const;
};

/// Where a cell is joined to its right and its upper neighbour.
struct CellLinks {
  std::vector<std::uint8_t> right, up;  ///< as CellMask::cells
};

/// The largest part connected by links (4 neighbours).
CellMask largestPart(const CellMask& mask, const CellLinks& links);

/// Takes cells off until no two touch by a corner alone: the loops around the rest then never touch
/// themselves.
void removeCornerContacts(CellMask& mask);

/// Loops around the true cells, in cell units (cell (x, y) covers [x, x+1) x [y, y+1)), true cells on the
/// left: outer loops counter-clockwise, holes clockwise. Only corners where the direction turns.
std::vector<std::vector<glm::ivec2>> traceLoops(const CellMask& mask);

}  // namespace acentric
