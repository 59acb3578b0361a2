#include "editor/tools/outline_tool.h"

#include <algorithm>
#include <utility>

#include "engine/geometry/predicates/orientation.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

using Loop = std::vector<glm::dvec2>;

glm::dvec2 nearestOnSide(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  return length2 > 0 ? a + std::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) * along : a;
}

bool cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

bool cross(const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (cross(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
  return false;
}

}  // namespace

OutlineHit hitOutline(const Outline& outline, const glm::dvec2& point, double pixelsPerMetre) {
  OutlineHit hit;
  double nearest = kGrabPixels / pixelsPerMetre;
  const auto take = [&](OutlineHit::Kind kind, std::size_t loop, std::size_t corner,
                        const glm::dvec2& place) {
    const double distance = glm::distance(place, point);
    if (distance > nearest) return;
    nearest = distance;
    hit = {kind, loop, corner, place};
  };
  for (std::size_t l = 0; l < outline.loops.size(); ++l)
    for (std::size_t k = 0; k < outline.loops[l].size(); ++k)
      take(OutlineHit::Kind::corner, l, k, outline.loops[l][k]);
  if (hit.kind == OutlineHit::Kind::corner) return hit;  // corners lie on sides, and come first
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const Loop& loop = outline.loops[l];
    for (std::size_t k = 0; k < loop.size(); ++k)
      take(OutlineHit::Kind::side, l, k, nearestOnSide(loop[k], loop[(k + 1) % loop.size()], point));
  }
  return hit;
}

Outline withLoop(const Outline& outline, Loop loop) {
  Outline changed = outline;
  if (loop.size() < 3) return changed;
  const Outline drawn{{loop}};
  std::vector<Loop> replaced;
  for (const Loop& other : outline.loops)
    if (cross(loop, other) || drawn.contains(other.front())) replaced.push_back(other);
  std::erase_if(changed.loops, [&](const Loop& other) {
    return std::ranges::any_of(replaced, [&](const Loop& gone) {
      return other == gone || Outline{{gone}}.contains(other.front());  // its holes go with it
    });
  });
  changed.loops.push_back(std::move(loop));
  return changed;
}

std::optional<OutlineIntent> OutlineTool::press(const PointerEvent& event, const Outline& outline,
                                                double pixelsPerMetre) {
  outline_ = outline;
  const OutlineHit hit = corners_.empty() ? hitOutline(outline, event.world, pixelsPerMetre) : OutlineHit{};
  onFreeGround_ = hit.kind == OutlineHit::Kind::nothing;
  pressScreen_ = event.screen;
  pressWorld_ = event.world;
  if (onFreeGround_) return std::nullopt;
  Outline changed = outline;
  Loop& loop = changed.loops[hit.loop];
  if (hit.kind == OutlineHit::Kind::corner && (event.modifiers & ui::modifier::control) != 0) {
    loop.erase(loop.begin() + std::ptrdiff_t(hit.corner));
    if (loop.size() < 3) changed.loops.erase(changed.loops.begin() + std::ptrdiff_t(hit.loop));
    return OutlineIntent{std::move(changed), true};
  }
  const bool side = hit.kind == OutlineHit::Kind::side;
  const std::size_t corner = side ? hit.corner + 1 : hit.corner;
  if (side) loop.insert(loop.begin() + std::ptrdiff_t(corner), hit.place);
  drag_ = Drag{std::move(changed), hit.loop, corner, hit.place - event.world, side};
  return side ? std::optional(OutlineIntent{drag_->outline, false}) : std::nullopt;
}

std::optional<OutlineIntent> OutlineTool::move(const PointerEvent& event) {
  const bool dragged = glm::distance(event.screen, pressScreen_) > kDragPixels;
  if (onFreeGround_ && corners_.empty() && (dragged || opposite_)) opposite_ = event.world;
  if (!drag_) return std::nullopt;
  drag_->outline.loops[drag_->loop][drag_->corner] = event.world + drag_->offset;
  drag_->changed = true;
  return OutlineIntent{drag_->outline, false};
}

std::optional<OutlineIntent> OutlineTool::release(const PointerEvent& event, double pixelsPerMetre) {
  if (const auto drag = std::exchange(drag_, std::nullopt))
    return drag->changed ? std::optional(OutlineIntent{drag->outline, true}) : std::nullopt;
  if (!std::exchange(onFreeGround_, false)) return std::nullopt;
  if (opposite_) {
    opposite_ = event.world;
    std::vector<glm::dvec2> loop = rectangle();
    opposite_.reset();
    if (loop.empty()) return std::nullopt;
    return OutlineIntent{withLoop(outline_, std::move(loop)), true};
  }
  const bool closes =
      corners_.size() >= 3 && glm::distance(event.world, corners_.front()) * pixelsPerMetre <= kGrabPixels;
  if (closes) return close();
  corners_.push_back(event.world);
  return std::nullopt;
}

std::vector<glm::dvec2> OutlineTool::rectangle() const {
  if (!opposite_ || opposite_->x == pressWorld_.x || opposite_->y == pressWorld_.y) return {};
  const glm::dvec2 low = glm::min(pressWorld_, *opposite_), high = glm::max(pressWorld_, *opposite_);
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::optional<OutlineIntent> OutlineTool::close() {
  if (corners_.size() < 3) return std::nullopt;
  return OutlineIntent{withLoop(outline_, std::exchange(corners_, {})), true};
}

bool OutlineTool::cancel() {
  const bool afoot = drag_ || !corners_.empty() || opposite_;
  opposite_.reset();
  drag_.reset();
  corners_.clear();
  onFreeGround_ = false;
  return afoot;
}

}  // namespace acentric::editor
