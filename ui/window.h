#pragma once
/// The program's window: GLFW, an OpenGL core context and ImGui on it. Everything but wake() belongs to the
/// main thread.

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "ui/frame_pacer.h"
#include "ui/input_queue.h"
#include "ui/theme.h"
#include "ui/window_place.h"

struct GLFWwindow;

namespace acentric::ui {

class WindowPicture;

/// How long a frame took.
struct FrameTime {
  double beginSeconds = 0;  ///< Window::seconds() at its beginning
  double listSeconds = 0;   ///< the program's draw function
  /// Handing it to the graphics card and showing it, with what the driver makes of that; of measured frames
  /// all of the graphics card's work.
  double renderSeconds = 0;
};

struct WindowOptions {
  std::string title;
  Look look = {.scale = 0};  ///< scale 0: the display's
};

class Window {
 public:
  /// Hidden until show(). Tries OpenGL 4.5, 4.3 and 3.3 core. The error is one line for a person.
  static tl::expected<std::unique_ptr<Window>, std::string> open(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Where and as large as it was left (window_place.h); `size`: just so large, screen coordinates.
  void show(std::span<const WindowPlace> remembered, const std::optional<glm::ivec2>& size);
  /// Where it is now, to be shown there again; nothing where no monitor shows it.
  std::optional<WindowPlace> place() const;

  /// Covers the monitor that it is mostly on, without a frame; back where it was.
  void setFullScreen(bool on);

  /// Until close() is called: waits for events, calls `update` after every wake (it may request frames
  /// through pacer()), and `draw` between an ImGui frame's begin and end whenever a frame is due.
  void run(const std::function<void()>& update, const std::function<void()>& draw);
  void close() { closing_ = true; }
  /// True once after the user pressed the window's close button.
  bool takeCloseRequest();

  /// Ends the wait of run(); from any thread, while the window lives.
  static void wake();
  static double seconds();  ///< monotonic

  FramePacer& pacer() { return pacer_; }
  InputQueue& input() { return input_; }
  const Fonts& fonts() const { return fonts_; }
  /// Applied before the next frame. `scale` 0: that of the display the window is on.
  void setLook(const Look& look);
  const Look& look() const { return look_; }
  /// Do the arrow keys, Space and Enter go to widgets (ImGui's keyboard navigation)?
  void navigateByKeys(bool on);
  /// Files dropped on the window since the last call.
  std::vector<std::filesystem::path> takeDropped();
  void setTitle(const std::string& title);
  /// Hides the pointer and lets it move without bounds (mouse look); the position is restored afterwards.
  void capturePointer(bool captured);
  std::string graphicsDescription() const;
  /// Of each a sentence.
  const std::vector<std::string>& missingFonts() const { return missingFonts_; }
  glm::ivec2 size() const;
  unsigned long framesDrawn() const { return frames_; }
  const FrameTime& lastFrame() const { return lastFrame_; }
  /// From now on every frame is waited for and handed to `tell` (empty: no longer).
  void measureFrames(std::function<void(const FrameTime&)> tell) { tellFrame_ = std::move(tell); }

 private:
  Window() = default;
  void installCallbacks();
  void drawFrame(const std::function<void()>& draw);
  void applyLook();
  float displayScale() const;
  void noteRect();
  bool isFullScreen() const;
  void feedShortPresses();

  GLFWwindow* window_ = nullptr;
  bool imguiReady_ = false;
  std::unique_ptr<WindowPicture> picture_;
  bool exposed_ = false;  ///< the system lost what the window showed
  FramePacer pacer_;
  InputQueue input_;
  Look look_, wantedLook_;  // wanted: its scale may be 0
  Fonts fonts_;
  std::vector<int> tapped_;  // keys shown to ImGui for this frame though they are up again
  std::vector<std::string> missingFonts_;
  std::string title_;
  std::vector<std::filesystem::path> dropped_;
  bool maximised_ = false;  ///< before it covered the monitor
  bool closing_ = false;
  bool closeRequested_ = false;
  bool captured_ = false;
  unsigned long frames_ = 0;
  FrameTime lastFrame_;
  std::function<void(const FrameTime&)> tellFrame_;
  ScreenRect normal_;  ///< where it is, or was before it was maximised
};

}  // namespace acentric::ui
