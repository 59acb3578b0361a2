#pragma once
/// Analytic scenes with upright plane mirrors: what a ray sees in them, and captures with the reflections at
/// their virtual places.

#include "tests/view/analytic_scene.h"

namespace acentric::test {

/// A rectangle in the plane x = at (axis 0) or y = at (axis 1).
struct AnalyticMirror {
  int axis = 0;
  double at = 0;
  glm::dvec2 low{0}, high{0};  ///< along the other horizontal axis, and z
  glm::vec3 tint{1};
  std::uint8_t number = 1;
  bool near = false;  ///< within the near band: captures keep what eyes before any part of its plane may see
};

struct MirrorScene {
  AnalyticScene surfaces;
  std::vector<AnalyticMirror> mirrors;

  struct Seen {
    double distance = 0;  ///< in units of the direction; infinity: the sky
    glm::vec4 colour{0};
    std::uint8_t mirror = 0;
    double virtualDistance = 0;  ///< of what a mirror shows; infinity: the sky
    AnalyticPlane plane = {}, virtualPlane = {};
  };
  /// What a ray meets beyond `from`, nearest first: blended surfaces, then an opaque one, a mirror or the
  /// sky.
  std::vector<Seen> along(const glm::dvec3& origin, const glm::dvec3& direction, double from) const;
  /// What near mirrors show along a ray, wherever it meets their planes, beyond `from`, nearest first: the
  /// first two surfaces, or the sky.
  std::vector<Seen> shownByNearMirrors(const glm::dvec3& origin, const glm::dvec3& direction,
                                       double from) const;
};

Capture capture(const MirrorScene& scene, const ColumnCamera& camera, const ConvexPolygon* grown);
/// Captures of all the cameras of one region's covers; without reflections mirrors are as the cameras saw
/// them.
WalkScene walkScene(const MirrorScene& scene, std::shared_ptr<const Layout> layout, int region,
                    double perDegree, bool reflections = true);
/// The same where all mirrors are near: they and `near` boxes (which join the scene's) are local geometry,
/// unlit. Mirrors get the numbers that the view gives them.
WalkScene walkPastNearMirrors(MirrorScene& scene, const std::vector<AnalyticBox>& near,
                              std::shared_ptr<const Layout> layout, int region, double perDegree);

}  // namespace acentric::test
