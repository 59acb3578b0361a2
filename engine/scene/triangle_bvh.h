#pragma once
/// Finds the nearest point of many triangles: a tree of boxes, built once. Immutable and thread-safe.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace acentric {

/// Weights of the 2nd and 3rd corner of the triangle's point nearest to `point`.
glm::dvec2 nearestOnTriangle(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point);
/// The point with these weights.
glm::dvec3 pointOn(const std::array<glm::dvec3, 3>& triangle, const glm::dvec2& weights);

class TriangleBvh {
 public:
  using Corners = std::array<glm::vec3, 3>;
  struct Nearest {
    std::uint32_t triangle = kNone;  ///< as given to the constructor
    glm::dvec2 weights{0};           ///< of its 2nd and 3rd corner
    double distance = std::numeric_limits<double>::infinity();
    bool found() const { return triangle != kNone; }
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  explicit TriangleBvh(std::vector<Corners> triangles);

  /// Among the triangles that `admits` (all, if empty), no farther than `limit`.
  Nearest nearest(const glm::dvec3& point, double limit = std::numeric_limits<double>::infinity(),
                  const std::function<bool(std::uint32_t)>& admits = {}) const;
  const Corners& triangle(std::uint32_t index) const { return triangles_[index]; }

 private:
  struct Node {
    glm::vec3 min, max;
    std::uint32_t first = 0;  ///< leaf: into order_; else the right child (the left one follows the node)
    std::uint32_t count = 0;  ///< 0: no leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<Corners> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace acentric
