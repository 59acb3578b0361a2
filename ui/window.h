#pragma once
/// The program's window: GLFW, an OpenGL core context and ImGui on it. Everything but wake() belongs to the
/// main thread.

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "ui/frame_pacer.h"
#include "ui/input_queue.h"
#include "ui/theme.h"

struct GLFWwindow;

namespace acentric::ui {

/// How long the newest frame took, for measuring.
struct FrameTime {
  double beginSeconds = 0;   ///< Window::seconds() at its beginning
  double listSeconds = 0;    ///< the program's draw function
  double renderSeconds = 0;  ///< the graphics card's work, waited for, and showing it
};

struct WindowOptions {
  std::string title;
  int width = 1600;  ///< screen coordinates
  int height = 900;
  bool maximised = false;
};

class Window {
 public:
  /// Tries OpenGL 4.5, 4.3 and 3.3 core. The error is one line for a person.
  static tl::expected<std::unique_ptr<Window>, std::string> open(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

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
  /// Files dropped on the window since the last call.
  std::vector<std::filesystem::path> takeDropped();
  void setTitle(const std::string& title);
  /// Hides the pointer and lets it move without bounds (mouse look); the position is restored afterwards.
  void capturePointer(bool captured);
  std::string graphicsDescription() const;
  const std::string& missingFont() const { return missingFont_; }
  glm::ivec2 size() const;
  unsigned long framesDrawn() const { return frames_; }
  /// From now on every frame is waited for and handed to `tell` (empty: no longer).
  void measureFrames(std::function<void(const FrameTime&)> tell) { tellFrame_ = std::move(tell); }

 private:
  Window() = default;
  void installCallbacks();
  void drawFrame(const std::function<void()>& draw);

  GLFWwindow* window_ = nullptr;
  bool imguiReady_ = false;
  FramePacer pacer_;
  InputQueue input_;
  Fonts fonts_;
  std::string missingFont_;
  std::string title_;
  std::vector<std::filesystem::path> dropped_;
  bool closing_ = false;
  bool closeRequested_ = false;
  bool captured_ = false;
  unsigned long frames_ = 0;
  std::function<void(const FrameTime&)> tellFrame_;
};

}  // namespace acentric::ui
