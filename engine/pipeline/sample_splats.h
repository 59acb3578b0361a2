#pragma once
/// Whether a view would draw a sample on a pixel, told without captures and renderer: the cameras' rays
/// around what lies there are traced, and what the bake would keep of them drawn as renderers draw it
/// (warp.h).

#include "engine/geometry/perspective_view.h"
#include "engine/inspect/capture_reach.h"
#include "engine/view/slant_code.h"
#include "engine/view/view_settings.h"

namespace acentric {

class SampleSplats {
 public:
  /// Refers to reach.
  SampleSplats(const CaptureReach& reach, const PerspectiveView& view, const ViewSettings& settings);

  /// Does the splat of one of the piece's samples around the point (world) cover the middle of the pixel in
  /// which the view has the point? `place`: pixels right of and below the middle of the picture.
  bool cover(const Piece& piece, const glm::dvec3& point, const glm::dvec2& place) const;

 private:
  class Around;
  /// Half the sides of a sample's splat, pixels, and its middle.
  struct Splat {
    glm::dvec2 centre{0}, half{-1};
    bool covers(const glm::dvec2& place) const;
  };
  Splat square(const ColumnCamera& camera, const glm::dvec3& point) const;
  Splat rectangle(const ColumnCamera& camera, const glm::dvec3& point, const Slant& slant) const;
  int samplesAround(const ColumnCamera& camera, const glm::dvec3& point) const;

  const CaptureReach& reach_;
  glm::dvec3 eye_;
  glm::dmat3 viewFromWorld_;
  double focal_;
  bool followsSlant_;
  double factor_, maxPixels_;  ///< of a splat's side: against the sample's share of its surface, and at most
};

}  // namespace acentric
