#pragma once
/// The rays of a capture's pixels.

#include <vector>

#include "engine/bake/ray_scene.h"
#include "engine/geometry/column_camera.h"
#include "engine/layout/layout.h"

namespace acentric {

/// Of each row's elevation.
struct RowAngles {
  std::vector<double> cosine, sine;

  explicit RowAngles(const ColumnCamera& columns);
};

/// The rays of rows [first, last) of a column, RayPacket::kSize at most, from horizontal distance `nearest`
/// (metres) on.
RayPacket firstRays(const ColumnCamera& columns, const RowAngles& rows, const glm::dvec2& columnDirection,
                    int first, int last, double nearest);

/// Where a camera's rays of a column begin, horizontal metres: as they leave the first region that it serves.
double firstExit(const LayoutCamera& camera, const glm::dvec2& columnDirection);

}  // namespace acentric
