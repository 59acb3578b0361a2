#include "editor/commands/outline_edits.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/commands/layout_edits.h"
#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/inspect/simplify_outline.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

struct Side {
  std::size_t loop, number, of;  ///< the number-th of `of` sides of a loop
  glm::dvec2 from, to;
};

std::vector<Side> sidesOf(const Outline& outline) {
  std::vector<Side> sides;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const auto& loop = outline.loops[l];
    for (std::size_t k = 0; k < loop.size(); ++k)
      sides.push_back({l, k, loop.size(), loop[k], loop[(k + 1) % loop.size()]});
  }
  std::ranges::sort(sides, {}, [](const Side& side) { return std::min(side.from.x, side.to.x); });
  return sides;
}

bool adjoin(const Side& a, const Side& b) {
  return a.loop == b.loop && ((a.number + 1) % a.of == b.number || (b.number + 1) % b.of == a.number);
}

bool onSide(const Side& side, const glm::dvec2& point) {
  return orientation(side.from, side.to, point) == 0 && glm::dot(point - side.from, point - side.to) <= 0;
}

std::string nameOf(const Side& side) {
  return trf("side {}{}", side.number + 1, side.loop == 0 ? "" : trf(" of loop {}", side.loop + 1));
}

std::optional<OutlineFault> faultOf(const Side& a, const Side& b) {
  const glm::dvec2 along = a.to - a.from, across = b.to - b.from;
  const int abFrom = orientation(a.from, a.to, b.from), abTo = orientation(a.from, a.to, b.to);
  const int baFrom = orientation(b.from, b.to, a.from), baTo = orientation(b.from, b.to, a.to);
  if (abFrom * abTo < 0 && baFrom * baTo < 0) {
    const double t = cross(b.from - a.from, across) / cross(along, across);
    return OutlineFault{a.from + t * along, trf("{} crosses {}", nameOf(a), nameOf(b))};
  }
  const bool neighbours = adjoin(a, b);
  for (const auto& [side, point] : {std::pair(&a, b.from), {&a, b.to}, {&b, a.from}, {&b, a.to}}) {
    if (neighbours && (point == side->from || point == side->to)) continue;
    if (onSide(*side, point)) return OutlineFault{point, trf("{} touches {}", nameOf(a), nameOf(b))};
  }
  return std::nullopt;
}

/// Do all corners lie on one line?
bool flat(const std::vector<glm::dvec2>& loop) {
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    if (orientation(loop[0], loop[k], loop[k + 1]) != 0) return false;
  return true;
}

/// Twice the signed area.
double turnOf(const std::vector<glm::dvec2>& loop) {
  double twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    twice += cross(loop[k] - loop[0], loop[(k + 1) % loop.size()] - loop[0]);
  return twice;
}

}  // namespace

Edit simplifyOutline(const Project& project, double metres) {
  Edit edit = setOutline(project, acentric::simplifyOutline(project.layout().outline, metres));
  edit.label = tr("Simplify outline");
  return edit;
}

std::size_t cornersOf(const Outline& outline) {
  std::size_t corners = 0;
  for (const auto& loop : outline.loops) corners += loop.size();
  return corners;
}

std::vector<OutlineFault> outlineFaults(const Outline& outline, std::size_t most) {
  std::vector<OutlineFault> faults;
  for (std::size_t l = 0; l < outline.loops.size() && faults.size() < most; ++l)
    if (flat(outline.loops[l]))
      faults.push_back({outline.loops[l].front(), trf("loop {} has no area", l + 1)});
  const std::vector<Side> sides = sidesOf(outline);
  for (std::size_t a = 0; a < sides.size(); ++a) {
    const double end = std::max(sides[a].from.x, sides[a].to.x);
    for (std::size_t b = a + 1; b < sides.size() && faults.size() < most; ++b) {
      if (std::min(sides[b].from.x, sides[b].to.x) > end) break;
      if (auto fault = faultOf(sides[a], sides[b])) faults.push_back(std::move(*fault));
    }
  }
  return faults;
}

std::vector<LoopArea> loopAreas(const Outline& outline) {
  std::vector<LoopArea> areas;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const auto& loop = outline.loops[l];
    glm::dvec2 low(loop.front()), high(loop.front());
    for (const glm::dvec2& corner : loop) low = glm::min(low, corner), high = glm::max(high, corner);
    int around = 0;
    for (std::size_t other = 0; other < outline.loops.size(); ++other)
      around += other != l && Outline{{outline.loops[other]}}.contains(loop.front()) ? 1 : 0;
    areas.push_back({std::abs(turnOf(loop)) / 2, around % 2 == 1, {0.5 * (low.x + high.x), high.y}});
  }
  return areas;
}

}  // namespace acentric::editor
