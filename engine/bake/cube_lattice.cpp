#include "engine/bake/cube_lattice.h"

#include <algorithm>
#include <cmath>

namespace acentric {

glm::dvec3 CubeLattice::direction(int face, int column, int row) const {
  const int axis = face / 2;
  glm::dvec3 direction;
  direction[axis] = face % 2 == 0 ? 1 : -1;
  direction[(axis + 1) % 3] = 2.0 * column / side_ - 1;
  direction[(axis + 2) % 3] = 2.0 * row / side_ - 1;
  return direction;
}

glm::dvec3 CubeLattice::direction(std::size_t index) const {
  const std::size_t n = corners();
  return direction(int(index / (n * n)), int(index % n), int(index / n % n));
}

CubeLattice::Place CubeLattice::placeOf(const glm::dvec3& direction) const {
  const glm::dvec3 size = glm::abs(direction);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const auto cell = [&](int other) {
    return std::clamp((direction[other] / size[axis] + 1) * 0.5 * side_, 0.0, double(side_));
  };
  const double x = cell((axis + 1) % 3), y = cell((axis + 2) % 3);
  const int column = std::min(int(x), side_ - 1), row = std::min(int(y), side_ - 1);
  return {size[axis], index(2 * axis + (direction[axis] < 0 ? 1 : 0), column, row), {x - column, y - row}};
}

std::array<std::size_t, 8> CubeLattice::neighbours(std::size_t at) const {
  const std::size_t n = corners();
  const int face = int(at / (n * n)), column = int(at % n), row = int(at / n % n);
  std::array<std::size_t, 8> found;
  auto out = found.begin();
  for (int dr = -1; dr <= 1; ++dr)
    for (int dc = -1; dc <= 1; ++dc) {
      if (dr == 0 && dc == 0) continue;
      const int c = column + dc, r = row + dr;
      if (c >= 0 && c <= side_ && r >= 0 && r <= side_) {
        *out++ = index(face, c, r);
        continue;
      }
      const Place place = placeOf(direction(face, c, r));
      const std::size_t right = place.within.x < 0.5 ? 0 : 1, up = place.within.y < 0.5 ? 0 : n;
      *out++ = place.first + right + up;
    }
  return found;
}

}  // namespace acentric
