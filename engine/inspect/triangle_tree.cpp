#include "engine/inspect/triangle_tree.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/base/contract.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/scene/instances.h"
#include "engine/scene/placed_mesh.h"
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

template <class Triangle>
std::vector<Triangle> allOf(const std::vector<Mesh>& meshes, std::size_t first = 0,
                            std::size_t end = std::numeric_limits<std::size_t>::max()) {
  std::vector<Triangle> all;
  for (std::size_t m = first; m < std::min(end, meshes.size()); ++m)
    for (std::size_t t = 0; t < meshes[m].triangles.size(); ++t)
      all.push_back({std::uint32_t(m), std::uint32_t(t)});
  return all;
}

}  // namespace

TriangleTree::TriangleTree(ScenePtr scene)
    : scene_(std::move(scene)), meshes_(scene_->meshes, allOf<Triangle>(scene_->meshes)) {
  for (std::size_t p = 0; p < scene_->prototypes.size(); ++p)
    prototypes_.emplace_back(scene_->prototypes, allOf<Triangle>(scene_->prototypes, p, p + 1));
  const std::vector<Bounds> own = boundsOf(scene_->prototypes);
  for (const Instance& instance : scene_->instances)
    boxes_.push_back(boundsOf(instance, own[instance.prototype]));
}

TriangleTree::Tree::Tree(const std::vector<Mesh>& meshes, std::vector<Triangle> all)
    : triangles(std::move(all)) {
  const auto cornersOf = [&](const Triangle& triangle) {
    return PlacedMesh(meshes[triangle.mesh], nullptr).corners(triangle.index);
  };
  Bounds bounds;
  for (const Triangle& triangle : triangles)
    for (const glm::vec3& corner : cornersOf(triangle)) bounds.add(corner);
  const glm::vec2 low(bounds.min), size(bounds.size());
  const float extent = std::max(size.x, size.y);
  struct Entry {
    std::uint64_t key;
    Triangle triangle;
  };
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  for (const Triangle& triangle : triangles) {
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
  for (std::size_t n = 0; n < entries.size(); ++n) triangles[n] = entries[n].triangle;

  leaves = std::bit_ceil((triangles.size() + kLeafTriangles - 1) / kLeafTriangles);
  nodes.resize(2 * leaves);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    Node& leaf = nodes[leaves + n / kLeafTriangles];
    const auto corners = cornersOf(triangles[n]);
    for (const glm::vec3& corner : corners) leaf.box.add(corner);
    leaf.withArea += hasArea(corners) ? 1 : 0;
  }
  for (std::size_t n = leaves; n-- > 1;) {
    const Node &a = nodes[2 * n], &b = nodes[2 * n + 1];
    nodes[n] = {{glm::min(a.box.min, b.box.min), glm::max(a.box.max, b.box.max)}, a.withArea + b.withArea};
  }
}

/// One count. An edge is open while what is below the node may lie on both sides of it.
class TriangleTree::Query {
 public:
  explicit Query(const ConvexPolygon& polygon) : polygon_(polygon), clipper_(polygon) {
    require(polygon.size() <= 64, "a region's polygon has at most 64 corners");
  }

  /// `at`: where the meshes stand; null: as they are.
  std::size_t count(const Tree& tree, const std::vector<Mesh>& meshes, const Instance* at) {
    tree_ = &tree, meshes_ = &meshes, at_ = at;
    if (polygon_.size() < 3 || tree.triangles.empty()) return 0;
    return count(1, ~std::uint64_t(0) >> (64 - polygon_.size()));
  }

  /// May some of it lie inside?
  bool meets(const Bounds& box) const {
    std::uint64_t open = ~std::uint64_t(0) >> (64 - polygon_.size());
    return !box.empty() && narrow(box, open);
  }

 private:
  std::size_t count(std::size_t node, std::uint64_t open) {
    const Node& here = tree_->nodes[node];
    if (here.withArea == 0) return 0;
    if (!narrow(at_ == nullptr ? here.box : boundsOf(*at_, here.box), open)) return 0;
    if (open == 0) return here.withArea;
    if (node < tree_->leaves) return count(2 * node, open) + count(2 * node + 1, open);
    const std::size_t first = (node - tree_->leaves) * kLeafTriangles;
    std::size_t sum = 0;
    for (std::size_t n = first; n < std::min(first + kLeafTriangles, tree_->triangles.size()); ++n) {
      const Triangle& t = tree_->triangles[n];
      sum += countTriangle(PlacedMesh((*meshes_)[t.mesh], at_ == nullptr ? nullptr : &at_->worldFromPrototype)
                               .corners(t.index),
                           open);
    }
    return sum;
  }

  /// Closes the edges that the box lies inside of; false if it lies outside of one.
  bool narrow(const Bounds& here, std::uint64_t& open) const {
    for (std::uint64_t left = open; left != 0; left &= left - 1) {
      const int e = std::countr_zero(left);
      const auto [a, b] = edge(e);
      // The box's corners that lie farthest to the left and to the right of the edge.
      const bool up = b.x > a.x, leftwards = b.y > a.y;
      const glm::dvec2 innermost(leftwards ? here.min.x : here.max.x, up ? here.max.y : here.min.y);
      const glm::dvec2 outermost(leftwards ? here.max.x : here.min.x, up ? here.min.y : here.max.y);
      if (orientation(a, b, innermost) < 0) return false;
      if (orientation(a, b, outermost) >= 0) open &= ~(std::uint64_t(1) << e);
    }
    return true;
  }

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

  const Tree* tree_ = nullptr;
  const std::vector<Mesh>* meshes_ = nullptr;
  const Instance* at_ = nullptr;
  const ConvexPolygon& polygon_;
  PolygonClipper clipper_;
};

std::size_t TriangleTree::countClipped(const ConvexPolygon& polygon) const {
  if (polygon.size() < 3) return 0;
  Query query(polygon);
  std::size_t sum = query.count(meshes_, scene_->meshes, nullptr);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    if (query.meets(boxes_[i]))
      sum += query.count(prototypes_[instance.prototype], scene_->prototypes, &instance);
  }
  return sum;
}

}  // namespace acentric
