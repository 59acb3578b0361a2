#include "tests/view/mirror_scene.h"

#include <cmath>
#include <limits>

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
  const auto add = [](CaptureSamples& list, int row, double distance, const MirrorScene::Seen& seen) {
    addSample(list, row, distance, seen.colour);
    list.mirror.push_back(seen.mirror);
  };
  return captureBy(camera, grown, scene.surfaces.sky(),
                   [&](Capture& out, BackgroundBuilder& background, const PixelRay& ray) {
                     for (const auto& seen : scene.along(ray.origin, ray.direction, ray.from)) {
                       if (std::isinf(seen.distance))
                         background.add(ray.row, 0xff);
                       else
                         add(out, ray.row, seen.distance, seen);
                       if (seen.mirror != 0) add(out.reflections, ray.row, seen.virtualDistance, seen);
                     }
                   });
}

WalkScene walkScene(const MirrorScene& scene, std::shared_ptr<const Layout> layout, int region,
                    double perDegree, bool reflections) {
  return walkWith(std::move(layout), region, perDegree,
                  [&](const ColumnCamera& camera, const ConvexPolygon& grown) {
                    Capture made = capture(scene, camera, &grown);
                    if (!reflections) made.mirror.clear(), made.reflections = {};
                    return made;
                  });
}

}  // namespace acentric::test
