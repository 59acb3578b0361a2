#pragma once
/// List priority within one capture (McMillan; apv.md section 2): in which order columns, rows within a
/// column and samples within a pixel are drawn, so that along every view ray farther samples come first.
///
/// All three follow from one rule: draw towards the epipole, the direction P->E from the capture's centre of
/// projection to the eye. With e = E - P:
/// - columns: by decreasing azimuth difference from e;
/// - rows of column direction c: on the great circle towards the epipole the elevation rises where t * (c.e)
/// < e.z and
///   falls where it is larger, so rows are drawn towards the pivot tangent e.z / (c.e) if c.e > 0, and away
///   from it if c.e < 0. For an eye straight above or below P this alone is the order, columns then being
///   independent;
/// - one pixel's samples: as seen from the eye, points on the pixel's ray come nearer up to the foot of the
///   perpendicular from the eye, at horizontal distance c.e, and recede beyond it.

#include <glm/glm.hpp>
#include <vector>

#include "engine/geometry/column_camera.h"
#include "engine/view/view_plan.h"

namespace acentric {

struct ColumnOrder {
  std::vector<ColumnRun> runs;  ///< all columns once, in drawing order
  int epipoleColumn = -1;
  int antipodeColumn = -1;
};

/// `eyeFromCentre`: e = E - P in plan, metres. Zero: the order does not matter, one run.
ColumnOrder columnOrder(const ColumnCamera& camera, const glm::dvec2& eyeFromCentre);

/// Drops the columns with keep[k] == 0; runs are split where needed.
std::vector<ColumnRun> keepColumns(const std::vector<ColumnRun>& runs, const std::vector<char>& keep);

/// How one column is walked.
struct RowOrder {
  float pivotTangent = 0;  ///< rows above it (larger tangent) and the others are drawn in opposite directions
  bool inwards = true;     ///< towards the pivot, else away from it
  float footInverse = 0;  ///< samples with a larger inverse distance lie before the foot; infinity: none does
};
RowOrder rowOrder(const glm::dvec2& columnDirection, const glm::dvec3& eyeFromCentre);

}  // namespace acentric
