#pragma once
/// Handles over what is selected in the 3D view, of the same size on the screen at any distance: two arrows
/// along the floor, a square and the middle for both, an upright arrow for what has a height of its own, a
/// ring for what can be turned about the vertical. With Shift they snap as the plan's handles do. Pixels are
/// of the picture; `scale`: of the interface. Events in, moves out; nothing here changes the project.

#include <optional>
#include <string>
#include <vector>

#include "editor/tools/ray_math.h"
#include "editor/tools/snap.h"

namespace acentric::editor {

enum class GizmoGrip { none, x, y, plane, up, turn };

struct Gizmo {
  glm::dvec3 at{0};        ///< world, metres
  double axesRadians = 0;  ///< azimuth of the first arrow
  bool rises = false;      ///< has a height of its own
  bool turns = false;      ///< looks somewhere
  double yawRadians = 0;   ///< there
  bool operator==(const Gizmo&) const = default;
};

/// One part as it is drawn: a polyline, or for `plane` a square.
struct GizmoPart {
  GizmoGrip grip = GizmoGrip::none;
  std::vector<glm::dvec2> pixels;
};
/// Those that can be taken hold of from where the eye is: none where the gizmo lies behind it, no arrow that
/// points at the eye, no square or ring that is seen from its edge.
std::vector<GizmoPart> partsOf(const Gizmo& gizmo, const PerspectiveView& view, double scale);
GizmoGrip gripAt(const Gizmo& gizmo, const PerspectiveView& view, const glm::dvec2& pixel, double scale);
/// Where the knob on the ring is; nothing where it is not drawn.
std::optional<glm::dvec2> knobOf(const Gizmo& gizmo, const PerspectiveView& view, double scale);

struct GizmoMove {
  glm::dvec3 by{0};        ///< metres
  double turnRadians = 0;  ///< about the vertical, counter-clockwise
  bool operator==(const GizmoMove&) const = default;
};
/// The gizmo as it is after that.
Gizmo moved(Gizmo gizmo, const GizmoMove& move);

class GizmoTool {
 public:
  /// Left button only. False: the press is not on a handle.
  bool press(const glm::dvec2& pixel, const PerspectiveView& view, const Gizmo& gizmo, double scale);
  /// True if the move changed. Where the ray is refused it stays as it was.
  bool move(const glm::dvec2& pixel, const PerspectiveView& view, int modifiers, const SnapTargets& targets,
            double scale);
  /// What was done; nothing if the pointer went nowhere.
  std::optional<GizmoMove> release();
  /// True if something was afoot.
  bool cancel();

  bool capturing() const { return grip_ != GizmoGrip::none; }
  GizmoGrip grip() const { return grip_; }
  const GizmoMove& now() const { return move_; }
  /// "x +0.250 m   y -1.000 m", "+15.0°": what to write beside it.
  std::string text() const;

 private:
  std::optional<GizmoMove> moveFor(const glm::dvec2& pixel, const PerspectiveView& view, bool snap,
                                   const SnapTargets& targets, double scale) const;
  glm::dvec3 axis() const;

  GizmoGrip grip_ = GizmoGrip::none;
  Gizmo gizmo_;  // as it was taken hold of
  glm::dvec2 pressed_{0};
  double grabbed_ = 0;          // along the axis, metres; of the ring, radians
  glm::dvec2 grabbedPlace_{0};  // of the square
  bool dragged_ = false;
  GizmoMove move_;
};

}  // namespace acentric::editor
