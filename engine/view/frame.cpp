#include "engine/view/frame.h"

#include <algorithm>

namespace acentric {

std::size_t Frame::holeCount() const {
  return source.pixels.size() - std::size_t(std::ranges::count_if(source.pixels, isReal));
}

ColourImage Frame::holeMask() const {
  ColourImage mask(source.width, source.height, Rgba8(0, 0, 0, 255));
  for (std::size_t i = 0; i < source.pixels.size(); ++i)
    if (!isReal(source.pixels[i])) mask.pixels[i] = Rgba8(255);
  return mask;
}

}  // namespace acentric
