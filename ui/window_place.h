#pragma once
/// Where a window opens: within the work area of a monitor that is there, as it was left on that monitor.
/// Pure. All lengths are screen coordinates (GLFW's), y down; a window's rectangle is that of its content,
/// without the frame that the system draws around it.

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace acentric::ui {

struct ScreenRect {
  glm::ivec2 at{0}, size{0};
  bool operator==(const ScreenRect&) const = default;
};

struct Monitor {
  std::string name;
  ScreenRect all;   ///< what it shows of the desktop
  ScreenRect work;  ///< without panels and docks
};

/// Thickness of the system's frame on each side.
struct FrameSize {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A window as it was left. Monitors are told apart by name and size: one that is plugged in again, or set to
/// another resolution, has its own.
struct WindowPlace {
  std::string monitor;
  glm::ivec2 monitorSize{0};
  ScreenRect rect;  ///< when not maximised; `at` counts from the corner of the work area
  bool maximised = false;
  bool operator==(const WindowPlace&) const = default;
};

struct PlacedWindow {
  ScreenRect rect;  ///< when not maximised
  bool maximised = false;
  bool operator==(const PlacedWindow&) const = default;
};

/// `wanted`: the size of a window that was never placed. On the monitor where one was left last that is still
/// there, else on the first, its middle; a size that does not fit is cut, and the window maximised.
/// `monitors`: the system's first one first; without any the window opens with the wanted size. `remembered`:
/// newest first.
PlacedWindow placeWindow(const glm::ivec2& wanted, const FrameSize& frame, std::span<const Monitor> monitors,
                         std::span<const WindowPlace> remembered);
/// The same with a size that is kept even where it does not fit: its upper left corner is on the screen.
PlacedWindow placeWithSize(const glm::ivec2& size, const FrameSize& frame, std::span<const Monitor> monitors);

/// To be remembered: on the monitor that shows most of it. Nothing if none does.
std::optional<WindowPlace> placeToRemember(const PlacedWindow& window, std::span<const Monitor> monitors);

/// Puts the newest first, in place of what was known of its monitor; the oldest are forgotten.
void remember(std::vector<WindowPlace>& places, WindowPlace newest);
inline constexpr std::size_t kMostWindowPlaces = 8;

}  // namespace acentric::ui
