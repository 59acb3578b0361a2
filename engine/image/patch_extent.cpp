#include "engine/image/patch_extent.h"

#include <algorithm>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Planes are taken no nearer to their horizon than where they are so much farther away than the patch.
constexpr float kHorizon = 0.02f;

constexpr std::array<glm::ivec2, 8> kWays{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// What parts a sample covers: [low, high).
struct PartBox {
  glm::ivec2 low{kCoverageParts}, high{0};
};
PartBox boxOf(std::uint16_t coverage) {
  if (coverage == kWholePixel) return {glm::ivec2(0), glm::ivec2(kCoverageParts)};
  PartBox box;
  for (int part = 0; part < kCoverageParts * kCoverageParts; ++part)
    if ((coverage >> part & 1) != 0) {
      const glm::ivec2 at(part % kCoverageParts, part / kCoverageParts);
      box.low = glm::min(box.low, at), box.high = glm::max(box.high, at + 1);
    }
  return box;
}

/// Does some of `b` lie on the eyes' side of a's plane, and some beyond it?
struct Sides {
  bool before = false, beyond = false;
};
Sides sidesOf(const PatchExtent& a, const PatchExtent& b) {
  const float towardsEye = a.plane.away != 0 ? 1.0f : -1.0f;
  Sides sides;
  for (std::size_t way = 0; way < b.corners.size(); ++way) {
    const float side = towardsEye * (glm::dot(a.plane.normal, b.corners[way]) - 1) * b.perSlack[way];
    sides.before |= side > 1;
    sides.beyond |= side < -1;
  }
  return sides;
}

/// Does a plane separate `a` from all eyes and `b`? Then it hides nothing of that.
bool isAside(const PatchExtent& a, const PatchExtent& b) {
  bool aside = false;
  for (std::size_t axis = 0; axis < PatchExtent::kAxes; ++axis)
    aside |= a.low[axis] > b.highWithEyes[axis] || a.high[axis] < b.lowWithEyes[axis];
  return aside;
}

}  // namespace

void PatchOutline::add(int column, int row, std::uint16_t coverage) {
  const PartBox box = boxOf(coverage);
  const glm::ivec2 pixel = kCoverageParts * glm::ivec2(column, row);
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    const glm::ivec2 corner = pixel + glm::ivec2(kWays[way].x > 0 ? box.high.x : box.low.x,
                                                 kWays[way].y > 0 ? box.high.y : box.low.y);
    if (const int along = kWays[way].x * corner.x + kWays[way].y * corner.y; along > most_[way])
      most_[way] = along, corners_[way] = corner;
  }
}

PatchExtents::PatchExtents(const ColumnCamera& camera, double tolerance, int firstColumn, int endColumn)
    : camera_(camera),
      tolerance_(float(tolerance)),
      ahead_(camera.directionAt(0.5 * (firstColumn + endColumn))),
      reach_(float(0.25 * std::min(camera.columnPitch(), camera.rowPitch()) / tolerance)) {
  for (std::size_t axis = 0; axis < PatchExtent::kAxes; ++axis) {
    const float turn = float(kPi) * float(axis) / float(PatchExtent::kAxes);
    axes_[axis] = {std::cos(turn), std::sin(turn)};
  }
}

PatchExtent PatchExtents::of(const SurfacePlane& plane, const PatchOutline& outline, float nearest,
                             float farthest) const {
  PatchExtent extent;
  extent.plane = plane;
  extent.nearest = nearest, extent.farthest = farthest;
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    const glm::dvec2 at = glm::dvec2(outline.corners()[way]) / double(kCoverageParts);
    const glm::vec3 direction(camera_.directionAt(at.x), camera_.tangentAt(at.y));
    const float inverse = std::max(glm::dot(plane.normal, direction), kHorizon * nearest);
    extent.corners[way] = direction / std::max(inverse, 1e-6f);
    extent.perSlack[way] = 1 / (tolerance_ * glm::length(glm::vec2(extent.corners[way])) + 1e-5f);
  }
  project(extent);
  return extent;
}

/// Eyes lie at P's height, and no farther from it than `reach_`.
void PatchExtents::project(PatchExtent& extent) const {
  for (std::size_t axis = 0; axis < PatchExtent::kAxes; ++axis) {
    const float along = axes_[axis].x, up = axes_[axis].y;
    float low = HUGE_VALF, high = -HUGE_VALF;
    for (std::size_t k = 0; k < extent.corners.size(); ++k) {
      const glm::vec3& corner = extent.corners[k];
      const float at = along * glm::dot(ahead_, glm::vec2(corner)) + up * corner.z;
      const float slack = glm::length(corner) / extent.perSlack[k];
      low = std::min(low, at + slack), high = std::max(high, at - slack);
    }
    const float eyes = reach_ * std::abs(along);
    extent.low[axis] = low, extent.high[axis] = high;
    extent.lowWithEyes[axis] = std::min(low, -eyes), extent.highWithEyes[axis] = std::max(high, eyes);
  }
}

Hiding hidingOf(const PatchExtent& first, const PatchExtent& second) {
  const Sides ofSecond = sidesOf(first, second), ofFirst = sidesOf(second, first);
  return {ofFirst.before && ofSecond.beyond && !isAside(first, second),
          ofSecond.before && ofFirst.beyond && !isAside(second, first)};
}

}  // namespace acentric
