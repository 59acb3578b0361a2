#include "engine/geometry/convex_polygon.h"

#include <algorithm>
#include <limits>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

using Corners = std::vector<glm::dvec2>;

const glm::dvec2& after(const Corners& corners, std::size_t k) {
  return corners[k + 1 == corners.size() ? 0 : k + 1];
}

glm::dvec2 outwardNormal(const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 edge = to - from;
  const double length = glm::length(edge);
  return length > 0 ? glm::dvec2(edge.y, -edge.x) / length : glm::dvec2(0);
}

/// The part with dot(normal, p) <= limit (Sutherland-Hodgman).
Corners clippedBy(const Corners& corners, const glm::dvec2& normal, double limit) {
  Corners kept;
  kept.reserve(corners.size() + 1);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], &b = after(corners, k);
    const double beyondA = glm::dot(normal, a) - limit, beyondB = glm::dot(normal, b) - limit;
    if (beyondA <= 0) kept.push_back(a);
    if ((beyondA < 0 && beyondB > 0) || (beyondA > 0 && beyondB < 0))
      kept.push_back(a + (b - a) * (beyondA / (beyondA - beyondB)));
  }
  return kept;
}

/// Is every corner of `other` strictly outside some edge of `corners`?
bool anEdgeSeparates(const Corners& corners, const Corners& other) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], &b = after(corners, k);
    if (std::ranges::all_of(other, [&](const glm::dvec2& p) { return orientation(a, b, p) < 0; }))
      return true;
  }
  return false;
}

}  // namespace

double ConvexPolygon::area() const {
  double twice = 0;  // relative to a corner: far from the origin the products would cancel badly
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    twice += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  return 0.5 * twice;
}

glm::dvec2 ConvexPolygon::centroid() const {
  if (corners.empty()) return glm::dvec2(0);
  glm::dvec2 sum(0), mean(0);
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) mean += corners[k] - corners[0];
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const glm::dvec2 a = corners[k] - corners[0], b = corners[k + 1] - corners[0];
    twice += cross(a, b);
    sum += (a + b) * cross(a, b);
  }
  if (!(twice > 0)) return corners[0] + mean / double(corners.size());
  return corners[0] + sum / (3 * twice);
}

bool ConvexPolygon::contains(const glm::dvec2& point) const { return containsHalfOpen(corners, point); }

bool containsHalfOpen(std::span<const glm::dvec2> corners, const glm::dvec2& point) {
  // A point on the border is decided as if it were moved by an infinitely small step to +x, and by a still
  // smaller one to +y: the moved point lies on no border, so exactly one polygon of a tessellation holds it.
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], &b = corners[k + 1 < corners.size() ? k + 1 : 0];
    const int side = orientation(a, b, point);
    if (side < 0) return false;
    if (side == 0 && !(b.y < a.y || (b.y == a.y && b.x > a.x))) return false;
  }
  return corners.size() >= 3;
}

bool ConvexPolygon::containsClosed(const glm::dvec2& point) const {
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (orientation(corners[k], after(corners, k), point) < 0) return false;
  return corners.size() >= 3;
}

ConvexPolygon ConvexPolygon::grown(double distance) const {
  const std::size_t count = corners.size();
  if (count < 3 || distance == 0) return *this;
  if (distance < 0) {
    Corners rest = corners;
    for (std::size_t k = 0; k < count && !rest.empty(); ++k) {
      const glm::dvec2 normal = outwardNormal(corners[k], after(corners, k));
      rest = clippedBy(rest, normal, glm::dot(normal, corners[k]) + distance);
    }
    ConvexPolygon result{std::move(rest)};
    if (result.size() < 3 || !(result.area() > 0)) result.corners.clear();
    return result;
  }
  ConvexPolygon result;
  result.corners.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec2 before = outwardNormal(corners[(k + count - 1) % count], corners[k]);
    const glm::dvec2 behind = outwardNormal(corners[k], after(corners, k));
    // Both offset lines pass through corner + s with dot(s, normal) = distance for either normal.
    const double spread = std::max(1 + glm::dot(before, behind), 1e-12);
    result.corners.push_back(corners[k] + (before + behind) * (distance / spread));
  }
  return result;
}

std::optional<std::pair<double, double>> ConvexPolygon::raySpan(const glm::dvec2& origin,
                                                                const glm::dvec2& direction) const {
  if (corners.size() < 3) return std::nullopt;
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], edge = after(corners, k) - a;
    const double inside = cross(edge, origin - a);   // >= 0: origin within this edge's half-plane
    const double approach = cross(edge, direction);  // rate at which it grows along the ray
    if (approach == 0) {
      if (inside < 0) return std::nullopt;
      continue;
    }
    const double t = -inside / approach;
    if (approach > 0)
      enter = std::max(enter, t);
    else
      leave = std::min(leave, t);
  }
  if (!(enter <= leave)) return std::nullopt;
  return std::pair{enter, leave};
}

glm::dvec2 ConvexPolygon::nearestPoint(const glm::dvec2& point) const {
  if (containsClosed(point)) return point;
  glm::dvec2 best = point;
  double bestDistance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], edge = after(corners, k) - a;
    const double lengthSquared = glm::dot(edge, edge);
    const double t =
        lengthSquared > 0 ? std::clamp(glm::dot(point - a, edge) / lengthSquared, 0.0, 1.0) : 0.0;
    const glm::dvec2 candidate = t == 1 ? after(corners, k) : a + edge * t;
    const double distance = glm::distance(point, candidate);
    if (distance < bestDistance) bestDistance = distance, best = candidate;
  }
  return best;
}

bool overlap(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (a.size() < 3 || b.size() < 3) return false;
  return !anEdgeSeparates(a.corners, b.corners) && !anEdgeSeparates(b.corners, a.corners);
}

}  // namespace acentric
