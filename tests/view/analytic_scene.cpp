#include "analytic_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace acentric::test {

std::vector<AnalyticScene::Crossing> AnalyticScene::along(const glm::dvec3& origin,
                                                          const glm::dvec3& direction, double from) const {
  std::vector<Crossing> found;
  if (floor && direction.z != 0) {
    const double t = -origin.z / direction.z;
    if (t > from) found.push_back({t, floorColour, {2, 0}});
  }
  for (const AnalyticBox& box : boxes) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    AnalyticPlane face;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (origin[axis] < box.min[axis] || origin[axis] > box.max[axis]) leave = -1;
        continue;
      }
      const double a = (box.min[axis] - origin[axis]) / direction[axis];
      const double b = (box.max[axis] - origin[axis]) / direction[axis];
      if (std::min(a, b) > enter) face = {axis, a < b ? box.min[axis] : box.max[axis]};
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave && enter > from) found.push_back({enter, box.colour, face});
  }
  std::sort(found.begin(), found.end(),
            [](const Crossing& a, const Crossing& b) { return a.distance < b.distance; });
  return found;
}

AnalyticScene randomBoxes(unsigned seed, int count, double innerRadius) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  AnalyticScene scene;
  while (static_cast<int>(scene.boxes.size()) < count) {
    const double azimuth = kTwoPi * unit(random), radius = innerRadius + 12 * unit(random);
    const glm::dvec2 at = radius * directionOf(azimuth);
    const glm::dvec2 half(0.1 + 0.5 * unit(random), 0.1 + 0.5 * unit(random));
    const double low = unit(random) < 0.5 ? 0 : 2 * unit(random);
    const glm::dvec2 nearest = glm::clamp(glm::dvec2(0), at - half, at + half);
    if (glm::length(nearest) < innerRadius) continue;
    AnalyticBox box;
    box.min = glm::dvec3(at - half, low);
    box.max = glm::dvec3(at + half, low + 0.3 + 2 * unit(random));
    box.colour =
        glm::vec4(0.05 + 0.65 * unit(random), 0.05 + 0.65 * unit(random), 0.05 + 0.65 * unit(random), 1);
    scene.boxes.push_back(box);
  }
  return scene;
}

AnalyticScene randomPatches(unsigned seed, int count, double innerRadius) {
  AnalyticScene scene = randomBoxes(seed, count, innerRadius);
  scene.silhouettes = true;
  return scene;
}

void addPlane(CaptureSamples& list, const glm::dvec3& centre, const AnalyticPlane& plane) {
  SurfacePlane surface;
  surface.normal[plane.axis] = float(1 / (plane.at - centre[plane.axis]));
  const auto known = std::ranges::find(list.planes, surface);
  list.plane.push_back(std::uint32_t(known - list.planes.begin()));
  if (known == list.planes.end()) list.planes.push_back(surface);
  list.coverage.push_back(kWholePixel);
}

void addSample(CaptureSamples& list, int row, double distance, const glm::vec4& colour) {
  list.row.push_back(static_cast<std::uint16_t>(row));
  list.inverseDistance.push_back(storedInverseDistance(1 / distance, 0));
  list.roles.push_back(0xff);
  list.colour.push_back(packColour(colour));
}

Capture captureBy(const ColumnCamera& camera, const ConvexPolygon* grown, const Sky& sky,
                  const std::function<void(Capture&, BackgroundBuilder&, const PixelRay&)>& addPixel) {
  Capture out;
  out.camera = camera;
  out.columnStart.push_back(0);
  out.reflections.columnStart.push_back(0);
  BackgroundBuilder background;
  for (int k = 0; k < camera.columns; ++k) {
    const glm::dvec2 c = camera.directionAt(k + 0.5);
    double from = 0;
    if (grown != nullptr)
      if (const auto span = grown->raySpan(glm::dvec2(camera.centreOfProjection), c)) from = span->second;
    for (int r = 0; r < camera.rows; ++r)
      addPixel(out, background,
               {r, camera.centreOfProjection, glm::dvec3(c, camera.tangentAt(r + 0.5)), from});
    background.closeColumn();
    out.columnStart.push_back(static_cast<std::uint32_t>(out.row.size()));
    out.reflections.columnStart.push_back(static_cast<std::uint32_t>(out.reflections.row.size()));
  }
  out.background = std::move(background).finish(sky);
  if (!out.hasReflections()) out.mirror = {}, out.reflections = {};
  return out;
}

Capture capture(const AnalyticScene& scene, const ColumnCamera& camera, const ConvexPolygon* grown,
                int layers) {
  return captureBy(camera, grown, scene.sky(),
                   [&](Capture& out, BackgroundBuilder& background, const PixelRay& ray) {
                     int kept = 0;
                     bool closed = false;
                     for (const auto& crossing : scene.along(ray.origin, ray.direction, ray.from)) {
                       if (kept >= layers && closed) break;
                       addSample(out, ray.row, crossing.distance, crossing.colour);
                       if (scene.silhouettes) addPlane(out, ray.origin, crossing.plane);
                       ++kept;
                       closed = closed || crossing.colour.a >= 1;
                     }
                     if (kept < layers || !closed) background.add(ray.row, 0xff);
                   });
}

ColumnCamera columnCamera(const Layout& layout, int camera, double perDegree) {
  const LayoutCamera& source = layout.cameras[static_cast<std::size_t>(camera)];
  ColumnCamera out;
  out.centreOfProjection = glm::dvec3(source.position, layout.eyeZ());
  out.lowAzimuth = source.lowAzimuth;
  out.fovRadians = source.fovRadians;
  out.topElevation = radians(60);
  out.bottomElevation = -radians(60);
  out.columns = std::max(1, static_cast<int>(std::lround(degrees(source.fovRadians) * perDegree)));
  out.rows = std::max(1, static_cast<int>(std::lround(120 * perDegree)));
  return out;
}

std::shared_ptr<const Layout> layoutAroundOrigin(Configuration configuration, double cellSize,
                                                 double nearBand) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = cellSize;
  spec.nearBand = nearBand;
  const double half = 1.5 * cellSize;
  spec.outline.loops.push_back({{-half, -half}, {half, -half}, {half, half}, {-half, half}});
  auto layout = buildLayout(spec);
  return layout ? std::make_shared<const Layout>(std::move(*layout)) : nullptr;
}

WalkScene walkWith(std::shared_ptr<const Layout> layout, int region, double perDegree,
                   const std::function<Capture(const ColumnCamera&, const ConvexPolygon&)>& captureOf) {
  WalkScene walk;
  walk.captures.resize(layout->cameras.size());
  const Region& home = layout->regions[static_cast<std::size_t>(region)];
  std::set<int> cameras;
  for (const Cover& cover : home.covers)
    for (const Piece& piece : cover.pieces) cameras.insert(piece.camera);
  for (int camera : cameras)
    walk.captures[static_cast<std::size_t>(camera)] = std::make_shared<const DisplayCapture>(
        prepareForDisplay(captureOf(columnCamera(*layout, camera, perDegree), home.grown), 1));
  walk.layout = std::move(layout);
  return walk;
}

WalkScene walkScene(const AnalyticScene& scene, std::shared_ptr<const Layout> layout, int region,
                    double perDegree, int layers) {
  return walkWith(std::move(layout), region, perDegree,
                  [&](const ColumnCamera& camera, const ConvexPolygon& grown) {
                    return capture(scene, camera, &grown, layers);
                  });
}

glm::dvec2 randomPointIn(const ConvexPolygon& polygon, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.02, 1);
  glm::dvec2 sum(0);
  double total = 0;
  for (const glm::dvec2& corner : polygon.corners) {
    const double weight = -std::log(unit(random));
    sum += weight * corner;
    total += weight;
  }
  return sum / total;
}

double differingShare(const ColourImage& a, const ColourImage& b, int tolerance) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::ivec4 difference = glm::abs(glm::ivec4(a.pixels[i]) - glm::ivec4(b.pixels[i]));
    differing += std::max({difference.x, difference.y, difference.z, difference.w}) > tolerance;
  }
  return static_cast<double>(differing) / static_cast<double>(a.pixels.size());
}

}  // namespace acentric::test
