#pragma once
/// Triangles of a surface in groups that lie flat enough to be drawn as one picture: charts. Neighbours by an
/// edge of one kind whose normals are within kMostBend of the chart's make one chart, as long as no two of
/// them overlap on its plane. One with much room around its triangles, such as a frame, is cut in two,
/// between triangles, as often as that saves a quarter of the room.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace acentric {

/// Between a triangle's normal and its chart's: a picture is at most 1 / cos(kMostBend) = 1.10 times as
/// coarse on the surface as on its plane.
inline constexpr double kMostBend = 0.436;                ///< radians, 25 degrees
inline constexpr double kWeld = 1e-4;                     ///< metres: corners of a cell this wide are one
inline constexpr std::size_t kMostChartTriangles = 4096;  ///< each is checked against all of its chart

struct SurfaceTriangle {
  std::array<glm::vec3, 3> corners;
  std::uint32_t kind = 0;  ///< only triangles of one kind share a chart
};

/// A plane with triangles on it. `across` is the longer side of the rectangle around them.
struct SurfaceChart {
  glm::dvec3 origin{0};  ///< the rectangle's corner
  glm::dvec3 across{1, 0, 0}, down{0, 1, 0};
  glm::dvec2 size{0};                    ///< of the rectangle, metres; may be 0
  std::vector<std::uint32_t> triangles;  ///< of those given

  glm::dvec2 place(const glm::dvec3& position) const {
    return {glm::dot(across, position - origin), glm::dot(down, position - origin)};
  }
};

/// Each triangle is in one chart. Those without an area are charts of their own.
std::vector<SurfaceChart> chartsOf(std::span<const SurfaceTriangle> triangles);

/// Do two triangles on a plane share more than a border? Both wind the same way round.
bool overlap(const std::array<glm::dvec2, 3>& a, const std::array<glm::dvec2, 3>& b);

}  // namespace acentric
