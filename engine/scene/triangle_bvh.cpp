#include "engine/scene/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace acentric {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

double squaredDistance(const glm::vec3& min, const glm::vec3& max, const glm::dvec3& p) {
  const glm::dvec3 outside = glm::max(glm::max(glm::dvec3(min) - p, p - glm::dvec3(max)), glm::dvec3(0));
  return glm::dot(outside, outside);
}

}  // namespace

glm::dvec3 pointOn(const std::array<glm::dvec3, 3>& t, const glm::dvec2& w) {
  return t[0] * (1 - w.x - w.y) + t[1] * w.x + t[2] * w.y;
}

glm::dvec2 nearestOnTriangle(const std::array<glm::dvec3, 3>& t, const glm::dvec3& point) {
  const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0], p = point - t[0];
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), pu = glm::dot(p, u),
               pv = glm::dot(p, v), det = uu * vv - uv * uv;
  if (det > 1e-14 * uu * vv) {
    const glm::dvec2 inside((vv * pu - uv * pv) / det, (uu * pv - uv * pu) / det);
    if (inside.x >= 0 && inside.y >= 0 && inside.x + inside.y <= 1) return inside;
  }
  // On the nearest of the three edges.
  glm::dvec2 best(0);
  double least = std::numeric_limits<double>::infinity();
  constexpr glm::dvec2 kWeights[3]{{0, 0}, {1, 0}, {0, 1}};
  for (int i = 0; i < 3; ++i) {
    const std::size_t a = std::size_t(i), b = std::size_t((i + 1) % 3);
    const glm::dvec3 edge = t[b] - t[a];
    const double length = glm::dot(edge, edge);
    const double along = length > 0 ? std::clamp(glm::dot(point - t[a], edge) / length, 0.0, 1.0) : 0;
    const glm::dvec3 offset = point - (t[a] + along * edge);
    if (const double d = glm::dot(offset, offset); d < least)
      least = d, best = glm::mix(kWeights[a], kWeights[b], along);
  }
  return best;
}

TriangleBvh::TriangleBvh(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(triangles_.size());
  if (!triangles_.empty()) build(0, std::uint32_t(order_.size()));
}

std::uint32_t TriangleBvh::build(std::uint32_t first, std::uint32_t last) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Node node{glm::vec3(kFar), glm::vec3(-kFar), first, last - first};
  glm::vec3 low(kFar), high(-kFar);
  const auto middle = [&](std::uint32_t t) { return triangles_[t][0] + triangles_[t][1] + triangles_[t][2]; };
  for (std::uint32_t n = first; n < last; ++n) {
    for (const glm::vec3& corner : triangles_[order_[n]])
      node.min = glm::min(node.min, corner), node.max = glm::max(node.max, corner);
    low = glm::min(low, middle(order_[n])), high = glm::max(high, middle(order_[n]));
  }
  const auto index = std::uint32_t(nodes_.size());
  nodes_.push_back(node);
  if (node.count <= kLeafTriangles) return index;
  const glm::vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = first + node.count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a)[axis] < middle(b)[axis]; });
  build(first, half);
  const std::uint32_t right = build(half, last);
  nodes_[index].first = right;
  nodes_[index].count = 0;
  return index;
}

TriangleBvh::Nearest TriangleBvh::nearest(const glm::dvec3& point, double limit,
                                          const std::function<bool(std::uint32_t)>& admits) const {
  Nearest best;
  if (nodes_.empty()) return best;
  double least = limit * limit;
  struct Waiting {
    std::uint32_t node;
    double distance;
  };
  std::array<Waiting, 64> stack;  // the tree is halved at each level: depth below 33
  std::size_t waiting = 0;
  stack[waiting++] = {0, squaredDistance(nodes_[0].min, nodes_[0].max, point)};
  while (waiting > 0) {
    const Waiting here = stack[--waiting];
    if (here.distance > least) continue;
    const Node& node = nodes_[here.node];
    if (node.count == 0) {
      Waiting near{here.node + 1,
                   squaredDistance(nodes_[here.node + 1].min, nodes_[here.node + 1].max, point)};
      Waiting far{node.first, squaredDistance(nodes_[node.first].min, nodes_[node.first].max, point)};
      if (far.distance < near.distance) std::swap(near, far);
      stack[waiting++] = far;
      stack[waiting++] = near;
      continue;
    }
    for (std::uint32_t n = node.first; n < node.first + node.count; ++n) {
      const std::uint32_t t = order_[n];
      if (admits && !admits(t)) continue;
      const std::array<glm::dvec3, 3> corners{triangles_[t][0], triangles_[t][1], triangles_[t][2]};
      const glm::dvec2 weights = nearestOnTriangle(corners, point);
      const glm::dvec3 offset = pointOn(corners, weights) - point;
      if (const double d = glm::dot(offset, offset); d <= least && (d < least || !best.found()))
        least = d, best = {t, weights, std::sqrt(d)};
    }
  }
  return best;
}

}  // namespace acentric
