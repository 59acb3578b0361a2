#include "engine/pipeline/walk_ground.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/geometry/conventions.h"
#include "engine/layout/storey_choice.h"
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

/// Walks in small steps; `standAt` says of each whether it can be made, and makes it. A step that cannot is
/// turned by as little as lets one stand there, and keeps as much of it as leads that way: against a wall
/// head-on nearly nothing.
template <class StandAt>
void walkInSteps(const glm::dvec2& from, const glm::dvec2& to, double grain, const StandAt& standAt) {
  constexpr int kTurns = 45;
  const int steps = int(std::clamp(std::ceil(glm::distance(from, to) / grain), 1.0, double(kMostSteps)));
  const glm::dvec2 step = (to - from) / double(steps);
  glm::dvec2 at = from;
  const auto take = [&](double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    const glm::dvec2 next = at + c * glm::dvec2(c * step.x - s * step.y, s * step.x + c * step.y);
    const bool taken = standAt(next);
    if (taken) at = next;
    return taken;
  };
  const auto slide = [&] {
    for (int n = 1; n <= kTurns; ++n)
      for (const int side : {1, -1})
        if (take(side * n * radians(89.0) / kTurns)) return true;
    return false;
  };
  for (int n = 0; n < steps; ++n)
    if (!take(0) && !slide()) return;
}

/// Metres from the nearest edge of an outline.
double borderDistance(const Outline& outline, const glm::dvec2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& loop : outline.loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const glm::dvec2 &a = loop[k], edge = loop[k + 1 == loop.size() ? 0 : k + 1] - a;
      const double squared = glm::dot(edge, edge);
      const double share = squared > 0 ? std::clamp(glm::dot(point - a, edge) / squared, 0.0, 1.0) : 0;
      least = std::min(least, glm::distance(point, a + share * edge));
    }
  return least;
}

constexpr double kStepApart = 0.35;   // metres: from ground to ground
constexpr double kSameGround = 0.05;  // metres: layouts of one floor are not walked between
constexpr double kGoesOver = 0.3;     // metres within which one's ground goes over to another's
constexpr double kAsGood = 0.03;      // metres that another's cameras must fit better

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
  glm::dvec2 at = from;
  walkInSteps(from, to, grain(layout), [&](const glm::dvec2& next) {
    const bool stands = mayStand(layout, next);
    if (stands) at = next;
    return stands;
  });
  return at;
}

StoreyGround::StoreyGround(std::vector<std::shared_ptr<const Layout>> storeys, bool whole) : whole_(whole) {
  for (auto& layout : storeys) {
    Ground ground{std::move(layout), glm::dvec2(std::numeric_limits<double>::infinity()),
                  glm::dvec2(-std::numeric_limits<double>::infinity())};
    if (!ground.layout) ground.layout = std::make_shared<const Layout>();
    for (const Region& region : ground.layout->regions)
      for (const glm::dvec2& corner : region.polygon.corners)
        ground.low = glm::min(ground.low, corner), ground.high = glm::max(ground.high, corner);
    const LayoutSpec& spec = ground.layout->spec;
    constexpr double kLeastRise = 0.01;  // metres per metre: a landing has no ends
    if (spec.slope && glm::length(spec.slope->rise) >= kLeastRise && !spec.outline.empty()) {
      ground.along = glm::normalize(spec.slope->rise);
      ground.lower = std::numeric_limits<double>::infinity(), ground.upper = -ground.lower;
      for (const auto& loop : spec.outline.loops)
        for (const glm::dvec2& corner : loop) {
          ground.lower = std::min(ground.lower, glm::dot(corner, ground.along));
          ground.upper = std::max(ground.upper, glm::dot(corner, ground.along));
        }
    }
    storeys_.push_back(std::move(ground));
  }
}

/// Metres from where the storey ends, kGoesOver at most, and never quite 0: for stairs their ends, not their
/// sides.
double StoreyGround::Ground::within(const glm::dvec2& place) const {
  const Outline& outline = layout->spec.outline;
  double away = kGoesOver;
  if (along != glm::dvec2(0)) {
    const double at = glm::dot(place, along);
    away = std::min(at - lower, upper - at);
  } else if (!outline.empty()) {
    away = borderDistance(outline, place);
  }
  return std::clamp(away, 1e-9, kGoesOver);
}

bool StoreyGround::rises() const {
  return std::ranges::any_of(storeys_,
                             [](const Ground& ground) { return ground.layout->spec.slope.has_value(); });
}

int StoreyGround::storeyAt(const glm::dvec3& eye) const {
  const auto misfit = [&](const Ground& ground) { return misfitOf(*ground.layout, eye); };
  return int(std::ranges::min_element(storeys_, {}, misfit) - storeys_.begin());
}

bool StoreyGround::holds(int storey, const glm::dvec3& eye) const {
  const glm::dvec2 place(eye);
  if (!whole_ && !layout(storey).regionAt(place)) return true;
  return storeys_[std::size_t(storey)].holds(place) ||
         (rises() && storeys_[std::size_t(storeyAt(eye))].holds(place));
}

bool StoreyGround::Ground::holds(const glm::dvec2& place) const {
  return place.x >= low.x && place.y >= low.y && place.x <= high.x && place.y <= high.y &&
         mayStand(*layout, place);
}

/// Stairs with all that they touch; floors that are a step apart.
bool StoreyGround::joined(int from, int to) const {
  const LayoutSpec &a = layout(from).spec, &b = layout(to).spec;
  return a.slope || b.slope || std::abs(a.floorHeight - b.floorHeight) > kSameGround;
}

std::optional<Footing> StoreyGround::on(int storey, const glm::dvec2& place) const {
  if (!storeys_[std::size_t(storey)].holds(place)) return std::nullopt;
  return beside({storey, place, layout(storey).spec.groundAt(place)}, place);
}

std::optional<Footing> StoreyGround::beside(const Footing& from, const glm::dvec2& place) const {
  std::vector<int> holding;
  double stairs = 0;  // what pieces count, up to all of it
  for (std::size_t s = 0; s < storeys_.size(); ++s) {
    const LayoutSpec& spec = storeys_[s].layout->spec;
    if (std::abs(spec.groundAt(place) - from.ground) > kStepApart || !storeys_[s].holds(place)) continue;
    if (int(s) != from.storey && !joined(from.storey, int(s))) continue;
    holding.push_back(int(s));
    if (spec.slope) stairs = std::min(stairs + storeys_[s].within(place) / kGoesOver, 1.0);
  }
  if (holding.empty()) return std::nullopt;
  double sum = 0, ground = 0;
  for (const int storey : holding) {
    const LayoutSpec& spec = layout(storey).spec;
    const double left = spec.slope ? 1 : 1 + 1e-9 - stairs;
    const double weight = left * storeys_[std::size_t(storey)].within(place);
    sum += weight, ground += weight * spec.groundAt(place);
  }
  ground /= sum;
  const auto misfit = [&](int storey) {
    return std::abs(ground - layout(storey).spec.floorHeight) - (storey == from.storey ? kAsGood : 0);
  };
  return Footing{*std::ranges::min_element(holding, {}, misfit), place, ground};
}

Footing StoreyGround::walk(const Footing& from, const glm::dvec2& to) const {
  Footing at = from;
  walkInSteps(from.place, to, grain(layout(from.storey)), [&](const glm::dvec2& next) {
    const auto footing = beside(at, next);
    if (footing) at = *footing;
    return footing.has_value();
  });
  return at;
}

}  // namespace acentric
