#include "engine/scene/polygon_clipper.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

/// Signed distance (times the edge's length) to the line a -> b; its sign is exact.
double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const int sign = orientation(a, b, p);
  if (sign == 0) return 0;
  const glm::dvec2 edge = b - a;
  const glm::dvec2 offset = p - a;
  const double value = std::abs(edge.x * offset.y - edge.y * offset.x);
  return sign * std::max(value, std::numeric_limits<double>::min());
}

/// Where the segment p-q crosses the line. The ends are taken in a fixed order, so that triangles that share
/// the segment get the same point.
PolygonClipper::Corner crossing(const PolygonClipper::Corner& p, double sideOfP,
                                const PolygonClipper::Corner& q, double sideOfQ) {
  const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  if (before(q.position, p.position)) return crossing(q, sideOfQ, p, sideOfP);
  const double t = sideOfP / (sideOfP - sideOfQ);
  return {p.position + t * (q.position - p.position), p.barycentric + t * (q.barycentric - p.barycentric)};
}

}  // namespace

PolygonClipper::PolygonClipper(const ConvexPolygon& polygon)
    : polygon_(polygon),
      min_(std::numeric_limits<double>::max()),
      max_(std::numeric_limits<double>::lowest()) {
  for (const glm::dvec2& corner : polygon.corners)
    min_ = glm::min(min_, corner), max_ = glm::max(max_, corner);
}

bool PolygonClipper::missesBox(const std::array<glm::vec3, 3>& c) const {
  for (int axis = 0; axis < 2; ++axis) {
    if (std::max({c[0][axis], c[1][axis], c[2][axis]}) < min_[axis]) return true;
    if (std::min({c[0][axis], c[1][axis], c[2][axis]}) > max_[axis]) return true;
  }
  return false;
}

bool PolygonClipper::misses(const Bounds& box) const {
  return box.max.x < min_.x || box.max.y < min_.y || box.min.x > max_.x || box.min.y > max_.y;
}

void PolygonClipper::clipToEdge(const glm::dvec2& a, const glm::dvec2& b) {
  sides_.clear();
  bool outside = true;
  for (const Corner& corner : current_) {
    sides_.push_back(side(a, b, glm::dvec2(corner.position)));
    outside = outside && sides_.back() < 0;
  }
  next_.clear();
  if (!outside)
    for (std::size_t i = 0; i < current_.size(); ++i) {
      const std::size_t next = i + 1 == current_.size() ? 0 : i + 1;
      if (sides_[i] >= 0) next_.push_back(current_[i]);
      if ((sides_[i] > 0 && sides_[next] < 0) || (sides_[i] < 0 && sides_[next] > 0))
        next_.push_back(crossing(current_[i], sides_[i], current_[next], sides_[next]));
    }
  std::swap(current_, next_);
}

const std::vector<PolygonClipper::Corner>& PolygonClipper::clip(const std::array<glm::vec3, 3>& triangle) {
  current_.clear();
  if (polygon_.size() < 3 || missesBox(triangle)) return current_;
  // Outside one edge as a whole: decided by the triangle's own corners, before any rounded crossing.
  for (std::size_t e = 0; e < polygon_.size(); ++e) {
    const glm::dvec2 &a = polygon_.corners[e], &b = polygon_.corners[(e + 1) % polygon_.size()];
    if (std::ranges::all_of(triangle,
                            [&](const glm::vec3& p) { return orientation(a, b, glm::dvec2(p)) < 0; }))
      return current_;
  }
  current_.assign({{glm::dvec3(triangle[0]), {0, 0}},
                   {glm::dvec3(triangle[1]), {1, 0}},
                   {glm::dvec3(triangle[2]), {0, 1}}});
  for (std::size_t e = 0; e < polygon_.size() && !current_.empty(); ++e)
    clipToEdge(polygon_.corners[e], polygon_.corners[(e + 1) % polygon_.size()]);
  return current_;
}

bool PolygonClipper::leavesArea(const std::array<glm::vec3, 3>& triangle) {
  const std::vector<Corner>& left = clip(triangle);
  for (std::size_t i = 2; i < left.size(); ++i)
    if (hasArea(left, i)) return true;
  return false;
}

bool PolygonClipper::hasArea(const std::vector<Corner>& corners, std::size_t i) {
  return glm::cross(corners[i - 1].position - corners[0].position,
                    corners[i].position - corners[0].position) != glm::dvec3(0);
}

}  // namespace acentric
