#include "engine/pipeline/local_triangles.h"

#include <array>
#include <atomic>
#include <limits>

#include "engine/bake/test_eyes.h"
#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

using Corners = std::array<glm::vec3, 3>;

/// Calls `found` with the number of each triangle that the region draws, its mesh and its corners.
template <class Found>
void eachLocal(const DrawnScene& drawn, const Region& region, const std::stop_token& stop,
               const Found& found) {
  PolygonClipper clipper(region.grown);
  std::size_t next = 0;
  for (std::size_t m = 0; m < drawn.scene().meshes.size(); ++m) {
    if (stop.stop_requested()) return;
    const Mesh& mesh = drawn.scene().meshes[m];
    const std::size_t first = next;
    next += mesh.triangles.size();
    if (clipper.misses(drawn.boxes()[m])) continue;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& triangle = mesh.triangles[t];
      const Corners corners{mesh.positions[triangle.x], mesh.positions[triangle.y],
                            mesh.positions[triangle.z]};
      if (clipper.leavesArea(corners)) found(first + t, mesh, corners);
    }
  }
}

/// Eyes of a region that look at the backs of triangles.
class BackViews {
 public:
  BackViews(const RayScene& rays, const ConvexPolygon& polygon, double eyeZ) : rays_(rays) {
    BakeSettings settings;
    settings.testEyes = 48, settings.eyeRange = 0;
    for (const glm::dvec3& eye : placedEyes(polygon, eyeZ, settings)) eyes_.emplace_back(eye);
  }

  /// Does one see the back, each at another place of it?
  bool seeBackOf(const Corners& corners) const {
    const glm::vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
      if (!(glm::dot(across, eyes_[e] - corners[0]) < 0)) continue;
      glm::vec2 b = glm::fract(glm::vec2(0.5f) + float(e) * glm::vec2(0.7548777f, 0.5698403f));
      if (b.x + b.y > 1) b = 1.0f - b;
      b = glm::mix(b, glm::vec2(1.0f / 3), kFromEdges);
      const glm::vec3 way =
          corners[0] + b.x * (corners[1] - corners[0]) + b.y * (corners[2] - corners[0]) - eyes_[e];
      const float distance = glm::length(way), farthest = distance * (1 - kTolerance);
      if (!(rays_.occluderDistance({eyes_[e], way / distance, 0, farthest}) < farthest)) return true;
    }
    return false;
  }

 private:
  static constexpr float kTolerance = 2e-4f;  ///< of a distance
  static constexpr float kFromEdges = 0.01f;  ///< an edge of a solid is seen, its inside is not
  const RayScene& rays_;
  std::vector<glm::vec3> eyes_;
};

}  // namespace

std::vector<std::uint8_t> localTrianglesOf(const DrawnScene& drawn, const Region& region,
                                           const std::stop_token& stop) {
  std::vector<std::uint8_t> local(drawn.scene().triangleCount(), 0);
  eachLocal(drawn, region, stop, [&](std::size_t t, const Mesh&, const Corners&) { local[t] = 1; });
  return local;
}

LocalTriangles localTrianglesOf(const RayScene& rays, const DrawnScene& drawn, const Layout& layout,
                                TaskRunner& runner, const std::stop_token& stop) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  const std::size_t count = drawn.scene().triangleCount();
  std::vector<std::uint32_t> firstRegion(count, kNone);
  std::vector<std::uint8_t> backSeen(count, 0);
  runner.parallelFor(layout.regions.size(), [&](std::size_t r) {
    const Region& region = layout.regions[r];
    const BackViews views(rays, region.polygon, layout.eyeZ());
    eachLocal(drawn, region, stop, [&](std::size_t t, const Mesh& mesh, const Corners& corners) {
      const std::atomic_ref first(firstRegion[t]);
      std::uint32_t was = first;
      while (r < was && !first.compare_exchange_weak(was, std::uint32_t(r))) continue;
      // Double-sided surfaces have light on their backs whoever sees them.
      if (stop.stop_requested() || rays.scene().materials[std::size_t(mesh.material)].doubleSided) return;
      const std::atomic_ref seen(backSeen[t]);
      if (seen == 0 && views.seeBackOf(corners)) seen = 1;
    });
  });
  LocalTriangles out{std::vector<LightSides>(count, LightSides::none),
                     std::vector<glm::vec3>(count, glm::vec3(0))};
  for (std::size_t t = 0; t < count; ++t) {
    if (firstRegion[t] == kNone) continue;
    const glm::dvec2 centre = layout.regions[firstRegion[t]].polygon.centroid();
    out.wanted[t] = backSeen[t] != 0 ? LightSides::both : LightSides::front;
    out.viewer[t] = glm::vec3(glm::dvec3(centre, layout.eyeZ()));
  }
  return out;
}

}  // namespace acentric
