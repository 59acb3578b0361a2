#pragma once
/// What a dragged point lands on. Pure.

#include <optional>
#include <span>

#include "engine/layout/layout_spec.h"

namespace acentric::editor {

/// Places and directions that are worth landing on.
struct SnapTargets {
  std::span<const glm::dvec2> corners;     ///< of walls and of the outline, plan
  double gridMetres = 0;                   ///< 0: none
  std::optional<double> wallRadians = {};  ///< of most walls; a right angle from it is as good
};

/// The nearest of the corners within kGrabPixels.
std::optional<glm::dvec2> nearestCorner(std::span<const glm::dvec2> corners, const glm::dvec2& point,
                                        double pixelsPerMetre);
/// The nearest corner of the cell that holds the point, within kGrabPixels.
std::optional<glm::dvec2> nearestCellCorner(const LayoutSpec& spec, const glm::dvec2& point,
                                            double pixelsPerMetre);
/// To a corner within reach, else to the grid.
glm::dvec2 snapped(const glm::dvec2& point, const SnapTargets& targets, double pixelsPerMetre);
/// To the direction of the walls, or a right angle from it, within 4 degrees; else to whole 15 degrees.
double snappedAngle(double angleRadians, const SnapTargets& targets);

}  // namespace acentric::editor
