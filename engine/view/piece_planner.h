#pragma once
/// What a view can show of single captures: columns in drawing order, culled, with their limits. Plans are
/// made of it.

#include "engine/view/picture_axes.h"
#include "engine/view/view_plan.h"

namespace acentric {

class PiecePlanner {
 public:
  /// `scene` must outlive it.
  PiecePlanner(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);

  /// Adds what the view shows of the capture of `piece.camera`, which must be there. `piece` says camera,
  /// part, roles and cover; the rest is found here. `grown`: nothing within it is drawn; null: everything is.
  void add(PieceDraw piece, const ConvexPolygon* grown, const std::optional<Clip>& clip,
           ViewPlan& plan) const;

 private:
  void reach(const glm::dvec2& direction, const glm::dvec3& baseline, const glm::dvec2& range,
             ColumnSight& sight) const;
  std::vector<char> visibleColumns(const DisplayCapture& capture, PieceDraw& piece) const;
  std::vector<char> visibleBackground(const DisplayCapture& capture, const PieceDraw& piece) const;

  const WalkScene& scene_;
  glm::dvec3 eye_;
  double margin_;  ///< of splats
  FrustumPlanes planes_;
  PictureAxes axes_;
  int width_;  ///< of the picture
};

}  // namespace acentric
