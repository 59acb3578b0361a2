#include "editor/tools/gizmo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/tools/orbit_camera.h"
#include "editor/tools/pointer_event.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

// Pixels of an interface of 100 %.
constexpr double kArrow = 84, kArrowFrom = 12;
constexpr double kSquareFrom = 20, kSquareTo = 38;
constexpr double kMiddle = 10;  ///< around the place itself: as the square
constexpr double kRing = 58;
constexpr double kReach = 7;  ///< from a line, how near a press takes hold of it
constexpr int kRingSteps = 64;
constexpr double kEdgeOn = 0.06;  ///< sine of the angle at which the floor is seen too flat
constexpr double kEndOn = 0.16;   ///< of an arrow's length, what of it is seen at least

glm::dvec3 firstAxis(const Gizmo& gizmo) { return {directionOf(gizmo.axesRadians), 0}; }
glm::dvec3 secondAxis(const Gizmo& gizmo) { return {directionOf(gizmo.axesRadians + kPi / 2), 0}; }

double metresPerPixel(const Gizmo& gizmo, const PerspectiveView& view, double scale) {
  const double pixels = pixelsPerMetre(view, gizmo.at);
  return pixels > 0 ? scale / pixels : 0;
}

void addArrow(std::vector<GizmoPart>& parts, GizmoGrip grip, const Gizmo& gizmo, const glm::dvec3& axis,
              const PerspectiveView& view, double metres, double scale) {
  const auto stroke =
      strokeOf(view, gizmo.at + kArrowFrom * metres * axis, gizmo.at + kArrow * metres * axis);
  if (!stroke || glm::distance(stroke->from, stroke->to) < kEndOn * kArrow * scale) return;
  parts.push_back({grip, {stroke->from, stroke->to}});
}

/// As it is told, without the sign of a nought.
double told(double value, double digits) { return std::round(value * digits) / digits + 0.0; }

bool isInside(std::span<const glm::dvec2> corners, const glm::dvec2& at) {
  bool left = false, right = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec2 side = corners[(k + 1) % corners.size()] - corners[k], to = at - corners[k];
    (side.x * to.y - side.y * to.x > 0 ? left : right) = true;
  }
  return !(left && right);
}

double distanceTo(const GizmoPart& part, const glm::dvec2& pixel) {
  if (part.grip == GizmoGrip::plane && isInside(part.pixels, pixel)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < part.pixels.size(); ++k)
    nearest = std::min(nearest, distanceTo(Stroke{part.pixels[k], part.pixels[k + 1]}, pixel));
  return nearest;
}

}  // namespace

std::vector<GizmoPart> partsOf(const Gizmo& gizmo, const PerspectiveView& view, double scale) {
  std::vector<GizmoPart> parts;
  const double metres = metresPerPixel(gizmo, view, scale);
  if (metres <= 0) return parts;
  const glm::dvec3 x = firstAxis(gizmo), y = secondAxis(gizmo);
  const bool flat = std::abs(glm::normalize(gizmo.at - view.eye).z) < kEdgeOn;
  if (gizmo.turns && !flat) {
    GizmoPart ring{GizmoGrip::turn, {}};
    for (int k = 0; k <= kRingSteps; ++k) {
      const glm::dvec3 place =
          gizmo.at + kRing * metres * glm::dvec3(directionOf(kTwoPi * k / kRingSteps), 0);
      const Projected seen = project(view, place);
      if (seen.depth > 0) ring.pixels.push_back(seen.pixel);
    }
    parts.push_back(std::move(ring));
  }
  if (!flat) {
    const double low = kSquareFrom * metres, high = kSquareTo * metres;
    const glm::dvec3 corners[] = {gizmo.at + low * x + low * y, gizmo.at + high * x + low * y,
                                  gizmo.at + high * x + high * y, gizmo.at + low * x + high * y};
    parts.push_back({GizmoGrip::plane, cornersBeforeEye(view, corners)});
  }
  addArrow(parts, GizmoGrip::x, gizmo, x, view, metres, scale);
  addArrow(parts, GizmoGrip::y, gizmo, y, view, metres, scale);
  if (gizmo.rises) addArrow(parts, GizmoGrip::up, gizmo, {0, 0, 1}, view, metres, scale);
  return parts;
}

GizmoGrip gripAt(const Gizmo& gizmo, const PerspectiveView& view, const glm::dvec2& pixel, double scale) {
  const std::vector<GizmoPart> parts = partsOf(gizmo, view, scale);
  const bool slides =
      std::ranges::any_of(parts, [](const GizmoPart& part) { return part.grip == GizmoGrip::plane; });
  if (slides && glm::distance(project(view, gizmo.at).pixel, pixel) <= kMiddle * scale)
    return GizmoGrip::plane;
  GizmoGrip found = GizmoGrip::none;
  double nearest = kReach * scale;
  for (const GizmoPart& part : parts)
    if (const double distance = distanceTo(part, pixel); distance < nearest)
      nearest = distance, found = part.grip;
  return found;
}

std::optional<glm::dvec2> knobOf(const Gizmo& gizmo, const PerspectiveView& view, double scale) {
  const double metres = metresPerPixel(gizmo, view, scale);
  if (!gizmo.turns || metres <= 0) return std::nullopt;
  const Projected seen =
      project(view, gizmo.at + kRing * metres * glm::dvec3(directionOf(gizmo.yawRadians), 0));
  return seen.depth > 0 ? std::optional(seen.pixel) : std::nullopt;
}

Gizmo moved(Gizmo gizmo, const GizmoMove& move) {
  gizmo.at += move.by;
  gizmo.yawRadians = wrapAngle(gizmo.yawRadians + move.turnRadians);
  return gizmo;
}

glm::dvec3 GizmoTool::axis() const {
  return grip_ == GizmoGrip::x   ? firstAxis(gizmo_)
         : grip_ == GizmoGrip::y ? secondAxis(gizmo_)
                                 : glm::dvec3(0, 0, 1);
}

bool GizmoTool::press(const glm::dvec2& pixel, const PerspectiveView& view, const Gizmo& gizmo,
                      double scale) {
  cancel();
  grip_ = gripAt(gizmo, view, pixel, scale);
  gizmo_ = gizmo;
  pressed_ = pixel;
  const PointerRay ray = rayThrough(view, pixel);
  bool held = grip_ != GizmoGrip::none;
  if (grip_ == GizmoGrip::plane) {
    const auto place = onLevel(ray, gizmo.at.z);
    held = place.has_value();
    grabbedPlace_ = place.value_or(glm::dvec2(0));
  } else if (held) {
    const auto at = grip_ == GizmoGrip::turn ? azimuthAbout(ray, gizmo.at) : alongLine(ray, gizmo.at, axis());
    held = at.has_value();
    grabbed_ = at.value_or(0);
  }
  if (!held) grip_ = GizmoGrip::none;
  return held;
}

std::optional<GizmoMove> GizmoTool::moveFor(const glm::dvec2& pixel, const PerspectiveView& view, bool snap,
                                            const SnapTargets& targets, double scale) const {
  const PointerRay ray = rayThrough(view, pixel);
  const double pixels = pixelsPerMetre(view, gizmo_.at) / scale;
  if (grip_ == GizmoGrip::turn) {
    const auto azimuth = azimuthAbout(ray, gizmo_.at);
    if (!azimuth) return std::nullopt;
    const double wanted = gizmo_.yawRadians + std::remainder(*azimuth - grabbed_, kTwoPi);
    const double yaw = snap ? snappedAngle(wanted, targets) : wanted;
    return GizmoMove{glm::dvec3(0), std::remainder(yaw - gizmo_.yawRadians, kTwoPi)};
  }
  if (grip_ == GizmoGrip::plane) {
    const auto place = onLevel(ray, gizmo_.at.z);
    if (!place) return std::nullopt;
    glm::dvec2 wanted = glm::dvec2(gizmo_.at) + *place - grabbedPlace_;
    if (snap) wanted = snapped(wanted, targets, pixels);
    return GizmoMove{{wanted - glm::dvec2(gizmo_.at), 0}, 0};
  }
  const auto along = alongLine(ray, gizmo_.at, axis());
  if (!along) return std::nullopt;
  double by = *along - grabbed_;
  if (snap && grip_ == GizmoGrip::up) {
    if (targets.gridMetres > 0)
      by = std::round((gizmo_.at.z + by) / targets.gridMetres) * targets.gridMetres - gizmo_.at.z;
  } else if (snap) {
    const glm::dvec2 from(gizmo_.at), way(axis());
    by = glm::dot(snapped(from + by * way, targets, pixels) - from, way);
  }
  return GizmoMove{by * axis(), 0};
}

bool GizmoTool::move(const glm::dvec2& pixel, const PerspectiveView& view, int modifiers,
                     const SnapTargets& targets, double scale) {
  if (!capturing()) return false;
  dragged_ = dragged_ || glm::distance(pixel, pressed_) > kDragPixels;
  if (!dragged_) return false;
  const auto wanted = moveFor(pixel, view, (modifiers & ui::modifier::shift) != 0, targets, scale);
  if (!wanted || *wanted == move_) return false;
  move_ = *wanted;
  return true;
}

std::optional<GizmoMove> GizmoTool::release() {
  const GizmoMove done = move_;
  if (!cancel() || done == GizmoMove{}) return std::nullopt;
  return done;
}

bool GizmoTool::cancel() {
  const bool afoot = capturing();
  grip_ = GizmoGrip::none;
  dragged_ = false;
  move_ = {};
  return afoot;
}

std::string GizmoTool::text() const {
  switch (grip_) {
    case GizmoGrip::turn:
      return fmt::format("{:+.1f}°", told(degrees(move_.turnRadians), 10));
    case GizmoGrip::up:
      return fmt::format("z {:+.3f} m", told(move_.by.z, 1000));
    case GizmoGrip::none:
      return {};
    case GizmoGrip::x:
    case GizmoGrip::y:
    case GizmoGrip::plane:
      break;
  }
  return fmt::format("x {:+.3f} m   y {:+.3f} m", told(move_.by.x, 1000), told(move_.by.y, 1000));
}

}  // namespace acentric::editor
