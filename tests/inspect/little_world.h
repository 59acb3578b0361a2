#pragma once
/// A layout of little cells in a world of boxes, with the columns that its cameras bake.

#include <iterator>
#include <utility>
#include <vector>

#include "engine/inspect/capture_reach.h"
#include "tests/inspect/box_tracer.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric::test {

class World {
 public:
  World(std::vector<Box> boxes, Configuration configuration, double halfCells = 1.2)
      : tracer(std::move(boxes)), scene(sceneOf(tracer.boxes())) {
    layout = makeLayout(configuration, {1.5, {0.1, -0.05}, 0.3}, halfCells);
    for (const LayoutCamera& camera : layout.cameras) {
      ColumnCamera column;
      column.centreOfProjection = glm::dvec3(camera.position, layout.eyeZ());
      column.lowAzimuth = camera.lowAzimuth;
      column.fovRadians = camera.fovRadians;
      column.topElevation = radians(68);
      column.bottomElevation = radians(-58);
      column.columns = 480, column.rows = 900;
      columns.push_back(column);
    }
  }
  CaptureReach reach(int maxLayers = 8) const { return {layout, columns, maxLayers, tracer}; }

  BoxTracer tracer;
  ScenePtr scene;
  Layout layout;
  std::vector<ColumnCamera> columns;
};

inline const Box kRoom[] = {{{-9, -9, -0.2}, {9, 9, 0}}, {{-9, -9, 4}, {9, 9, 4.2}},
                            {{-9.2, -9, 0}, {-9, 9, 4}}, {{9, -9, 0}, {9.2, 9, 4}},
                            {{-9, -9.2, 0}, {9, -9, 4}}, {{-9, 9, 0}, {9, 9.2, 4}}};

inline std::vector<Box> emptyRoom() { return {std::begin(kRoom), std::end(kRoom)}; }
inline std::vector<Box> furnishedRoom() {
  std::vector<Box> boxes = emptyRoom();
  boxes.push_back({{4.6, -1, 0}, {5.0, 1, 3}});         // a screen
  boxes.push_back({{-6, 4.5, 0}, {-5, 5.5, 4}});        // a pillar
  boxes.push_back({{-1, -6.5, 0}, {1.5, -6, 1.1}});     // a counter
  boxes.push_back({{5.6, 4.4, 1.2}, {6.2, 5.2, 1.9}});  // a thing in the air
  return boxes;
}

/// What the bake's march along the ray to a point would keep for some role: the first surfaces beyond its
/// region.
inline bool heldSlowly(const World& world, int camera, const glm::dvec3& point, int maxLayers,
                       int role = -1) {
  const ColumnCamera& columns = world.columns[std::size_t(camera)];
  const glm::dvec3 offset = point - columns.centreOfProjection, direction = glm::normalize(offset);
  const double flat = glm::length(glm::dvec2(direction)), distance = glm::length(offset);
  const double elevation = std::asin(direction.z);
  if (elevation > columns.topElevation || elevation < columns.bottomElevation) return false;
  const LayoutCamera& served = world.layout.cameras[std::size_t(camera)];
  for (std::size_t r = 0; r < served.roles.size(); ++r) {
    if ((roleBit(served, int(r)) & roleBit(served, role)) == 0) continue;
    const auto span =
        served.roles[r].grown.raySpan(glm::dvec2(columns.centreOfProjection), glm::dvec2(direction) / flat);
    double from = span ? span->second / flat : 0;
    for (int layer = 0; layer < maxLayers; ++layer) {
      const OpaqueHit hit = world.tracer.trace(columns.centreOfProjection, direction, from, 1e9);
      if (!hit.found()) break;
      if (std::abs(hit.distance - distance) < 1e-4 * distance) return true;
      from = hit.distance * (1 + 1e-6);
    }
  }
  return false;
}

}  // namespace acentric::test
