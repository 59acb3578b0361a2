#include "engine/inspect/capture_reach.h"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"

namespace acentric {
namespace {

/// As the bake: a surface on a region's border belongs to both sides.
constexpr double kBorderSlack = 1e-6;
/// Ray tracing is done in single precision: a surface this share nearer is the point's own.
constexpr double kSameSurface = 5e-5;

/// Rounding of single-precision coordinates of this size, with room.
double roundingAt(const glm::dvec3& p) {
  return 4e-7 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

bool hidden(const OpaqueTracer& tracer, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double distance = glm::length(way);
  const double farthest = distance * (1 - kSameSurface) - roundingAt(to);
  if (!(farthest > 0)) return false;
  return tracer.trace(from, way / distance, 0, farthest).found();
}

/// A ray from a centre of projection, and where it leaves the served regions on its way.
struct CaptureReach::Way {
  glm::dvec3 origin{0}, direction{0};
  double flat = 1;            ///< horizontal metres per metre of ray
  std::vector<double> exits;  ///< horizontal distances, sorted, up to the place asked for
};

CaptureReach::CaptureReach(const Layout& layout, std::vector<ColumnCamera> columns, int maxLayers,
                           const OpaqueTracer& tracer)
    : layout_(layout), columns_(std::move(columns)), maxLayers_(maxLayers), tracer_(tracer) {
  require(columns_.size() == layout.cameras.size(), "every camera of the layout has its columns");
}

/// False where the camera has no ray, or its ray reaches `horizontal` metres before it left any region.
bool CaptureReach::wayTo(int camera, const glm::dvec3& direction, double horizontal, Way& way) const {
  const ColumnCamera& columns = columns_[std::size_t(camera)];
  way.origin = columns.centreOfProjection;
  way.direction = direction;
  way.flat = glm::length(glm::dvec2(direction));
  if (!(way.flat > 0)) return false;
  const double elevation = std::atan2(direction.z, way.flat);
  if (elevation > columns.topElevation || elevation < columns.bottomElevation) return false;
  const LayoutCamera& served = layout_.cameras[std::size_t(camera)];
  for (const Role& role : served.roles) {
    const double exit = exitDistance(served, role, glm::dvec2(direction) / way.flat);
    if (exit <= horizontal * (1 + kBorderSlack)) way.exits.push_back(exit);
  }
  std::ranges::sort(way.exits);
  return !way.exits.empty();
}

/// Are the layers of the bake's march used up before it comes to `distance` metres along the ray? Of the
/// roles that need the place, the one left last has the fewest surfaces in front of it.
bool CaptureReach::endsBefore(const Way& way, double distance) const {
  double from = way.exits.back() / way.flat;
  for (int layers = 0;;) {
    const OpaqueHit hit = tracer_.trace(way.origin, way.direction, from, distance);
    if (!hit.found()) return false;
    if (++layers >= maxLayers_) return true;
    from = hit.distance * (1 + kSameSurface) + roundingAt(way.origin + hit.distance * way.direction);
  }
}

bool CaptureReach::holds(int camera, const glm::dvec3& point) const {
  const glm::dvec3 offset = point - columns_[std::size_t(camera)].centreOfProjection;
  const double distance = glm::length(offset);
  if (!(distance > 0)) return false;
  Way way;
  if (!wayTo(camera, offset / distance, glm::length(glm::dvec2(offset)), way)) return false;
  return !endsBefore(way, distance * (1 - kSameSurface) - roundingAt(point));
}

bool CaptureReach::holdsSky(int camera, const glm::dvec3& direction) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double elevation = std::asin(std::clamp(direction.z, -1.0, 1.0));
  const ColumnCamera& columns = columns_[std::size_t(camera)];
  if (elevation > columns.topElevation || elevation < columns.bottomElevation) return true;
  Way way;
  return wayTo(camera, direction, kInfinity, way) && !endsBefore(way, kInfinity);
}

std::vector<Cover> drawnCovers(const Layout& layout, int region) {
  std::vector<Cover> covers = layout.regions[std::size_t(region)].covers;
  for (Cover& panorama : layout.panoramasFor(region)) covers.push_back(std::move(panorama));
  return covers;
}

int cameraAt(const Cover& cover, const glm::dvec2& place) {
  for (const Piece& piece : cover.pieces)
    if (piece.holds(place)) return piece.camera;
  return -1;
}

}  // namespace acentric
