#pragma once
/// Where one may walk, as a question: what places are drawn from and spread over.

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

struct StandingArea {
  glm::dvec2 low{0}, high{0};  ///< a box around it, plan, metres
  std::function<bool(const glm::dvec2&)> contains;

  bool empty() const { return !contains || !(low.x < high.x && low.y < high.y); }
};

/// What of the outline lies in placed regions. The layout must outlive it. Empty without an outline.
StandingArea standingAreaOf(const Layout& layout);

/// Points of a square lattice in the area, row after row; `spacing` metres apart.
std::vector<glm::dvec2> latticeIn(const StandingArea& area, double spacing);

/// About `count` points of a square lattice (the spacing whose number is nearest to it), at least one where
/// there is room for one.
std::vector<glm::dvec2> gridIn(const StandingArea& area, std::size_t count);

}  // namespace acentric
