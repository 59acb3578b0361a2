#pragma once
/// Directions spread over the six faces of a cube: the corners of `side` x `side` texels on each.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace acentric {

class CubeLattice {
 public:
  static constexpr int kFaces = 6;

  explicit CubeLattice(int side) : side_(side) {}

  int side() const { return side_; }
  int cornersPerEdge() const { return side_ + 1; }
  std::size_t size() const { return std::size_t(kFaces) * corners() * corners(); }

  /// Face 2a + s: axis a, s = 0 its positive half. Its columns run along axis a + 1, its rows along a + 2.
  /// The part along the axis is 1 or -1; beyond [0, side] the direction leaves the face.
  glm::dvec3 direction(int face, int column, int row) const;
  glm::dvec3 direction(std::size_t index) const;
  std::size_t index(int face, int column, int row) const {
    return (std::size_t(face) * corners() + std::size_t(row)) * corners() + std::size_t(column);
  }

  /// The texel of a direction, which is not 0, and where in it.
  struct Place {
    double size = 0;        ///< of the direction along the face's axis
    std::size_t first = 0;  ///< its corners: first and next, and the same of the next row
    glm::dvec2 within{0};   ///< 0..1
  };
  Place placeOf(const glm::dvec3& direction) const;
  std::array<std::size_t, 4> cornersOf(const Place& place) const {
    return {place.first, place.first + 1, place.first + corners(), place.first + corners() + 1};
  }
  /// The eight around a corner, on whatever face.
  std::array<std::size_t, 8> neighbours(std::size_t index) const;

 private:
  std::size_t corners() const { return std::size_t(side_) + 1; }
  int side_;
};

}  // namespace acentric
