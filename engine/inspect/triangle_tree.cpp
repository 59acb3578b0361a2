#include "engine/inspect/triangle_tree.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/base/contract.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

constexpr std::size_t kLeafTriangles = 8;

/// The bits of a 16-bit number at even places.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 8)) & 0x00ff00ff;
  v = (v | (v << 4)) & 0x0f0f0f0f;
  v = (v | (v << 2)) & 0x33333333;
  return (v | (v << 1)) & 0x55555555;
}

std::uint32_t quantised(float value, float low, float size) {
  const float share = size > 0 ? (value - low) / size : 0;
  return share > 0 ? static_cast<std::uint32_t>(std::min(share, 1.0f) * 65535) : 0;
}

bool hasArea(const std::array<glm::vec3, 3>& c) {
  const glm::dvec3 a(c[0]);
  return glm::cross(glm::dvec3(c[1]) - a, glm::dvec3(c[2]) - a) != glm::dvec3(0);
}

}  // namespace

TriangleTree::TriangleTree(ScenePtr scene) : scene_(std::move(scene)) {
  triangles_.reserve(scene_->triangleCount());
  for (std::size_t m = 0; m < scene_->meshes.size(); ++m)
    for (std::size_t t = 0; t < scene_->meshes[m].triangles.size(); ++t)
      triangles_.push_back({std::uint32_t(m), std::uint32_t(t)});
  sortTriangles();
  makeNodes();
}

std::array<glm::vec3, 3> TriangleTree::cornersOf(const Triangle& triangle) const {
  const Mesh& mesh = scene_->meshes[triangle.mesh];
  const glm::uvec3& at = mesh.triangles[triangle.index];
  return {mesh.positions[at.x], mesh.positions[at.y], mesh.positions[at.z]};
}

void TriangleTree::sortTriangles() {
  const Bounds bounds = boundsOf(*scene_);
  const glm::vec2 low(bounds.min), size(bounds.size());
  const float extent = std::max(size.x, size.y);
  struct Entry {
    std::uint64_t key;
    Triangle triangle;
  };
  std::vector<Entry> entries;
  entries.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_) {
    const auto c = cornersOf(triangle);
    const glm::vec2 min = glm::min(glm::vec2(c[0]), glm::min(glm::vec2(c[1]), glm::vec2(c[2])));
    const glm::vec2 max = glm::max(glm::vec2(c[0]), glm::max(glm::vec2(c[1]), glm::vec2(c[2])));
    const glm::vec2 middle = 0.5f * (min + max);
    const float side = std::max(max.x - min.x, max.y - min.y);
    // Large triangles apart from small ones, whose boxes they would spoil.
    std::uint64_t sizeClass = 0;
    for (float limit = extent / 8; sizeClass < 4 && side < limit; limit /= 4) ++sizeClass;
    entries.push_back({(sizeClass << 32) | spread(quantised(middle.x, low.x, extent)) |
                           (spread(quantised(middle.y, low.y, extent)) << 1),
                       triangle});
  }
  std::ranges::sort(entries, {}, &Entry::key);
  for (std::size_t n = 0; n < entries.size(); ++n) triangles_[n] = entries[n].triangle;
}

void TriangleTree::makeNodes() {
  leaves_ = std::bit_ceil((triangles_.size() + kLeafTriangles - 1) / kLeafTriangles);
  nodes_.resize(2 * leaves_);
  for (std::size_t n = 0; n < triangles_.size(); ++n) {
    Node& leaf = nodes_[leaves_ + n / kLeafTriangles];
    const auto corners = cornersOf(triangles_[n]);
    for (const glm::vec3& corner : corners)
      leaf.min = glm::min(leaf.min, glm::vec2(corner)), leaf.max = glm::max(leaf.max, glm::vec2(corner));
    leaf.withArea += hasArea(corners) ? 1 : 0;
  }
  for (std::size_t n = leaves_; n-- > 1;) {
    const Node &a = nodes_[2 * n], &b = nodes_[2 * n + 1];
    nodes_[n] = {glm::min(a.min, b.min), glm::max(a.max, b.max), a.withArea + b.withArea};
  }
}

/// One count. An edge is open while what is below the node may lie on both sides of it.
class TriangleTree::Query {
 public:
  Query(const TriangleTree& tree, const ConvexPolygon& polygon)
      : tree_(tree), polygon_(polygon), clipper_(polygon) {
    require(polygon.size() <= 64, "a region's polygon has at most 64 corners");
  }

  std::size_t count(std::size_t node, std::uint64_t open) {
    const Node& here = tree_.nodes_[node];
    if (here.withArea == 0) return 0;
    for (std::uint64_t left = open; left != 0; left &= left - 1) {
      const int e = std::countr_zero(left);
      const auto [a, b] = edge(e);
      // The box's corners that lie farthest to the left and to the right of the edge.
      const bool up = b.x > a.x, leftwards = b.y > a.y;
      const glm::dvec2 innermost(leftwards ? here.min.x : here.max.x, up ? here.max.y : here.min.y);
      const glm::dvec2 outermost(leftwards ? here.max.x : here.min.x, up ? here.min.y : here.max.y);
      if (orientation(a, b, innermost) < 0) return 0;
      if (orientation(a, b, outermost) >= 0) open &= ~(std::uint64_t(1) << e);
    }
    if (open == 0) return here.withArea;
    if (node < tree_.leaves_) return count(2 * node, open) + count(2 * node + 1, open);
    const std::size_t first = (node - tree_.leaves_) * kLeafTriangles;
    std::size_t sum = 0;
    for (std::size_t n = first; n < std::min(first + kLeafTriangles, tree_.triangles_.size()); ++n)
      sum += countTriangle(tree_.cornersOf(tree_.triangles_[n]), open);
    return sum;
  }

 private:
  std::pair<const glm::dvec2&, const glm::dvec2&> edge(int e) const {
    const std::size_t at = static_cast<std::size_t>(e);
    return {polygon_.corners[at], polygon_.corners[at + 1 == polygon_.size() ? 0 : at + 1]};
  }

  std::size_t countTriangle(const std::array<glm::vec3, 3>& triangle, std::uint64_t open) {
    bool inside = true;
    for (std::uint64_t left = open; left != 0; left &= left - 1) {
      const auto [a, b] = edge(std::countr_zero(left));
      int outside = 0;
      for (const glm::vec3& corner : triangle) outside += orientation(a, b, glm::dvec2(corner)) < 0 ? 1 : 0;
      if (outside == 3) return 0;
      inside = inside && outside == 0;
    }
    if (inside) return hasArea(triangle) ? 1 : 0;
    const auto& corners = clipper_.clip(triangle);
    std::size_t sum = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) sum += PolygonClipper::hasArea(corners, i) ? 1 : 0;
    return sum;
  }

  const TriangleTree& tree_;
  const ConvexPolygon& polygon_;
  PolygonClipper clipper_;
};

std::size_t TriangleTree::countClipped(const ConvexPolygon& polygon) const {
  if (polygon.size() < 3 || triangles_.empty()) return 0;
  const std::uint64_t all = ~std::uint64_t(0) >> (64 - polygon.size());
  return Query(*this, polygon).count(1, all);
}

}  // namespace acentric
