#include "engine/scene/local_geometry.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "engine/base/contract.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

/// A corner while clipping, in double: where it is and which blend of the source triangle.
struct Corner {
  glm::dvec3 position;
  glm::dvec2 barycentric;
};

/// Clipping a triangle adds at most one corner per edge of the polygon.
using Corners = std::vector<Corner>;

struct PlanBox {
  glm::dvec2 min{std::numeric_limits<double>::max()};
  glm::dvec2 max{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec2& p) { min = glm::min(min, p), max = glm::max(max, p); }
};

/// Signed distance (times the edge's length) to the line a -> b; its sign is exact, so that two polygons that
/// share the edge agree on every corner: what lies on it is kept by both.
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
Corner crossing(const Corner& p, double sideOfP, const Corner& q, double sideOfQ) {
  const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  if (before(q.position, p.position)) return crossing(q, sideOfQ, p, sideOfP);
  const double t = sideOfP / (sideOfP - sideOfQ);
  return {p.position + t * (q.position - p.position), p.barycentric + t * (q.barycentric - p.barycentric)};
}

void clipToEdge(const Corners& in, const glm::dvec2& a, const glm::dvec2& b, std::vector<double>& sides,
                Corners& out) {
  out.clear();
  sides.clear();
  for (const Corner& corner : in) sides.push_back(side(a, b, glm::dvec2(corner.position)));
  for (std::size_t i = 0; i < in.size(); ++i) {
    const std::size_t next = i + 1 == in.size() ? 0 : i + 1;
    if (sides[i] >= 0) out.push_back(in[i]);
    if ((sides[i] > 0 && sides[next] < 0) || (sides[i] < 0 && sides[next] > 0))
      out.push_back(crossing(in[i], sides[i], in[next], sides[next]));
  }
}

bool hasArea(const Corner& a, const Corner& b, const Corner& c) {
  return glm::cross(b.position - a.position, c.position - a.position) != glm::dvec3(0);
}

class Clipper {
 public:
  explicit Clipper(const ConvexPolygon& polygon) : polygon_(polygon) {
    for (const glm::dvec2& corner : polygon.corners) box_.add(corner);
  }

  void add(const Mesh& mesh, std::uint32_t meshIndex, LocalGeometry& out) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& triangle = mesh.triangles[t];
      const std::array<glm::vec3, 3> corners{mesh.positions[triangle.x], mesh.positions[triangle.y],
                                             mesh.positions[triangle.z]};
      if (missesBox(corners)) continue;
      current_.assign({{glm::dvec3(corners[0]), {0, 0}},
                       {glm::dvec3(corners[1]), {1, 0}},
                       {glm::dvec3(corners[2]), {0, 1}}});
      for (std::size_t e = 0; e < polygon_.size() && !current_.empty(); ++e) {
        clipToEdge(current_, polygon_.corners[e], polygon_.corners[(e + 1) % polygon_.size()], sides_, next_);
        std::swap(current_, next_);
      }
      emit(meshIndex, std::uint32_t(t), out);
    }
  }

 private:
  bool missesBox(const std::array<glm::vec3, 3>& c) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (std::max({c[0][axis], c[1][axis], c[2][axis]}) < box_.min[axis]) return true;
      if (std::min({c[0][axis], c[1][axis], c[2][axis]}) > box_.max[axis]) return true;
    }
    return false;
  }

  void emit(std::uint32_t meshIndex, std::uint32_t triangle, LocalGeometry& out) const {
    if (current_.size() < 3) return;
    const std::uint32_t first = std::uint32_t(out.vertices.size());
    bool any = false;
    for (std::size_t i = 2; i < current_.size(); ++i) {
      if (!hasArea(current_[0], current_[i - 1], current_[i])) continue;
      out.triangles.push_back(
          {{first, first + std::uint32_t(i) - 1, first + std::uint32_t(i)}, meshIndex, triangle});
      any = true;
    }
    if (!any) return;
    for (const Corner& corner : current_)
      out.vertices.push_back({glm::vec3(corner.position), glm::vec2(corner.barycentric)});
  }

  const ConvexPolygon& polygon_;
  PlanBox box_;
  Corners current_, next_;
  std::vector<double> sides_;
};

}  // namespace

LocalGeometry clipToPolygon(const Scene& scene, const ConvexPolygon& polygon) {
  LocalGeometry out;
  out.polygon = polygon;
  if (polygon.size() < 3) return out;
  Clipper clipper(polygon);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) clipper.add(scene.meshes[m], std::uint32_t(m), out);
  require(out.vertices.size() <= std::numeric_limits<std::uint32_t>::max(),
          "local geometry has less than 2^32 vertices");
  return out;
}

}  // namespace acentric
