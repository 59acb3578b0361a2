#include "tests/view/mirror_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/view/local_scene.h"

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

/// Where a mirror shows it.
AnalyticPlane mirroredBy(const AnalyticMirror& mirror, const AnalyticPlane& plane) {
  return {plane.axis, plane.axis == mirror.axis ? 2 * mirror.at - plane.at : plane.at};
}
constexpr AnalyticPlane kSkyPlane{2, kInfinity};

/// Six faces, seen from outside.
void addBox(LocalSceneBuilder& builder, const AnalyticBox& box) {
  const int material = builder.material(box.colour);
  if (box.colour.a < 1) builder.at(material).alphaMode = AlphaMode::blend;
  const std::array ends = {glm::vec3(box.min), glm::vec3(box.max)};
  const auto corner = [&](int axis, float a, std::size_t u, std::size_t v) {
    glm::vec3 p(0);
    p[axis] = a, p[(axis + 1) % 3] = ends[u][(axis + 1) % 3], p[(axis + 2) % 3] = ends[v][(axis + 2) % 3];
    return p;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const float low = ends[0][axis], high = ends[1][axis];
    builder.quad(material, corner(axis, high, 0, 0), corner(axis, high, 1, 0), corner(axis, high, 1, 1),
                 corner(axis, high, 0, 1));
    builder.quad(material, corner(axis, low, 0, 0), corner(axis, low, 0, 1), corner(axis, low, 1, 1),
                 corner(axis, low, 1, 0));
  }
}

void addMirror(LocalSceneBuilder& builder, const AnalyticMirror& mirror) {
  const int material = builder.material(glm::vec4(mirror.tint, 1));
  builder.at(material).metallic = 1, builder.at(material).roughness = 0;
  const auto corner = [&](double along, double z) {
    glm::vec3 p(0);
    p[mirror.axis] = float(mirror.at), p[1 - mirror.axis] = float(along), p.z = float(z);
    return p;
  };
  builder.quad(material, corner(mirror.low.x, mirror.low.y), corner(mirror.low.x, mirror.high.y),
               corner(mirror.high.x, mirror.high.y), corner(mirror.high.x, mirror.low.y));
}

}  // namespace

std::vector<MirrorScene::Seen> MirrorScene::shownByNearMirrors(const glm::dvec3& origin,
                                                               const glm::dvec3& direction,
                                                               double from) const {
  std::vector<Seen> seen;
  for (const AnalyticMirror& mirror : mirrors) {
    const double distance = (mirror.at - origin[mirror.axis]) / direction[mirror.axis];
    if (!mirror.near || !(distance > 0) || !std::isfinite(distance)) continue;
    glm::dvec3 mirrored = direction;
    mirrored[mirror.axis] *= -1;
    int kept = 0;
    const auto add = [&](const glm::vec4& colour, double virtualDistance, const AnalyticPlane& plane) {
      if (!(virtualDistance > from) || kept == 2) return;
      seen.push_back(
          {distance, colour * glm::vec4(mirror.tint, 1), mirror.number, virtualDistance, {}, plane});
      ++kept;
    };
    for (const auto& crossing : surfaces.along(origin + distance * direction, mirrored, 1e-9))
      if (crossing.colour.a >= 1)
        add(crossing.colour, distance + crossing.distance, mirroredBy(mirror, crossing.plane));
    add(surfaces.skyColour, kInfinity, kSkyPlane);
  }
  std::ranges::stable_sort(seen, {}, &Seen::virtualDistance);
  return seen;
}

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
    seen.push_back({crossing.distance, crossing.colour, 0, 0, crossing.plane});
    if (crossing.colour.a >= 1) return seen;
  }
  if (nearest == nullptr) {
    seen.push_back({kInfinity, surfaces.skyColour, 0, 0});
    return seen;
  }
  glm::dvec3 mirrored = direction;
  mirrored[nearest->axis] *= -1;
  const auto shown = surfaces.along(origin + mirrorDistance * direction, mirrored, 1e-9);
  Seen in{mirrorDistance, surfaces.skyColour,           nearest->number,
          kInfinity,      {nearest->axis, nearest->at}, kSkyPlane};
  for (const auto& crossing : shown)
    if (crossing.colour.a >= 1) {
      in.colour = crossing.colour;
      in.virtualDistance = mirrorDistance + crossing.distance;
      in.virtualPlane = mirroredBy(*nearest, crossing.plane);
      break;
    }
  in.colour *= glm::vec4(nearest->tint, 1);
  seen.push_back(in);
  return seen;
}

Capture capture(const MirrorScene& scene, const ColumnCamera& camera, const ConvexPolygon* grown) {
  const auto add = [&](CaptureSamples& list, int row, double distance, const AnalyticPlane& plane,
                       const MirrorScene::Seen& seen) {
    addSample(list, row, distance, seen.colour);
    list.mirror.push_back(seen.mirror);
    if (scene.surfaces.silhouettes) addPlane(list, camera.centreOfProjection, plane);
  };
  return captureBy(camera, grown, scene.surfaces.sky(),
                   [&](Capture& out, BackgroundBuilder& background, const PixelRay& ray) {
                     const auto addShown = [&](const MirrorScene::Seen& seen) {
                       add(out.reflections, ray.row, seen.virtualDistance, seen.virtualPlane, seen);
                     };
                     for (const auto& seen : scene.along(ray.origin, ray.direction, ray.from)) {
                       if (std::isinf(seen.distance))
                         background.add(ray.row, 0xff);
                       else
                         add(out, ray.row, seen.distance, seen.plane, seen);
                       if (seen.mirror != 0) addShown(seen);
                     }
                     for (const auto& seen : scene.shownByNearMirrors(ray.origin, ray.direction, ray.from))
                       addShown(seen);
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

WalkScene walkPastNearMirrors(MirrorScene& scene, const std::vector<AnalyticBox>& near,
                              std::shared_ptr<const Layout> layout, int region, double perDegree) {
  LocalSceneBuilder builder;
  for (AnalyticMirror& mirror : scene.mirrors) addMirror(builder, mirror);
  for (const AnalyticBox& box : near) addBox(builder, box);
  const WalkScene polygons = builder.build();
  const auto flat = flatMirrorsOf(*polygons.scene, polygons.plan);
  const glm::dvec2 middle = layout->regions[std::size_t(region)].polygon.centroid();
  for (std::size_t m = 0; m < scene.mirrors.size(); ++m) {
    AnalyticMirror& mirror = scene.mirrors[m];
    glm::vec3 toViewer(0);
    toViewer[mirror.axis] = float(middle[mirror.axis] - mirror.at);
    mirror.number = flat->at(std::uint32_t(m), 0, toViewer);
    mirror.near = true;
  }
  scene.surfaces.boxes.insert(scene.surfaces.boxes.end(), near.begin(), near.end());
  WalkScene walk = walkScene(scene, layout, region, perDegree);
  walk.scene = polygons.scene;
  walk.plan = polygons.plan;
  walk.mirrors = flat;
  walk.local.resize(layout->regions.size());
  walk.local[std::size_t(region)] = std::make_shared<const LocalGeometry>(
      clipToPolygon(*walk.scene, layout->regions[std::size_t(region)].grown));
  return walk;
}

}  // namespace acentric::test
