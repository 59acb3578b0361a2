#include "engine/view/splats.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

/// Beyond this many pixels an image position is no candidate, and converting it to an integer is no longer
/// safe.
constexpr int kFarPixel = 30000;

template <class T>
bool insidePart(const ProjectColumn<T>& c, T w) {
  const T x = c.direction[0] + w * c.baseline[0], y = c.direction[1] + w * c.baseline[1];
  const T fromLow = c.low[0] * y - c.low[1] * x, toHigh = x * c.high[1] - y * c.high[0];
  return c.partTest == PartTest::within ? fromLow >= 0 && toHigh > 0 : fromLow >= 0 || toHigh > 0;
}

/// Of a number that an integer holds; as functions of the library these would take most of the time.
template <class T>
int floorOf(T a) {
  const int whole = static_cast<int>(a);
  return whole - (static_cast<T>(whole) > a);
}

/// Does the sample give one?
template <class T>
bool project(const ProjectColumn<T>& c, const T* rowTangent, const PackedSample& sample, Rgba8 colour,
             Splat& splat) {
  const T w = inverseDistanceOf(sample), t = rowTangent[sample.row];
  const T qz = c.a[2] + t * c.z[2] + w * c.b[2];
  if ((rolesOf(sample) & c.roles) == 0 || !(qz > 0) || !(w <= c.maxInverseDistance) ||
      !(w >= c.minInverseDistance) || (c.partTest != PartTest::none && !insidePart(c, w)))
    return false;
  const T perDepth = 1 / qz;
  const T u = (c.a[0] + t * c.z[0] + w * c.b[0]) * perDepth;
  const T v = (c.a[1] + t * c.z[1] + w * c.b[1]) * perDepth;
  if (!(std::abs(u) < kFarPixel) || !(std::abs(v) < kFarPixel)) return false;

  // A sample stands for pitch * distance across; seen under an angle off the view axis the picture stretches
  // it.
  const T offX = (u - c.centreX) * c.inverseFocal, offY = (v - c.centreY) * c.inverseFocal;
  const T stretch = std::sqrt((1 + t * t) * (1 + offX * offX + offY * offY));
  splat.side = -floorOf(-std::max(std::min(stretch * perDepth * c.footprint, c.maxSide), T(1)));
  const T half = T(0.5) - T(0.5) * static_cast<T>(splat.side);
  // The pixels whose centres lie in the square around (u, v).
  splat.x = floorOf(u + half), splat.y = floorOf(v + half);
  splat.pixel = canvasPixel((wordOf(colour) & 0xffffffu) | c.slot << 24, static_cast<float>(w * perDepth));
  return splat.x < c.canvas.x1 && splat.y < c.canvas.y1 && splat.x + splat.side > c.canvas.x0 &&
         splat.y + splat.side > c.canvas.y0;
}

}  // namespace

template <class T>
std::span<const Splat> projectSamples(const ProjectColumn<T>& column, const SampleColumn<T>& samples,
                                      std::vector<Splat>& memory) {
  const std::size_t count = samples.samples.size();
  if (memory.size() < count) memory.resize(count);
  std::size_t written = 0;
  for (std::size_t i = 0; i < count; ++i) {
    memory[written].index = static_cast<std::uint32_t>(i);
    written += project(column, samples.rowTangent, samples.samples[i], samples.colour[i], memory[written]);
  }
  return {memory.data(), written};
}

template std::span<const Splat> projectSamples(const ProjectColumn<float>&, const SampleColumn<float>&,
                                               std::vector<Splat>&);
template std::span<const Splat> projectSamples(const ProjectColumn<double>&, const SampleColumn<double>&,
                                               std::vector<Splat>&);

}  // namespace acentric
