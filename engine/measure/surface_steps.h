#pragma once
/// Do neighbouring pixels of the truth show one surface?

#include <cstddef>

#include "engine/image/image.h"

namespace acentric {

/// One row or column of a picture.
struct PixelLine {
  std::size_t first, step, length;
  std::size_t at(std::size_t i) const { return first + i * step; }
};

inline PixelLine rowOf(const FloatImage& picture, int y) {
  return {std::size_t(y) * std::size_t(picture.width), 1, std::size_t(picture.width)};
}
inline PixelLine columnOf(const FloatImage& picture, int x) {
  return {std::size_t(x), std::size_t(picture.width), std::size_t(picture.height)};
}

/// Pixels i and i + 1 of a line. Inverse distances of a plane change nearly evenly along a line: a jump that
/// is several times what they change on either side is no plane. `distance`: metres along the ray, finite at
/// both.
bool oneSurface(const FloatImage& distance, const PixelLine& line, std::size_t i);

}  // namespace acentric
