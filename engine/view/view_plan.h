#pragma once
/// What a frame draws, decided once for all renderers: pieces back to front, and per column of each capture
/// the largest inverse distance that this region needs from it (nearer samples lie inside the grown region,
/// where local geometry is drawn), and the least (farther ones lie outside the piece, in another's).

#include <algorithm>
#include <span>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/drawing_order.h"
#include "engine/view/column_culling.h"
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

/// What a picture may show of a capture's column.
struct ColumnSight {
  TangentRange tangents;  ///< of its rows
  int x0 = 0, x1 = 0;     ///< columns [x0, x1) of the picture that its splats may fall on
};

struct PieceDraw {
  int camera = 0;   ///< Layout camera
  ViewSector part;  ///< samples outside this azimuth range (from the eye) are not drawn, if `clipToPart`
  bool clipToPart = false;
  bool secondary = false;                 ///< the other hand, painted behind
  std::uint8_t roles = 0xff;              ///< samples that none of these needs are not drawn
  std::vector<ColumnRun> runs;            ///< after culling columns that cannot fall on the picture
  std::vector<ColumnSight> sight;         ///< per column of the capture; empty = all of all
  std::vector<float> maxInverseDistance;  ///< per column of the capture; infinity = all
  std::vector<float> minInverseDistance;  ///< the same for a piece that is clipped; else empty
  glm::vec3 baseline{0};                  ///< b = P - E, metres
  bool nearestFirst =
      false;  ///< within a pixel, draw samples in stored order (eye on the far side), else reversed
  int epipoleColumn = -1;  ///< column that holds the epipole, -1 = none
};

/// Of column k's samples, the inverse distances that the piece draws.
inline glm::vec2 drawnRange(const DisplayCapture& capture, const PieceDraw& piece, std::size_t k) {
  const glm::vec2 range = capture.columnRange[k];
  return {piece.minInverseDistance.empty() ? range.x : std::max(range.x, piece.minInverseDistance[k]),
          std::min(range.y, piece.maxInverseDistance[k])};
}

struct ViewPlan {
  int region = -1;
  std::vector<PieceDraw> pieces;       ///< back to front
  std::vector<PieceDraw> backgrounds;  ///< of DisplayCapture::background, in that order; drawn before them
  std::vector<PieceDraw> reflections;  ///< of DisplayCapture::reflections, in that order; drawn after them
  int missingImages = 0;
};

Result<ViewPlan> planView(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);
/// Of one of the layout's regions, from an eye in it or close to it.
Result<ViewPlan> planRegion(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                            int region);

/// Of how many captures it shows something.
int imagesOf(const ViewPlan& plan);

/// A plan that draws these captures whole, in this order, wherever the eye is: of captures that no regions
/// share out, for renderers that test depth. Its region is -1: no local geometry is drawn.
Result<ViewPlan> planCaptures(const WalkScene& scene, const PerspectiveView& view,
                              const ViewSettings& settings, std::span<const int> cameras);

}  // namespace acentric
