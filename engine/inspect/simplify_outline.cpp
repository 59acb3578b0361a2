#include "engine/inspect/simplify_outline.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

using Loop = std::vector<glm::dvec2>;

struct Edge {
  glm::dvec2 a, b;
  std::size_t loop, index;
  double lowX() const { return std::min(a.x, b.x); }
  double highX() const { return std::max(a.x, b.x); }
};

bool within(const Edge& edge, const glm::dvec2& p) {  // p is on the edge's line
  return edge.lowX() <= p.x && p.x <= edge.highX() && std::min(edge.a.y, edge.b.y) <= p.y &&
         p.y <= std::max(edge.a.y, edge.b.y);
}

bool meet(const Edge& s, const Edge& t) {
  const int ta = orientation(s.a, s.b, t.a), tb = orientation(s.a, s.b, t.b);
  const int sa = orientation(t.a, t.b, s.a), sb = orientation(t.a, t.b, s.b);
  if (ta * tb < 0 && sa * sb < 0) return true;
  return (ta == 0 && within(s, t.a)) || (tb == 0 && within(s, t.b)) || (sa == 0 && within(t, s.a)) ||
         (sb == 0 && within(t, s.b));
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double lengthSquared = glm::dot(along, along);
  const double t = lengthSquared > 0 ? std::clamp(glm::dot(p - a, along) / lengthSquared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

/// Marks the corners to keep between two kept ones; no recursion, chains may be long.
void keepBetween(const Loop& loop, std::size_t first, std::size_t last, double tolerance,
                 std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double farthest = tolerance;
    std::size_t split = 0;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double distance = distanceToSegment(loop[k], loop[from], loop[to % loop.size()]);
      if (distance > farthest) farthest = distance, split = k;
    }
    if (split == 0) continue;
    keep[split] = true;
    open.push_back({from, split});
    open.push_back({split, to});
  }
}

Loop simplifyLoop(const Loop& loop, double tolerance) {
  if (loop.size() <= 3) return loop;
  // Cut the loop at two corners that surely stay: the lowest left one and the one farthest from it.
  Loop rotated = loop;
  const auto lowest = std::ranges::min_element(rotated, [](const glm::dvec2& p, const glm::dvec2& q) {
    return std::pair(p.x, p.y) < std::pair(q.x, q.y);
  });
  std::ranges::rotate(rotated, lowest);
  const auto away = [&](const glm::dvec2& p) { return glm::distance(p, rotated[0]); };
  const auto farthest =
      static_cast<std::size_t>(std::ranges::max_element(rotated, {}, away) - rotated.begin());
  std::vector<bool> keep(rotated.size(), false);
  keep[0] = keep[farthest] = true;
  keepBetween(rotated, 0, farthest, tolerance, keep);
  keepBetween(rotated, farthest, rotated.size(), tolerance, keep);
  Loop kept;
  for (std::size_t k = 0; k < rotated.size(); ++k)
    if (keep[k]) kept.push_back(rotated[k]);
  return kept;
}

double signedArea(const Loop& loop) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) twice += cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
  return 0.5 * twice;
}

}  // namespace

bool isSimple(const Outline& outline) {
  std::vector<Edge> edges;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const Loop& loop = outline.loops[l];
    if (loop.size() < 3) return false;
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.push_back({loop[k], loop[(k + 1) % loop.size()], l, k});
  }
  std::ranges::sort(edges, {}, &Edge::lowX);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].lowX() <= edges[i].highX(); ++j) {
      const Edge &s = edges[i], &t = edges[j];
      const std::size_t size = outline.loops[s.loop].size();
      const bool follows = s.loop == t.loop && (s.index + 1) % size == t.index;
      const bool leads = s.loop == t.loop && (t.index + 1) % size == s.index;
      if (!follows && !leads) {
        if (meet(s, t)) return false;
        continue;
      }
      // Neighbours share one corner; they must not fold back over each other.
      const Edge &before = follows ? s : t, &behind = follows ? t : s;
      if (orientation(before.a, before.b, behind.b) == 0 &&
          glm::dot(before.b - before.a, behind.b - behind.a) <= 0)
        return false;
    }
  return true;
}

Outline simplifyOutline(const Outline& outline, double tolerance) {
  for (int attempt = 0; attempt < 8; ++attempt, tolerance *= 0.5) {
    Outline simplified;
    for (std::size_t l = 0; l < outline.loops.size(); ++l) {
      Loop loop = simplifyLoop(outline.loops[l], tolerance);
      const bool vanished = loop.size() < 3 || std::abs(signedArea(loop)) < tolerance * tolerance;
      if (vanished && l == 0) loop = outline.loops[l];
      if (vanished && l > 0) continue;
      simplified.loops.push_back(std::move(loop));
    }
    if (isSimple(simplified)) return simplified;
  }
  return outline;
}

}  // namespace acentric
