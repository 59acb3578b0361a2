#pragma once
/// Small layouts, random eyes and brute-force ray crossings for the tests of the layout.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/layout/drawing_order.h"
#include "tests/support/print_configuration.h"

namespace acentric::test {

struct Placing {
  double cellSize = 2;
  glm::dvec2 origin{0};
  double rotation = 0;
};

inline constexpr Configuration kAllConfigurations[] = {Configuration::a, Configuration::b, Configuration::c,
                                                       Configuration::d, Configuration::e, Configuration::f,
                                                       Configuration::g};

/// Everything that touches a box of about `halfCells` cells around the lattice's origin.
inline Layout makeLayout(Configuration configuration, const Placing& placing = {}, double halfCells = 1.6) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = placing.cellSize;
  spec.latticeOrigin = placing.origin;
  spec.rotationRadians = placing.rotation;
  const double h = halfCells * placing.cellSize;
  const glm::dvec2 o = placing.origin;
  spec.outline.loops = {{{o.x - h, o.y - h}, {o.x + h, o.y - h}, {o.x + h, o.y + h}, {o.x - h, o.y + h}}};
  Result<Layout> layout = buildLayout(spec);
  EXPECT_TRUE(layout) << (layout ? "" : layout.error().describe());
  return layout ? *layout : Layout{};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int index(std::size_t count) {
    return std::uniform_int_distribution<int>(0, static_cast<int>(count) - 1)(engine_);
  }
  /// Uniform enough: a random convex combination of the corners.
  glm::dvec2 within(const ConvexPolygon& polygon) {
    glm::dvec2 low = polygon.corners[0], high = low;
    for (const glm::dvec2& c : polygon.corners) low = glm::min(low, c), high = glm::max(high, c);
    for (;;)
      if (const glm::dvec2 p{(*this)(low.x, high.x), (*this)(low.y, high.y)}; polygon.contains(p)) return p;
  }

 private:
  std::mt19937 engine_;
};

/// The cameras whose pieces a ray crosses outside the region, nearest first, by walking along it in long
/// double between all the places where it meets a border line. Pieces crossed for less than `sliver` metres
/// are left out.
inline std::vector<int> crossedAlongRay(const Region& region, const Cover& cover, const glm::dvec2& eye,
                                        const glm::dvec2& direction, double sliver) {
  using Real = long double;
  const auto crossReal = [](Real ax, Real ay, Real bx, Real by) { return ax * by - ay * bx; };
  Real leave = 0;
  std::vector<Real> stops;
  const auto stopAt = [&](const glm::dvec2& from, const glm::dvec2& to) {
    const Real ex = Real(to.x) - from.x, ey = Real(to.y) - from.y;
    const Real rate = crossReal(ex, ey, direction.x, direction.y);
    if (rate == 0) return;
    const Real t = -crossReal(ex, ey, Real(eye.x) - from.x, Real(eye.y) - from.y) / rate;
    if (t > 0) stops.push_back(t);
  };
  for (std::size_t k = 0; k < region.polygon.size(); ++k)
    stopAt(region.polygon.corners[k], region.polygon.corners[(k + 1) % region.polygon.size()]);
  for (const Piece& piece : cover.pieces) {
    stopAt(piece.low.from, piece.low.to);
    stopAt(piece.high.from, piece.high.to);
    if (piece.clip) stopAt(piece.clip->side.line.from, piece.clip->side.line.to);
  }
  if (const auto span = region.polygon.raySpan(eye, direction)) leave = span->second;
  stops.push_back(leave);
  std::ranges::sort(stops);
  const Real size = glm::distance(region.polygon.corners[0], region.polygon.corners[1]);
  stops.push_back(std::max(stops.back(), Real(0)) + 4 * size);
  std::vector<int> crossed;
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    if (stops[s] < leave || stops[s + 1] - stops[s] < sliver) continue;
    const Real t = (stops[s] + stops[s + 1]) / 2;
    const glm::dvec2 at{double(Real(eye.x) + t * direction.x), double(Real(eye.y) + t * direction.y)};
    for (const Piece& piece : cover.pieces)
      if (piece.holds(at) && (crossed.empty() || crossed.back() != piece.camera))
        crossed.push_back(piece.camera);
  }
  return crossed;
}

}  // namespace acentric::test
