#include "engine/pipeline/walk_ground.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/geometry/conventions.h"
#include "engine/pipeline/camera_path.h"

namespace acentric {
namespace {

constexpr int kDirections = 32;
constexpr int kMostSteps = 2000;

/// The finest that is told apart, metres.
double grain(const Layout& layout) { return 0.01 * layout.spec.cellSize; }

/// The last place towards `to` where one may stand; the way there is one.
glm::dvec2 lastStanding(const Layout& layout, glm::dvec2 inside, glm::dvec2 outside) {
  for (int i = 0; i < 24; ++i) {
    const glm::dvec2 middle = 0.5 * (inside + outside);
    (mayStand(layout, middle) ? inside : outside) = middle;
  }
  return inside;
}

/// The direction of the step that keeps most of it: turned by as little as lets one stand there.
std::optional<glm::dvec2> alongTheWall(const Layout& layout, const glm::dvec2& from, const glm::dvec2& step) {
  constexpr int kTurns = 45;
  for (int n = 1; n <= kTurns; ++n)
    for (const int side : {1, -1}) {
      const double turn = side * n * radians(89.0) / kTurns;
      const glm::dvec2 turned(std::cos(turn) * step.x - std::sin(turn) * step.y,
                              std::sin(turn) * step.x + std::cos(turn) * step.y);
      // As much of it as leads that way: against a wall head-on nearly nothing.
      const glm::dvec2 kept = std::cos(turn) * turned;
      if (mayStand(layout, from + kept)) return from + kept;
    }
  return std::nullopt;
}

}  // namespace

bool mayStand(const Layout& layout, const glm::dvec2& point) {
  const auto region = layout.regionAt(point);
  if (!region) return false;
  const LayoutSpec& spec = layout.spec;
  const CellId& cell = layout.regions[std::size_t(*region)].id;
  return spec.outline.empty() || cell.slot == kFreeSlot || spec.added.contains(cell) ||
         spec.outline.contains(point);
}

glm::dvec2 nearestStanding(const Layout& layout, const glm::dvec2& point) {
  if (mayStand(layout, point)) return point;
  // Nearest to one of the two borders is the answer as a rule; else it is where they meet: look around.
  const glm::dvec2 inOutline = layout.spec.outline.empty() ? point : layout.spec.outline.nearestPoint(point);
  const glm::dvec2 inRegion = clampToPlan(layout, point);
  std::optional<glm::dvec2> best;
  const auto offer = [&](const glm::dvec2& p) {
    if (mayStand(layout, p) && (!best || glm::distance(p, point) < glm::distance(*best, point))) best = p;
  };
  const double step = grain(layout);
  const auto around = [&](const glm::dvec2& centre, double radius) {
    for (int k = 0; k < kDirections; ++k) offer(centre + radius * directionOf(kTwoPi * k / kDirections));
  };
  for (const glm::dvec2& p : {inOutline, inRegion, clampToPlan(layout, inOutline)}) {
    offer(p);
    around(p, 0.05 * step);
    around(p, 0.5 * step);
  }
  const double reach = best ? glm::distance(*best, point) : std::numeric_limits<double>::infinity();
  double radius = std::max(glm::distance(point, inOutline), glm::distance(point, inRegion));
  for (int n = 0; n < kMostSteps && radius < reach && !(best && glm::distance(*best, point) < radius); ++n) {
    around(point, radius);
    radius += std::max(step, 0.02 * radius);
  }
  return best ? lastStanding(layout, *best, point) : point;
}

glm::dvec2 nearestStandingCentimetre(const Layout& layout, const glm::dvec2& point) {
  constexpr double kPerMetre = 100;
  constexpr int kReach = 3;
  const glm::dvec2 exact = nearestStanding(layout, point), middle = glm::round(kPerMetre * exact);
  std::optional<glm::dvec2> best;
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -kReach; y <= kReach; ++y) {
      const glm::dvec2 place = (middle + glm::dvec2(x, y)) / kPerMetre;
      const bool nearer = !best || glm::distance(place, exact) < glm::distance(*best, exact);
      if (nearer && mayStand(layout, place)) best = place;
    }
  return best.value_or(exact);
}

glm::dvec2 walkTo(const Layout& layout, const glm::dvec2& from, const glm::dvec2& to) {
  const double length = glm::distance(from, to);
  const int steps = int(std::clamp(std::ceil(length / grain(layout)), 1.0, double(kMostSteps)));
  const glm::dvec2 step = (to - from) / double(steps);
  glm::dvec2 at = from;
  for (int n = 0; n < steps; ++n) {
    if (mayStand(layout, at + step)) {
      at += step;
    } else if (const auto along = alongTheWall(layout, at, step)) {
      at = *along;
    } else {
      break;
    }
  }
  return at;
}

}  // namespace acentric
