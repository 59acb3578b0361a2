#include "engine/geometry/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

struct Segment {
  glm::dvec2 a, b;
};

template <class Visit>
void forEachEdge(const Outline& outline, const Visit& visit) {
  for (const auto& loop : outline.loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      visit(Segment{loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]});
}

/// Heights at which the even-odd inside changes its shape: corners, and places where edges cross.
std::vector<double> breakHeights(const std::vector<Segment>& edges) {
  std::vector<double> heights;
  for (const Segment& edge : edges) heights.push_back(edge.a.y);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const Segment &s = edges[i], &t = edges[j];
      if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) ||
          std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
          std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
        continue;
      if (orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) >= 0) continue;
      if (orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) >= 0) continue;
      const glm::dvec2 d = s.b - s.a, e = t.b - t.a;
      heights.push_back(s.a.y + d.y * cross(t.a - s.a, e) / cross(d, e));
    }
  std::ranges::sort(heights);
  const auto repeats = std::ranges::unique(heights);
  heights.erase(repeats.begin(), repeats.end());
  return heights;
}

/// Does the segment pass through the open convex polygon? (separating axes, exact)
bool passesThrough(const Segment& segment, const ConvexPolygon& polygon) {
  const auto& corners = polygon.corners;
  bool someLeft = false, someRight = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 &a = corners[k], &b = corners[k + 1 == corners.size() ? 0 : k + 1];
    if (orientation(a, b, segment.a) <= 0 && orientation(a, b, segment.b) <= 0) return false;
    const int side = orientation(segment.a, segment.b, a);
    someLeft |= side > 0;
    someRight |= side < 0;
  }
  return someLeft && someRight;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Calls `each` with every part of `text` between separators; stops at the first error.
template <class Each>
Status forEachPart(std::string_view text, char separator, const Each& each) {
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    if (Status status = each(trimmed(text.substr(begin, end == std::string_view::npos ? end : end - begin)));
        !status)
      return status;
    if (end == std::string_view::npos) return {};
    begin = end + 1;
  }
}

Result<double> parseNumber(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return fail(
        ErrorKind::invalidArgument,
        fmt::format("'{}' is not a finite number; write points as x,y;x,y;x,y in metres", text.substr(0, 40)),
        "outline");
  return value;
}

}  // namespace

double Outline::area() const {
  std::vector<Segment> edges;
  forEachEdge(*this, [&](const Segment& edge) { edges.push_back(edge); });
  const std::vector<double> heights = breakHeights(edges);
  double sum = 0;
  std::vector<double> crossings;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double middle = 0.5 * (heights[k] + heights[k + 1]);
    crossings.clear();
    for (const Segment& edge : edges)
      if ((edge.a.y <= middle) != (edge.b.y <= middle))
        crossings.push_back(edge.a.x + (edge.b.x - edge.a.x) * ((middle - edge.a.y) / (edge.b.y - edge.a.y)));
    std::ranges::sort(crossings);
    for (std::size_t c = 0; c + 1 < crossings.size(); c += 2)
      sum += (crossings[c + 1] - crossings[c]) * (heights[k + 1] - heights[k]);
  }
  return sum;
}

bool Outline::contains(const glm::dvec2& point) const {
  bool inside = false;
  forEachEdge(*this, [&](const Segment& edge) {
    const bool upwards = edge.b.y > edge.a.y;
    if ((edge.a.y <= point.y) == (edge.b.y <= point.y)) return;
    const int side = orientation(edge.a, edge.b, point);
    if (upwards ? side > 0 : side < 0) inside = !inside;  // strictly right of the point, as in ConvexPolygon
  });
  return inside;
}

bool Outline::overlaps(const ConvexPolygon& polygon) const {
  if (polygon.size() < 3) return false;
  glm::dvec2 low = polygon.corners[0], high = low;
  for (const glm::dvec2& corner : polygon.corners) low = glm::min(low, corner), high = glm::max(high, corner);
  bool crossed = false;
  forEachEdge(*this, [&](const Segment& edge) {
    if (crossed || std::max(edge.a.x, edge.b.x) <= low.x || std::min(edge.a.x, edge.b.x) >= high.x ||
        std::max(edge.a.y, edge.b.y) <= low.y || std::min(edge.a.y, edge.b.y) >= high.y)
      return;
    crossed = passesThrough(edge, polygon);
  });
  // Not crossed: the polygon's open inside lies wholly within the outline or wholly without.
  return crossed || contains(polygon.centroid());
}

glm::dvec2 Outline::nearestPoint(const glm::dvec2& point) const {
  if (contains(point)) return point;
  glm::dvec2 best = point;
  double bestDistance = std::numeric_limits<double>::infinity();
  forEachEdge(*this, [&](const Segment& edge) {
    const glm::dvec2 along = edge.b - edge.a;
    const double lengthSquared = glm::dot(along, along);
    const double t =
        lengthSquared > 0 ? std::clamp(glm::dot(point - edge.a, along) / lengthSquared, 0.0, 1.0) : 0.0;
    const glm::dvec2 candidate = t == 1 ? edge.b : edge.a + along * t;
    if (const double distance = glm::distance(point, candidate); distance < bestDistance)
      bestDistance = distance, best = candidate;
  });
  return best;
}

Result<Outline> parseOutline(std::string_view text) {
  Outline outline;
  const Status status = forEachPart(text, '/', [&](std::string_view loopText) -> Status {
    std::vector<glm::dvec2> loop;
    const Status points = forEachPart(loopText, ';', [&](std::string_view pointText) -> Status {
      if (pointText.empty()) return {};  // a closing ';' is welcome
      const std::size_t comma = pointText.find(',');
      if (comma == std::string_view::npos)
        return fail(ErrorKind::invalidArgument,
                    fmt::format("'{}' is not a point; write points as x,y;x,y;x,y in metres",
                                pointText.substr(0, 40)),
                    "outline");
      const Result<double> x = parseNumber(trimmed(pointText.substr(0, comma)));
      if (!x) return tl::unexpected(x.error());
      const Result<double> y = parseNumber(trimmed(pointText.substr(comma + 1)));
      if (!y) return tl::unexpected(y.error());
      if (const glm::dvec2 point(*x, *y); loop.empty() || loop.back() != point) loop.push_back(point);
      return {};
    });
    if (!points) return points;
    if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("loop {} has {} different points; a loop needs at least 3",
                              outline.loops.size() + 1, loop.size()),
                  "outline");
    outline.loops.push_back(std::move(loop));
    return {};
  });
  if (!status) return tl::unexpected(status.error());
  if (!(outline.area() > 0))
    return fail(ErrorKind::invalidArgument, "encloses no area; give the corners of a walkable floor in order",
                "outline");
  return outline;
}

std::string formatOutline(const Outline& outline) {
  std::string text;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    if (l > 0) text += '/';
    for (std::size_t k = 0; k < outline.loops[l].size(); ++k)
      text += fmt::format("{}{},{}", k > 0 ? ";" : "", outline.loops[l][k].x, outline.loops[l][k].y);
  }
  return text;
}

}  // namespace acentric
