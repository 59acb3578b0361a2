#pragma once
/// Where a walker may stand: in a region and within the walkable outline, or in a cell that was added by hand
/// beyond it. Its border is a soft wall: whoever walks against it slides along.

#include <glm/glm.hpp>

#include "engine/layout/layout.h"

namespace acentric {

bool mayStand(const Layout& layout, const glm::dvec2& point);

/// The point itself, or one near it where one may stand, no farther than a nearest one but for a hundredth of
/// a cell. The point itself if one may stand nowhere.
glm::dvec2 nearestStanding(const Layout& layout, const glm::dvec2& point);

/// The same in whole centimetres, to be told to a person; as it is where no such place is near.
glm::dvec2 nearestStandingCentimetre(const Layout& layout, const glm::dvec2& point);

/// Where a walk straight from `from`, where one may stand, to `to` ends. What leads into a wall is lost, what
/// leads along it is kept; no wall is walked through, however long the step, if it is as thick as a hundredth
/// of a cell.
glm::dvec2 walkTo(const Layout& layout, const glm::dvec2& from, const glm::dvec2& to);

}  // namespace acentric
