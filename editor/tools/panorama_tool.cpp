#include "editor/tools/panorama_tool.h"

#include "ui/keys.h"

namespace acentric::editor {

std::optional<int> freeApvAt(const LayoutSpec& spec, const glm::dvec2& point, double pixelsPerMetre) {
  std::optional<int> found;
  double nearest = kGrabPixels / pixelsPerMetre;
  for (const auto& [number, apv] : spec.freeApvs)
    if (const double distance = glm::distance(apv.centre, point); distance <= nearest)
      nearest = distance, found = number;
  if (found) return found;
  for (const auto& [number, apv] : spec.freeApvs)
    if (!apv.traditional() && polygonOf(apv).contains(point)) return number;
  return std::nullopt;
}

PanoramaIntent PanoramaTool::press(const PointerEvent& event, const LayoutSpec& spec, double pixelsPerMetre) {
  pressed_ = true;
  dragged_ = false;
  pressScreen_ = event.screen;
  number_ = freeApvAt(spec, event.world, pixelsPerMetre);
  if (number_ && (event.modifiers & ui::modifier::control) != 0) {
    pressed_ = false;
    return RemoveApvIntent{*number_};
  }
  apv_ = number_ ? spec.freeApvs.at(*number_) : Apv{event.world, {spec.cellSize, 0}};
  grabOffset_ = apv_.centre - event.world;
  return {};
}

PanoramaIntent PanoramaTool::move(const PointerEvent& event) {
  if (!pressed_) return {};
  dragged_ = dragged_ || glm::distance(event.screen, pressScreen_) > kDragPixels;
  if (!dragged_) return {};
  if (!number_) {
    apv_.offset = event.world - apv_.centre;
    return {};
  }
  apv_.centre = event.world + grabOffset_;
  return FreeApvIntent{number_, apv_, false};
}

PanoramaIntent PanoramaTool::release(const PointerEvent& event) {
  if (!pressed_) return {};
  const PanoramaIntent last = move(event);
  pressed_ = false;
  if (!number_) return FreeApvIntent{std::nullopt, apv_, true};
  if (!dragged_) return SelectApvIntent{*number_};
  return FreeApvIntent{number_, std::get<FreeApvIntent>(last).apv, true};
}

bool PanoramaTool::cancel() {
  const bool afoot = pressed_;
  pressed_ = dragged_ = false;
  return afoot;
}

}  // namespace acentric::editor
