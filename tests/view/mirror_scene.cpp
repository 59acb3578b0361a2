#include "tests/view/mirror_scene.h"

#include <cmath>
#include <limits>
#include <set>

namespace acentric::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where a ray meets a mirror, in units of its direction; infinity if it does not.
double distanceTo(const AnalyticMirror& mirror, const glm::dvec3& origin, const glm::dvec3& direction) {
  const double distance = (mirror.at - origin[mirror.axis]) / direction[mirror.axis];
  if (!(distance > 0) || !std::isfinite(distance)) return kInfinity;
  const glm::dvec3 point = origin + distance * direction;
  const glm::dvec2 place(point[1 - mirror.axis], point.z);
  const bool inside =
      glm::all(glm::greaterThanEqual(place, mirror.low)) && glm::all(glm::lessThanEqual(place, mirror.high));
  return inside ? distance : kInfinity;
}

}  // namespace

std::vector<MirrorScene::Seen> MirrorScene::along(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  double from) const {
  const AnalyticMirror* nearest = nullptr;
  double mirrorDistance = kInfinity;
  for (const AnalyticMirror& mirror : mirrors)
    if (const double d = distanceTo(mirror, origin, direction); d > from && d < mirrorDistance)
      nearest = &mirror, mirrorDistance = d;
  std::vector<Seen> seen;
  for (const auto& crossing : surfaces.along(origin, direction, from)) {
    if (crossing.distance > mirrorDistance) break;
    seen.push_back({crossing.distance, crossing.colour, 0, 0});
    if (crossing.colour.a >= 1) return seen;
  }
  if (nearest == nullptr) {
    seen.push_back({kInfinity, surfaces.skyColour, 0, 0});
    return seen;
  }
  glm::dvec3 mirrored = direction;
  mirrored[nearest->axis] *= -1;
  const auto shown = surfaces.along(origin + mirrorDistance * direction, mirrored, 1e-9);
  Seen in{mirrorDistance, surfaces.skyColour, nearest->number, kInfinity};
  for (const auto& crossing : shown)
    if (crossing.colour.a >= 1) {
      in.colour = crossing.colour;
      in.virtualDistance = mirrorDistance + crossing.distance;
      break;
    }
  in.colour *= glm::vec4(nearest->tint, 1);
  seen.push_back(in);
  return seen;
}

Capture capture(const MirrorScene& scene, const ColumnCamera& camera, const ConvexPolygon* grown) {
  Capture out;
  out.camera = camera;
  const auto add = [](CaptureSamples& list, int row, double distance, const MirrorScene::Seen& seen) {
    list.row.push_back(static_cast<std::uint16_t>(row));
    list.inverseDistance.push_back(storedInverseDistance(1 / distance, 0));
    list.roles.push_back(0xff);
    list.colour.push_back(packColour(seen.colour));
    list.mirror.push_back(seen.mirror);
  };
  BackgroundBuilder background;
  out.columnStart.push_back(0);
  out.reflections.columnStart.push_back(0);
  for (int k = 0; k < camera.columns; ++k) {
    const glm::dvec2 c = camera.directionAt(k + 0.5);
    double from = 0;
    if (grown != nullptr)
      if (const auto span = grown->raySpan(glm::dvec2(camera.centreOfProjection), c)) from = span->second;
    for (int r = 0; r < camera.rows; ++r)
      for (const auto& seen :
           scene.along(camera.centreOfProjection, glm::dvec3(c, camera.tangentAt(r + 0.5)), from)) {
        if (std::isinf(seen.distance))
          background.add(r, 0xff);
        else
          add(out, r, seen.distance, seen);
        if (seen.mirror != 0) add(out.reflections, r, seen.virtualDistance, seen);
      }
    background.closeColumn();
    out.columnStart.push_back(static_cast<std::uint32_t>(out.row.size()));
    out.reflections.columnStart.push_back(static_cast<std::uint32_t>(out.reflections.row.size()));
  }
  out.background = std::move(background).finish(scene.surfaces.sky());
  if (out.hasReflections()) return out;
  out.mirror.clear();
  out.reflections = {};
  return out;
}

WalkScene walkScene(const MirrorScene& scene, std::shared_ptr<const Layout> layout, int region,
                    double perDegree, bool reflections) {
  WalkScene walk;
  walk.captures.resize(layout->cameras.size());
  const Region& home = layout->regions[static_cast<std::size_t>(region)];
  std::set<int> cameras;
  for (const Cover& cover : home.covers)
    for (const Piece& piece : cover.pieces) cameras.insert(piece.camera);
  for (int camera : cameras) {
    Capture made = capture(scene, columnCamera(*layout, camera, perDegree), &home.grown);
    if (!reflections) made.mirror.clear(), made.reflections = {};
    walk.captures[static_cast<std::size_t>(camera)] =
        std::make_shared<const DisplayCapture>(prepareForDisplay(made, 1));
  }
  walk.layout = std::move(layout);
  return walk;
}

}  // namespace acentric::test
