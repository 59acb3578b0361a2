#include "engine/view/frame.h"

#include <algorithm>

namespace acentric {
void MeshCost::add(const MeshCost& other) {
  samples += other.samples, triangles += other.triangles, bytes += other.bytes;
  error = std::max(error, other.error);
  buildSeconds += other.buildSeconds;
}

MeshCost FrameStats::meshSum() const {
  MeshCost sum;
  for (const MeshCost& cost : meshes) sum.add(cost);
  return sum;
}

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
