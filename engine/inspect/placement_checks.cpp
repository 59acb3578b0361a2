#include "engine/inspect/placement_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>

#include "engine/inspect/camera_sight.h"
#include "engine/inspect/standing.h"

namespace acentric {
namespace {

constexpr double kTouching = 0.25;       // share of cameraRoom below which a camera sees almost nothing else
constexpr double kPushStep = 0.05;       // metres
constexpr double kPushAccuracy = 0.005;  // metres
constexpr int kPushSides = 24;
constexpr int kPlacesAcross = 8;            // of a region, where standing room is looked for
constexpr std::size_t kPlacesSeenFrom = 5;  // of a region's standing room, spread over it
constexpr double kNeighbours = 3;           // cells: how far centres look for others of the same space
constexpr double kHeadAboveEye = 0.15;
constexpr double kSeemInside = 0.8;  // share of the centres from which sides are not trusted

std::string wayOf(const glm::dvec3& direction) {
  if (direction.z > 0.99) return "straight above it";
  if (direction.z < -0.99) return "straight below it";
  const double azimuth = degrees(wrapAngle(std::atan2(direction.y, direction.x)));
  return fmt::format("towards {:.0f} degrees{}", azimuth,
                     direction.z > 0.1    ? " and up"
                     : direction.z < -0.1 ? " and down"
                                          : "");
}

class Checker {
 public:
  Checker(const Layout& layout, const Bounds& bounds, const PlacementRules& rules, const SurfaceProbe& probe,
          bool trustSides, std::vector<bool> insideOfCamera)
      : layout_(layout),
        bounds_(bounds),
        rules_(rules),
        probe_(probe),
        trustSides_(trustSides),
        insideOfCamera_(std::move(insideOfCamera)) {}

  std::vector<PlacementFinding> check(const CameraCentre& centre, const Surroundings& around,
                                      bool inside) const {
    std::vector<PlacementFinding> found;
    const auto add = [&](PlacementFlaw flaw, Severity severity, std::string reason) {
      found.push_back({flaw, severity, centre.cameras, -1, centre.position, std::move(reason), {}});
    };
    if (trustSides_ && inside)
      add(PlacementFlaw::insideSolid, Severity::error,
          fmt::format(
              "it is inside a solid: {} of {} directions meet the back of a surface first, and {} cross "
              "an odd number of surfaces",
              around.backs, around.directions, around.odd));
    if (around.nearest < rules_.cameraRoom)
      add(PlacementFlaw::tooNear,
          around.nearest < kTouching * rules_.cameraRoom ? Severity::error : Severity::warning,
          fmt::format("a surface is {:.2f} m away {}; {:.2f} m are asked for", around.nearest,
                      wayOf(around.towards), rules_.cameraRoom));
    const double walkPlane = layout_.spec.floorHeight;
    if (!around.floor)
      add(PlacementFlaw::noFloor, Severity::warning, "nothing is below it");
    else if (*around.floor > walkPlane + rules_.floorTolerance)
      add(PlacementFlaw::floorTooHigh, Severity::note,
          fmt::format("what is below it lies {:.2f} m above the walk plane", *around.floor - walkPlane));
    else if (*around.floor < walkPlane - rules_.floorTolerance)
      add(PlacementFlaw::floorTooLow, Severity::warning,
          fmt::format("the floor below it lies {:.2f} m below the walk plane", walkPlane - *around.floor));
    if (std::ranges::any_of(found, [](const auto& f) { return f.severity != Severity::note; })) {
      const auto push = smallestPush(centre.position, around);
      for (PlacementFinding& finding : found)
        if (finding.severity != Severity::note) finding.push = push;
    }
    return found;
  }

  std::optional<PlacementFinding> checkRegion(int index) const {
    const Region& region = layout_.regions[std::size_t(index)];
    const std::vector<glm::dvec2> places = placesIn(region);
    if (std::ranges::any_of(places, [&](const auto& place) { return canStandAt(place, region); }))
      return std::nullopt;
    return PlacementFinding{
        PlacementFlaw::noStandingRoom,
        Severity::warning,
        {},
        index,
        places.front(),
        fmt::format("none of {} places in it has a floor within {:.2f} m of the walk plane, {:.2f} m of head "
                    "room and {:.2f} m to the sides",
                    places.size(), rules_.floorTolerance, layout_.spec.eyeHeight + kHeadAboveEye,
                    rules_.wallClearance),
        {}};
  }

  /// Where a panorama in the region would stand free: as near to its middle as can be.
  std::optional<glm::dvec2> placeForPanorama(const Region& region) const {
    std::vector<glm::dvec2> places = placesIn(region);
    std::ranges::stable_sort(places, {}, [middle = places.front()](const glm::dvec2& place) {
      return glm::distance(place, middle);
    });
    const auto found = std::ranges::find_if(
        places, [&](const glm::dvec2& place) { return isClear(place) && canStandAt(place, region); });
    return found == places.end() ? std::nullopt : std::optional(*found);
  }

  /// What the region's cameras show of what is seen where one can stand in it.
  std::map<int, CameraSight> lookFrom(const Region& region) const {
    std::vector<glm::dvec2> standing = placesIn(region);
    std::erase_if(standing, [&](const auto& place) { return !canStandAt(place, region); });
    std::vector<glm::dvec2> some;
    const std::size_t step = standing.size() / kPlacesSeenFrom + 1;
    for (std::size_t k = 0; k < standing.size(); k += step) some.push_back(standing[k]);
    return acentric::lookFrom(some, layout_, region, bounds_, probe_);
  }

 private:
  /// Places spread over a region, its middle first.
  static std::vector<glm::dvec2> placesIn(const Region& region) {
    glm::dvec2 low = region.polygon.corners.front(), high = low;
    for (const glm::dvec2& corner : region.polygon.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
    std::vector<glm::dvec2> places{region.polygon.centroid()};
    for (int i = 0; i < kPlacesAcross; ++i)
      for (int j = 0; j < kPlacesAcross; ++j) {
        const glm::dvec2 place = low + (high - low) * glm::dvec2(i + 0.5, j + 0.5) / double(kPlacesAcross);
        if (region.polygon.containsClosed(place)) places.push_back(place);
      }
    return places;
  }

  bool canStandAt(const glm::dvec2& place, const Region& region) const {
    const double headRoom = layout_.spec.eyeHeight + kHeadAboveEye;
    StandingRules standing;
    standing.eyeHeight = layout_.spec.eyeHeight;
    standing.wallClearance = rules_.wallClearance;
    StandingRules anySide = standing;
    anySide.refuseInside = false;
    return std::ranges::any_of(floorLevelsAt(place, bounds_, headRoom, probe_), [&](const FloorLevel& level) {
      return std::abs(double(level.height) - layout_.spec.floorHeight) <= rules_.floorTolerance &&
             (canStand(place, level, standing, probe_) ||
              (canStand(place, level, anySide, probe_) &&
               (!trustSides_ || seesCameraOutside(place, region))));
    });
  }

  /// Some places seem to be inside a solid where walls are wound the other way; not what a camera sees that
  /// is outside.
  bool seesCameraOutside(const glm::dvec2& place, const Region& region) const {
    const glm::dvec3 eye(place, layout_.eyeZ());
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) {
        const glm::dvec2 way = piece.apex - place;
        const double length = glm::length(way);
        if (insideOfCamera_[std::size_t(piece.camera)] || !(length > 0)) continue;
        if (!(probe_(eye, glm::dvec3(way / length, 0)).distance < length)) return true;
      }
    return false;
  }

  bool isClear(const glm::dvec2& place) const {
    const glm::dvec3 eye(place, layout_.eyeZ());
    if (!hasRoom(eye, rules_.cameraRoom, probe_)) return false;
    const Surroundings around = lookAround(eye, probe_);
    if (trustSides_ && around.inside()) return false;
    return around.floor && *around.floor >= layout_.spec.floorHeight - rules_.floorTolerance;
  }

  /// Rings of growing radius; within a ring, away from the nearest surface first.
  std::optional<glm::dvec2> smallestPush(const glm::dvec2& place, const Surroundings& around) const {
    const double away = std::atan2(-around.towards.y, -around.towards.x);
    for (double radius = kPushStep; radius <= rules_.mostPush + 1e-9; radius += kPushStep)
      for (int k = 0; k < kPushSides; ++k) {
        const int turn = k % 2 == 0 ? k / 2 : -(k + 1) / 2;  // 0, -1, 1, -2, 2 ...
        const glm::dvec2 direction = directionOf(away + kTwoPi * turn / kPushSides);
        if (!isClear(place + radius * direction)) continue;
        double blocked = radius - kPushStep, free = radius;
        while (free - blocked > kPushAccuracy) {
          const double middle = 0.5 * (blocked + free);
          (isClear(place + middle * direction) ? free : blocked) = middle;
        }
        return free * direction;
      }
    return std::nullopt;
  }

  const Layout& layout_;
  const Bounds& bounds_;
  const PlacementRules& rules_;
  const SurfaceProbe& probe_;
  bool trustSides_;
  std::vector<bool> insideOfCamera_;  ///< per Layout::cameras
};

/// Which centres are inside a solid. Where one sees freely to another, both are in the same space, so a space
/// is inside a solid where most of its centres seem to be: models are wound the other way in places.
std::vector<bool> findInside(const std::vector<CameraCentre>& centres,
                             const std::vector<Surroundings>& around, const Layout& layout,
                             const SurfaceProbe& probe) {
  std::vector<bool> inside(centres.size(), false);
  if (std::ranges::none_of(around, &Surroundings::inside)) return inside;
  std::vector<std::size_t> parent(centres.size());
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto spaceOf = [&](std::size_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const double reach = kNeighbours * layout.spec.cellSize;
  for (std::size_t a = 0; a < centres.size(); ++a)  // in order of x
    for (std::size_t b = a + 1; b < centres.size() && centres[b].position.x - centres[a].position.x <= reach;
         ++b) {
      const glm::dvec2 way = centres[b].position - centres[a].position;
      const double length = glm::length(way);
      if (length > reach || spaceOf(a) == spaceOf(b)) continue;
      const glm::dvec3 from(centres[a].position, layout.eyeZ());
      if (probe(from, glm::dvec3(way / length, 0)).distance >= length) parent[spaceOf(b)] = spaceOf(a);
    }
  std::vector<int> vote(centres.size(), 0);
  for (std::size_t c = 0; c < centres.size(); ++c) vote[spaceOf(c)] += around[c].inside() ? 1 : -1;
  for (std::size_t c = 0; c < centres.size(); ++c) inside[c] = vote[spaceOf(c)] > 0;
  return inside;
}

/// A camera from which hardly anything is hidden that it is to show is none to mend, wherever it stands; of
/// others it says where a panorama would help.
void judgeBySight(PlacementReport& report, const Layout& layout, const Checker& checker, TaskRunner& runner,
                  const std::stop_token& stop) {
  std::vector<bool> asked(layout.cameras.size(), false);
  for (const PlacementFinding& finding : report.findings)
    for (const int camera : finding.cameras)
      if (finding.severity != Severity::note) asked[std::size_t(camera)] = true;
  std::vector<std::size_t> regions;
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    if (std::ranges::any_of(layout.regions[r].covers, [&](const Cover& cover) {
          return std::ranges::any_of(cover.pieces,
                                     [&](const Piece& p) { return asked[std::size_t(p.camera)]; });
        }))
      regions.push_back(r);
  std::vector<std::map<int, CameraSight>> sights(regions.size());
  runner.parallelFor(regions.size(), [&](std::size_t k) {
    if (!stop.stop_requested()) sights[k] = checker.lookFrom(layout.regions[regions[k]]);
  });
  std::vector<CameraSight> ofCamera(layout.cameras.size());
  std::vector<std::pair<int, std::size_t>> hidden(layout.cameras.size());  // most from one region, and which
  for (std::size_t k = 0; k < regions.size(); ++k)
    for (const auto& [camera, sight] : sights[k]) {
      ofCamera[std::size_t(camera)].add(sight);
      hidden[std::size_t(camera)] = std::max(hidden[std::size_t(camera)], {sight.hidden, regions[k]});
    }
  for (PlacementFinding& finding : report.findings) {
    if (finding.severity == Severity::note || finding.cameras.empty()) continue;
    CameraSight sight;
    std::pair<int, std::size_t> most;
    for (const int camera : finding.cameras) {
      sight.add(ofCamera[std::size_t(camera)]);
      most = std::max(most, hidden[std::size_t(camera)]);
    }
    if (sight.suffices()) {
      finding.severity = Severity::note;
      finding.suffices = true;
      finding.push.reset();
    } else if (const Region& region = layout.regions[most.second];
               most.first > 0 && region.id.slot != kFreeSlot) {
      finding.panorama = checker.placeForPanorama(region);
    }
  }
}

}  // namespace

const char* nameOf(PlacementFlaw flaw) {
  switch (flaw) {
    case PlacementFlaw::insideSolid:
      return "insideSolid";
    case PlacementFlaw::tooNear:
      return "tooNear";
    case PlacementFlaw::noFloor:
      return "noFloor";
    case PlacementFlaw::floorTooHigh:
      return "floorTooHigh";
    case PlacementFlaw::floorTooLow:
      return "floorTooLow";
    case PlacementFlaw::noStandingRoom:
      return "noStandingRoom";
  }
  return "unknown";
}

const char* nameOf(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "unknown";
}

Status PlacementRules::check() const {
  for (const auto& [what, value] :
       {std::pair{"room around a camera", cameraRoom}, std::pair{"floor tolerance", floorTolerance},
        std::pair{"wall clearance", wallClearance}, std::pair{"farthest push", mostPush}})
    if (!(value >= 0 && value <= 100))
      return fail(ErrorKind::invalidArgument,
                  fmt::format("the {} is {} m; it must lie in 0..100 m", what, value), "placement");
  return {};
}

int PlacementReport::count(Severity severity) const {
  return static_cast<int>(std::ranges::count(findings, severity, &PlacementFinding::severity));
}

std::vector<CameraCentre> centresOf(const Layout& layout) {
  std::map<std::pair<double, double>, std::vector<int>> camerasAt;
  for (std::size_t c = 0; c < layout.cameras.size(); ++c) {
    const glm::dvec2& at = layout.cameras[c].position;
    camerasAt[{at.x, at.y}].push_back(static_cast<int>(c));
  }
  std::vector<CameraCentre> centres;
  centres.reserve(camerasAt.size());
  for (auto& [at, cameras] : camerasAt) centres.push_back({{at.first, at.second}, std::move(cameras)});
  return centres;
}

Result<PlacementReport> checkPlacement(const Layout& layout, const Bounds& bounds,
                                       const PlacementRules& rules, const SurfaceProbe& probe,
                                       TaskRunner& runner, std::stop_token stop) {
  if (Status sound = rules.check(); !sound) return tl::unexpected(sound.error());
  const std::vector<CameraCentre> centres = centresOf(layout);
  std::vector<Surroundings> around(centres.size());
  runner.parallelFor(centres.size(), [&](std::size_t c) {
    if (!stop.stop_requested()) around[c] = lookAround({centres[c].position, layout.eyeZ()}, probe);
  });
  const std::vector<bool> inside = findInside(centres, around, layout, probe);
  const auto insides = std::ranges::count(inside, true);
  PlacementReport report;
  report.centres = static_cast<int>(centres.size());
  report.regions = static_cast<int>(layout.regions.size());
  report.ignoredSides = insides > 0 && double(insides) >= kSeemInside * double(centres.size());

  std::vector<bool> insideOfCamera(layout.cameras.size(), false);
  for (std::size_t c = 0; c < centres.size(); ++c)
    for (const int camera : centres[c].cameras) insideOfCamera[std::size_t(camera)] = inside[c];
  const Checker checker(layout, bounds, rules, probe, !report.ignoredSides, std::move(insideOfCamera));
  std::vector<std::vector<PlacementFinding>> found(centres.size() + layout.regions.size());
  runner.parallelFor(found.size(), [&](std::size_t k) {
    if (stop.stop_requested()) return;
    if (k < centres.size())
      found[k] = checker.check(centres[k], around[k], inside[k]);
    else if (auto finding = checker.checkRegion(static_cast<int>(k - centres.size())))
      found[k].push_back(std::move(*finding));
  });
  if (stop.stop_requested())
    return fail(ErrorKind::cancelled, "the placement check was stopped", "placement");
  for (auto& some : found) std::ranges::move(some, std::back_inserter(report.findings));
  judgeBySight(report, layout, checker, runner, stop);
  std::ranges::stable_sort(report.findings, [](const PlacementFinding& a, const PlacementFinding& b) {
    return a.severity != b.severity ? a.severity > b.severity : a.flaw < b.flaw;
  });
  return report;
}

}  // namespace acentric
