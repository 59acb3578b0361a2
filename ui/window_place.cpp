#include "ui/window_place.h"

#include <algorithm>
#include <cstdint>

namespace acentric::ui {
namespace {

bool isOf(const WindowPlace& place, const Monitor& monitor) {
  return place.monitor == monitor.name && place.monitorSize == monitor.all.size;
}

/// What a window's content may take of a monitor; of one that tells no work area, of all that it shows.
ScreenRect roomOn(const Monitor& monitor, const FrameSize& frame) {
  const bool told = monitor.work.size.x > 0 && monitor.work.size.y > 0;
  const ScreenRect& area = told ? monitor.work : monitor.all;
  return {area.at + glm::ivec2(frame.left, frame.top),
          glm::max(area.size - glm::ivec2(frame.left + frame.right, frame.top + frame.bottom), 1)};
}

/// Cut to the room, and moved into it by as little as needed.
ScreenRect within(const ScreenRect& rect, const ScreenRect& room) {
  const glm::ivec2 size = glm::clamp(rect.size, glm::ivec2(1), room.size);
  return {glm::clamp(rect.at, room.at, room.at + room.size - size), size};
}

ScreenRect inTheMiddle(const glm::ivec2& size, const ScreenRect& room) {
  return {room.at + (room.size - size) / 2, size};
}

std::int64_t sharedArea(const ScreenRect& a, const ScreenRect& b) {
  const glm::ivec2 low = glm::max(a.at, b.at), high = glm::min(a.at + a.size, b.at + b.size);
  return high.x > low.x && high.y > low.y ? std::int64_t(high.x - low.x) * (high.y - low.y) : 0;
}

}  // namespace

PlacedWindow placeWindow(const glm::ivec2& wanted, const FrameSize& frame, std::span<const Monitor> monitors,
                         std::span<const WindowPlace> remembered) {
  for (const WindowPlace& place : remembered) {
    const auto monitor = std::ranges::find_if(monitors, [&](const Monitor& m) { return isOf(place, m); });
    if (monitor == monitors.end()) continue;
    const ScreenRect room = roomOn(*monitor, frame);
    return {within({monitor->work.at + place.rect.at, place.rect.size}, room), place.maximised};
  }
  if (monitors.empty()) return {{{0, 0}, wanted}, false};
  const ScreenRect room = roomOn(monitors.front(), frame);
  const bool fits = wanted.x <= room.size.x && wanted.y <= room.size.y;
  return {inTheMiddle(glm::min(wanted, room.size), room), !fits};
}

PlacedWindow placeWithSize(const glm::ivec2& size, const FrameSize& frame,
                           std::span<const Monitor> monitors) {
  if (monitors.empty()) return {{{0, 0}, size}, false};
  const ScreenRect room = roomOn(monitors.front(), frame);
  return {{glm::max(inTheMiddle(size, room).at, room.at), size}, false};
}

std::optional<WindowPlace> placeToRemember(const PlacedWindow& window, std::span<const Monitor> monitors) {
  const auto shown = [&](const Monitor& monitor) { return sharedArea(window.rect, monitor.all); };
  const auto most = std::ranges::max_element(monitors, {}, shown);
  if (most == monitors.end() || shown(*most) == 0) return std::nullopt;
  return WindowPlace{
      most->name, most->all.size, {window.rect.at - most->work.at, window.rect.size}, window.maximised};
}

void remember(std::vector<WindowPlace>& places, WindowPlace newest) {
  std::erase_if(places, [&](const WindowPlace& place) {
    return place.monitor == newest.monitor && place.monitorSize == newest.monitorSize;
  });
  places.insert(places.begin(), std::move(newest));
  if (places.size() > kMostWindowPlaces) places.resize(kMostWindowPlaces);
}

}  // namespace acentric::ui
