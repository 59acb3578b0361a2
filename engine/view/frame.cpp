#include "engine/view/frame.h"

#include <algorithm>

namespace acentric {
namespace {

bool isOpen(PixelSource source) { return source == kSourceHole || source == kSourceInvented; }

}  // namespace

std::size_t Frame::holeCount() const {
  return static_cast<std::size_t>(std::count_if(source.pixels.begin(), source.pixels.end(), isOpen));
}

ColourImage Frame::holeMask() const {
  ColourImage mask(source.width, source.height, Rgba8(0, 0, 0, 255));
  for (std::size_t i = 0; i < source.pixels.size(); ++i)
    if (isOpen(source.pixels[i])) mask.pixels[i] = Rgba8(255);
  return mask;
}

}  // namespace acentric
