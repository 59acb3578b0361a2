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

}  // namespace acentric::test
