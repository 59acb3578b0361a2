#include "editor/tools/lattice_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/geometry/conventions.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr double kLeastTurnPixels = 84, kLeastSizePixels = 48;

glm::dvec2 turned(const glm::dvec2& v, double angle) {
  const glm::dvec2 c = directionOf(angle);
  return {c.x * v.x - c.y * v.y, c.y * v.x + c.x * v.y};
}

double angleOf(const glm::dvec2& v) { return std::atan2(v.y, v.x); }

/// To a step that a person can read: three digits of `size`.
double rounded(double value, double size) {
  const double step = std::pow(10, std::floor(std::log10(size)) - 2);
  return std::round(value / step) * step;
}

/// 1, 2 or 5 times a power of ten, about a fortieth of the size.
double roundStep(double size) {
  const double fine = size / 40, power = std::pow(10, std::floor(std::log10(fine)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= fine * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// What a point about `centre` becomes where the lattice is turned and grows.
glm::dvec2 carried(const glm::dvec2& point, const glm::dvec2& centre, double turn, double factor) {
  return centre + factor * turned(point - centre, turn);
}

}  // namespace

LatticeGrip LatticeHandles::gripAt(const glm::dvec2& point, double pixelsPerMetre) const {
  LatticeGrip best = LatticeGrip::none;
  double nearest = kGrabPixels / pixelsPerMetre;
  for (const auto& [grip, place] : {std::pair(LatticeGrip::origin, centre),
                                    std::pair(LatticeGrip::turn, turn), std::pair(LatticeGrip::size, size)})
    if (const double distance = glm::distance(place, point); distance <= nearest)
      nearest = distance, best = grip;
  return best;
}

LatticeHandles latticeHandles(const LayoutSpec& spec, const glm::dvec2& viewLow, const glm::dvec2& viewHigh,
                              double pixelsPerMetre) {
  LatticeHandles handles;
  const glm::dvec2& origin = spec.latticeOrigin;
  const bool seen =
      origin.x > viewLow.x && origin.y > viewLow.y && origin.x < viewHigh.x && origin.y < viewHigh.y;
  const CellId ring = seen ? CellId{} : nearestSlot(spec, CellId{}, 0.5 * (viewLow + viewHigh));
  const ConvexPolygon polygon = cellPolygon(spec, {ring.i, ring.j, 0, 0});
  handles.centre = seen ? origin : polygon.centroid();
  const glm::dvec2 corner = polygon.corners.front() - handles.centre;
  const double reach = glm::length(corner);
  handles.size = handles.centre + corner * std::max(1.0, kLeastSizePixels / (reach * pixelsPerMetre));
  // Clear of the corners: as far again as the size handle.
  const double radius =
      std::max(kLeastTurnPixels / pixelsPerMetre, 1.5 * glm::distance(handles.size, handles.centre));
  handles.turn = handles.centre + radius * directionOf(spec.rotationRadians + kPi / 2);
  return handles;
}

bool LatticeTool::press(const PointerEvent& event, const LayoutSpec& spec, const LatticeHandles& handles,
                        double pixelsPerMetre) {
  grip_ = handles.gripAt(event.world, pixelsPerMetre);
  before_ = place_ = latticePlaceOf(spec);
  centre_ = handles.centre;
  grabbed_ = event.world;
  hand_ = grip_ == LatticeGrip::origin ? handles.centre
          : grip_ == LatticeGrip::turn ? handles.turn
                                       : handles.size;
  return dragging();
}

void LatticeTool::move(const PointerEvent& event, const SnapTargets& targets, double pixelsPerMetre) {
  const bool snap = (event.modifiers & ui::modifier::shift) != 0;
  place_ = before_;
  const glm::dvec2 from = grabbed_ - centre_, to = event.world - centre_;
  if (grip_ == LatticeGrip::origin) {
    glm::dvec2 centre = centre_ + event.world - grabbed_;
    if (snap) centre = snapped(centre, targets, pixelsPerMetre);
    place_.origin = before_.origin + (centre - centre_);
    if (!snap)
      for (int k = 0; k < 2; ++k) place_.origin[k] = rounded(place_.origin[k], before_.cellSize);
    hand_ = centre_ + (place_.origin - before_.origin);
  } else if (grip_ == LatticeGrip::turn && glm::length(to) > 0) {
    const double wanted = before_.rotationRadians + wrapAngle(angleOf(to) - angleOf(from));
    place_.rotationRadians = std::remainder(
        snap ? snappedAngle(wanted, targets) : radians(std::round(degrees(wanted) * 10) / 10), kTwoPi);
    const double turn = place_.rotationRadians - before_.rotationRadians;
    place_.origin = carried(before_.origin, centre_, turn, 1);
    hand_ = centre_ + turned(from, turn);
  } else if (grip_ == LatticeGrip::size && glm::length(from) > 0) {
    const double wanted = before_.cellSize * glm::length(to) / glm::length(from);
    const double size = std::clamp(wanted, kLeastCellSize, kLargestCellSize), step = roundStep(size);
    place_.cellSize = std::clamp(snap ? std::round(size / step) * step : rounded(size, size), kLeastCellSize,
                                 kLargestCellSize);
    place_.origin = carried(before_.origin, centre_, 0, place_.cellSize / before_.cellSize);
    hand_ = centre_ + from * (place_.cellSize / before_.cellSize);
  }
}

std::optional<LatticeIntent> LatticeTool::release(const PointerEvent& event, const SnapTargets& targets,
                                                  double pixelsPerMetre) {
  if (!dragging()) return std::nullopt;
  move(event, targets, pixelsPerMetre);
  const LatticeGrip grip = std::exchange(grip_, LatticeGrip::none);
  if (place_ == before_) return std::nullopt;
  return LatticeIntent{place_, grip};
}

bool LatticeTool::cancel() { return std::exchange(grip_, LatticeGrip::none) != LatticeGrip::none; }

std::string LatticeTool::text() const {
  switch (grip_) {
    case LatticeGrip::origin:
      return fmt::format("x {:.3f} m   y {:.3f} m", place_.origin.x, place_.origin.y);
    case LatticeGrip::turn:
      return fmt::format("{:.1f}°", degrees(place_.rotationRadians));
    case LatticeGrip::size:
      return fmt::format("{:.4g} m", place_.cellSize);
    case LatticeGrip::none:
      break;
  }
  return {};
}

std::string LatticeTool::labelOf(const LatticeIntent& intent) {
  switch (intent.grip) {
    case LatticeGrip::turn:
      return trf("Lattice rotation {:.1f}°", degrees(intent.place.rotationRadians));
    case LatticeGrip::size:
      return trf("Cell size {:.4g} m", intent.place.cellSize);
    case LatticeGrip::origin:
    case LatticeGrip::none:
      break;
  }
  return trf("Lattice origin {:.2f}, {:.2f} m", intent.place.origin.x, intent.place.origin.y);
}

}  // namespace acentric::editor
