#include "engine/inspect/standing_eyes.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

/// The n-th of points spread evenly over the polygon (a fan of triangles, by area), well inside it.
glm::dvec2 placeIn(const ConvexPolygon& polygon, int n) {
  constexpr double kRoot = 1.2207440846057596;  // surface_points.cpp
  const auto part = [&](double step) { return std::fmod(0.5 + n * step, 1.0); };
  double at = part(1 / kRoot) * polygon.area(), u = part(1 / (kRoot * kRoot)),
         v = part(1 / (kRoot * kRoot * kRoot));
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const std::vector<glm::dvec2>& c = polygon.corners;
  std::size_t k = 2;
  for (; k + 1 < c.size(); ++k) {
    const double area = 0.5 * cross(c[k - 1] - c[0], c[k] - c[0]);
    if (at < area) break;
    at -= area;
  }
  const glm::dvec2 place = c[0] + u * (c[k - 1] - c[0]) + v * (c[k] - c[0]);
  constexpr double kInwards = 1e-3;
  return glm::mix(place, polygon.centroid(), kInwards);
}

}  // namespace

Status EyeOptions::check() const {
  if (perRegion < 1 || perRegion > 100000)
    return fail(ErrorKind::invalidArgument, "eyes per region must lie in 1..100000", "surface coverage");
  if (mostRegions < 0)
    return fail(ErrorKind::invalidArgument, "the most regions with eyes must not be negative",
                "surface coverage");
  if (!(lower >= 0 && lower <= 1000 && higher >= 0 && higher <= 1000))
    return fail(ErrorKind::invalidArgument, "the range of eye heights must lie within 1000 m",
                "surface coverage");
  return {};
}

std::vector<std::vector<glm::dvec3>> standingEyes(const Layout& layout, const EyeOptions& options) {
  constexpr int kTriesPerEye = 32;  // finds what of a region is walkable down to a few per cent of it
  constexpr double kGolden = 0.6180339887498949;
  const Outline& outline = layout.spec.outline;
  std::vector<std::vector<glm::dvec3>> eyes(layout.regions.size());
  for (std::size_t r = 0; r < eyes.size(); ++r) {
    // Multiples of the golden ratio skip evenly, and whatever the rhythm in which kinds of regions follow one
    // another.
    if (options.mostRegions > 0 &&
        std::fmod(double(r) * kGolden, 1.0) * double(eyes.size()) >= double(options.mostRegions))
      continue;
    const Region& region = layout.regions[r];
    const bool everywhere = outline.empty() || layout.spec.added.contains(region.id);
    for (int n = 0; n < options.perRegion * kTriesPerEye && int(eyes[r].size()) < options.perRegion; ++n) {
      const glm::dvec2 place = placeIn(region.polygon, n);
      if (!everywhere && !outline.contains(place)) continue;
      const double height = std::fmod(0.5 + double(eyes[r].size()) * kGolden, 1.0);
      eyes[r].emplace_back(place, layout.eyeZ() - options.lower + height * (options.lower + options.higher));
    }
  }
  return eyes;
}

}  // namespace acentric
