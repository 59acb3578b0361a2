#include "engine/inspect/rooms.h"

#include <algorithm>
#include <cmath>

#include "engine/inspect/cell_mask.h"

namespace acentric {
namespace {

constexpr int kMostCellsAcross = 512;  ///< along the longer side
constexpr double kFinestCell = 0.05;   ///< metres

/// The area in square cells, with a border of cells outside it.
struct Cells {
  CellMask mask;
  glm::dvec2 origin{0};
  double size = 0;

  explicit Cells(const StandingArea& area) {
    const glm::dvec2 extent = area.high - area.low;
    size = std::max(kFinestCell, std::max(extent.x, extent.y) / kMostCellsAcross);
    mask = CellMask(int(std::ceil(extent.x / size)) + 2, int(std::ceil(extent.y / size)) + 2);
    origin = area.low - size;
    for (int y = 0; y < mask.rows; ++y)
      for (int x = 0; x < mask.columns; ++x) mask.cells[mask.index(x, y)] = area.contains(centre(x, y));
  }
  glm::dvec2 centre(int x, int y) const { return origin + size * (glm::dvec2(x, y) + 0.5); }
};

/// Metres from each cell to the nearest one outside, by two sweeps over the neighbours (Borgefors 1986, 3-4
/// weights): within 8 % of the distance.
std::vector<double> clearances(const Cells& cells) {
  const CellMask& mask = cells.mask;
  std::vector<double> out(mask.cells.size());
  const double far = double(mask.columns + mask.rows) * cells.size;
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = mask.cells[n] != 0 ? far : 0;
  const auto sweep = [&](int step) {
    const int count = mask.columns * mask.rows;
    for (int n = step > 0 ? 0 : count - 1; n >= 0 && n < count; n += step) {
      const int x = n % mask.columns, y = n / mask.columns;
      double& own = out[std::size_t(n)];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int u = x + dx, v = y + dy;
          if (u < 0 || v < 0 || u >= mask.columns || v >= mask.rows) continue;
          own = std::min(own, out[mask.index(u, v)] + cells.size * (dx != 0 && dy != 0 ? 4 : 3) / 3.0 *
                                                          double(dx != 0 || dy != 0));
        }
    }
  };
  sweep(1), sweep(-1);
  return out;
}

}  // namespace

std::vector<glm::dvec2> roomCentres(const StandingArea& area, const RoomOptions& options) {
  if (area.empty()) return {};
  const Cells cells(area);
  const CellMask& mask = cells.mask;
  const std::vector<double> clear = clearances(cells);
  const auto placeOf = [&](std::size_t cell) {
    return cells.centre(int(cell) % mask.columns, int(cell) / mask.columns);
  };
  std::vector<glm::dvec2> centres;
  std::vector<char> met(clear.size(), 0);
  for (std::size_t first = 0; first < clear.size(); ++first) {
    const auto isCore = [&](std::size_t cell) { return clear[cell] > options.door / 2; };
    if (met[first] != 0 || !isCore(first)) continue;
    std::vector<std::size_t> room{first};
    met[first] = 1;
    for (std::size_t n = 0; n < room.size(); ++n) {
      // Neighbours exist: the outermost cells lie outside the area.
      const std::size_t row = std::size_t(mask.columns);
      for (const std::size_t next : {room[n] - 1, room[n] + 1, room[n] - row, room[n] + row})
        if (met[next] == 0 && isCore(next)) met[next] = 1, room.push_back(next);
    }
    if (double(room.size()) * cells.size * cells.size < options.leastArea) continue;
    centres.push_back(placeOf(*std::ranges::max_element(room, {}, [&](std::size_t n) { return clear[n]; })));
  }
  if (centres.empty())
    if (const auto widest = std::ranges::max_element(clear); widest != clear.end() && *widest > 0)
      centres.push_back(placeOf(std::size_t(widest - clear.begin())));
  return centres;
}

}  // namespace acentric
