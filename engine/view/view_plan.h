#pragma once
/// What a frame draws, decided once for all renderers: pieces back to front, and per column of each capture
/// the largest inverse distance that this region needs from it (nearer samples lie inside the grown region,
/// where local geometry is drawn).

#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/drawing_order.h"
#include "engine/view/view_settings.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Columns [first, last) of a capture, drawn first to last if ascending, else last to first. Consecutive runs
/// of one piece realise list priority: towards the epipole from both sides, or away from the antipode.
struct ColumnRun {
  int first = 0;
  int last = 0;
  bool ascending = true;
};

struct PieceDraw {
  int camera = 0;   ///< Layout camera
  ViewSector part;  ///< samples outside this azimuth range (from the eye) are not drawn, if `clipToPart`
  bool clipToPart = false;
  bool secondary = false;                 ///< the other hand, painted behind
  std::vector<ColumnRun> runs;            ///< after culling columns that cannot fall on the picture
  std::vector<float> maxInverseDistance;  ///< per column of the capture; infinity = all
  glm::vec3 baseline{0};                  ///< b = P - E, metres
  bool nearestFirst =
      false;  ///< within a pixel, draw samples in stored order (eye on the far side), else reversed
  int epipoleColumn = -1;  ///< column that holds the epipole, -1 = none
};

struct ViewPlan {
  int region = -1;
  std::vector<PieceDraw> pieces;  ///< back to front
  int missingImages = 0;
};

Result<ViewPlan> planView(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);

}  // namespace acentric
