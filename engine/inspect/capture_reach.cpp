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
  struct Exit {
    double horizontal = 0;  ///< metres
    std::size_t role = 0;
  };
  glm::dvec3 origin{0}, direction{0};
  double flat = 1;          ///< horizontal metres per metre of ray
  std::vector<Exit> exits;  ///< sorted, up to the place asked for

  glm::dvec3 at(double distance) const { return origin + distance * direction; }
};

CaptureReach::CaptureReach(const Layout& layout, std::vector<ColumnCamera> columns, int maxLayers,
                           const OpaqueTracer& tracer, const CaptureSight* sight)
    : layout_(layout), columns_(std::move(columns)), maxLayers_(maxLayers), tracer_(tracer), sight_(sight) {
  require(columns_.size() == layout.cameras.size(), "every camera of the layout has its columns");
}

/// False where the camera has no ray, or its ray reaches `horizontal` metres before it left any region.
bool CaptureReach::wayTo(int camera, const glm::dvec3& direction, double horizontal, int role,
                         Way& way) const {
  const ColumnCamera& columns = columns_[std::size_t(camera)];
  way.origin = columns.centreOfProjection;
  way.direction = direction;
  way.flat = glm::length(glm::dvec2(direction));
  if (!(way.flat > 0)) return false;
  const double elevation = std::atan2(direction.z, way.flat);
  if (elevation > columns.topElevation || elevation < columns.bottomElevation) return false;
  const LayoutCamera& served = layout_.cameras[std::size_t(camera)];
  const std::uint8_t wanted = roleBit(served, role);
  for (std::size_t r = 0; r < served.roles.size(); ++r) {
    if ((roleBit(served, int(r)) & wanted) == 0) continue;
    const double exit = exitDistance(served, served.roles[r], glm::dvec2(direction) / way.flat);
    if (exit <= horizontal * (1 + kBorderSlack)) way.exits.push_back({exit, r});
  }
  std::ranges::sort(way.exits, {}, &Way::Exit::horizontal);
  return !way.exits.empty();
}

/// Are the layers of the bake's march used up before it comes to `distance` metres along the ray? Of the
/// roles that need the place, the one left last has the fewest surfaces in front of it.
bool CaptureReach::endsBefore(const Way& way, double distance) const {
  double from = way.exits.back().horizontal / way.flat;
  for (int layers = 0;;) {
    const OpaqueHit hit = tracer_.trace(way.origin, way.direction, from, distance);
    if (!hit.found()) return false;
    if (++layers >= maxLayers_) return true;
    from = hit.distance * (1 + kSameSurface) + roundingAt(way.at(hit.distance));
  }
}

/// All that lies along a way, behind each other, metres.
std::vector<OpaqueHit> CaptureReach::surfacesAlong(const Way& way, double from, double farthest) const {
  std::vector<OpaqueHit> met;
  while (true) {
    const OpaqueHit hit = tracer_.trace(way.origin, way.direction, from, farthest);
    if (!hit.found()) return met;
    met.push_back(hit);
    from = hit.distance * (1 + kSameSurface) + roundingAt(way.at(hit.distance));
  }
}

/// Which of the surfaces that the march for a role meets it keeps, from `nearest` metres on.
std::vector<OpaqueHit> CaptureReach::keptAmong(int camera, std::size_t role, const Way& way,
                                               const std::vector<OpaqueHit>& met, double nearest) const {
  const Role& served = layout_.cameras[std::size_t(camera)].roles[role];
  const double rightBehind = sight_ == nullptr ? 0 : sight_->rightBehind(camera);
  // What lies before counts only where layers may be used up.
  const double first = int(met.size()) > maxLayers_ ? 0 : nearest * (1 - rightBehind);
  std::vector<OpaqueHit> kept;
  double last = -1;
  for (int layers = 0; const OpaqueHit& hit : met) {
    if (hit.distance < first || hit.distance * (1 - rightBehind) <= last) continue;
    const glm::dvec3 point = way.at(hit.distance);
    if (served.clip && !served.clip->holds(glm::dvec2(point))) continue;
    if (sight_ != nullptr && !sight_->keeps(camera, role, point, hit, way.direction)) continue;
    last = hit.distance;
    if (hit.distance >= nearest) kept.push_back(hit);
    if (++layers >= maxLayers_) break;
  }
  return kept;
}

/// Does the march for a role, from where its grown region ends, keep the surface at `distance`, or one so
/// little before it that it passes for it?
bool CaptureReach::keptFor(int camera, std::size_t role, const Way& way, double from, double distance) const {
  const double rounding = roundingAt(way.at(distance));
  std::vector<OpaqueHit> met = surfacesAlong(way, from, distance * (1 + kSameSurface) + rounding);
  if (met.empty() || met.back().distance < distance * (1 - kSameSurface) - rounding)
    met.push_back({distance, -way.direction});  // the point's own
  return !keptAmong(camera, role, way, met, distance * (1 - sight_->rightBehind(camera)) - rounding).empty();
}

bool CaptureReach::holds(int camera, const glm::dvec3& point, int role) const {
  const glm::dvec3 offset = point - columns_[std::size_t(camera)].centreOfProjection;
  const double distance = glm::length(offset);
  if (!(distance > 0)) return false;
  Way way;
  if (!wayTo(camera, offset / distance, glm::length(glm::dvec2(offset)), role, way)) return false;
  if (sight_ != nullptr)
    return std::ranges::any_of(way.exits, [&](const Way::Exit& exit) {
      return keptFor(camera, exit.role, way, exit.horizontal / way.flat, distance);
    });
  return !endsBefore(way, distance * (1 - kSameSurface) - roundingAt(point));
}

bool CaptureReach::holdsSky(int camera, const glm::dvec3& direction, int role) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double elevation = std::asin(std::clamp(direction.z, -1.0, 1.0));
  const ColumnCamera& columns = columns_[std::size_t(camera)];
  if (elevation > columns.topElevation || elevation < columns.bottomElevation) return true;
  Way way;
  if (!wayTo(camera, direction, kInfinity, role, way)) return false;
  if (sight_ == nullptr) return !endsBefore(way, kInfinity);
  return std::ranges::any_of(
      way.exits, [&](const Way::Exit& exit) { return sight_->keepsSky(camera, exit.role, direction); });
}

std::vector<Cover> drawnCovers(const Layout& layout, int region) {
  std::vector<Cover> covers = layout.regions[std::size_t(region)].covers;
  for (Cover& panorama : layout.panoramasFor(region)) covers.push_back(std::move(panorama));
  return covers;
}

const Piece* pieceAt(const Cover& cover, const glm::dvec2& place) {
  const auto found = std::ranges::find_if(cover.pieces, [&](const Piece& p) { return p.holds(place); });
  return found == cover.pieces.end() ? nullptr : &*found;
}

}  // namespace acentric
