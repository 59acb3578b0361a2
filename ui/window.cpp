#include "ui/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
// After epoxy, which brings its own OpenGL declarations.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ui/colour.h"
#include "ui/keys.h"
#include "ui/window_picture.h"

namespace acentric::ui {
namespace {

static_assert(key::space == GLFW_KEY_SPACE && key::digit3 == GLFW_KEY_3 && key::equal == GLFW_KEY_EQUAL);
static_assert(key::a == GLFW_KEY_A && key::l == GLFW_KEY_L && key::q == GLFW_KEY_Q && key::z == GLFW_KEY_Z);
static_assert(key::t == GLFW_KEY_T && key::v == GLFW_KEY_V);
static_assert(key::escape == GLFW_KEY_ESCAPE && key::del == GLFW_KEY_DELETE && key::home == GLFW_KEY_HOME);
static_assert(key::comma == GLFW_KEY_COMMA && key::k == GLFW_KEY_K && key::f10 == GLFW_KEY_F10);
static_assert(key::leftAlt == GLFW_KEY_LEFT_ALT && key::rightAlt == GLFW_KEY_RIGHT_ALT);
static_assert(key::f7 == GLFW_KEY_F7 && key::f8 == GLFW_KEY_F8 && key::f11 == GLFW_KEY_F11);
static_assert(key::up == GLFW_KEY_UP && key::f1 == GLFW_KEY_F1 && key::f5 == GLFW_KEY_F5);
static_assert(key::k == GLFW_KEY_K && key::m == GLFW_KEY_M && key::f12 == GLFW_KEY_F12);
static_assert(key::keypadEnter == GLFW_KEY_KP_ENTER && key::rightShift == GLFW_KEY_RIGHT_SHIFT);
static_assert(mouse::right == GLFW_MOUSE_BUTTON_RIGHT && mouse::middle == GLFW_MOUSE_BUTTON_MIDDLE);
static_assert(modifier::shift == GLFW_MOD_SHIFT && modifier::control == GLFW_MOD_CONTROL &&
              modifier::alt == GLFW_MOD_ALT);

constexpr glm::ivec2 kFirstSize(1600, 900);  // on a display of 96 dpi

Window& windowOf(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }

GLFWwindow* createWithVersion(const WindowOptions& options, int major, int minor) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // a full screen stays while another window is used
  return glfwCreateWindow(kFirstSize.x, kFirstSize.y, options.title.c_str(), nullptr, nullptr);
}

/// The system's first one first.
std::vector<Monitor> monitorsThere() {
  int count = 0;
  GLFWmonitor** const found = glfwGetMonitors(&count);
  std::vector<Monitor> monitors;
  for (int m = 0; m < count; ++m) {
    const GLFWvidmode* const mode = glfwGetVideoMode(found[m]);
    if (mode == nullptr) continue;
    Monitor monitor;
    const char* const name = glfwGetMonitorName(found[m]);
    monitor.name = name != nullptr ? name : "";
    monitor.all.size = {mode->width, mode->height};
    glfwGetMonitorPos(found[m], &monitor.all.at.x, &monitor.all.at.y);
    glfwGetMonitorWorkarea(found[m], &monitor.work.at.x, &monitor.work.at.y, &monitor.work.size.x,
                           &monitor.work.size.y);
    monitors.push_back(std::move(monitor));
  }
  return monitors;
}

/// Which shows most of it; null if none does.
GLFWmonitor* monitorOf(const ScreenRect& rect) {
  int count = 0;
  GLFWmonitor** const found = glfwGetMonitors(&count);
  GLFWmonitor* most = nullptr;
  int largest = 0;
  for (int m = 0; m < count; ++m) {
    const GLFWvidmode* const mode = glfwGetVideoMode(found[m]);
    if (mode == nullptr) continue;
    glm::ivec2 at(0);
    glfwGetMonitorPos(found[m], &at.x, &at.y);
    const glm::ivec2 shared =
        glm::max(glm::ivec2(0), glm::min(rect.at + rect.size, at + glm::ivec2(mode->width, mode->height)) -
                                    glm::max(rect.at, at));
    if (shared.x * shared.y > largest) most = found[m];
    largest = std::max(largest, shared.x * shared.y);
  }
  return most;
}

std::string lastGlfwError(const char* otherwise) {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : otherwise;
}

}  // namespace

tl::expected<std::unique_ptr<Window>, std::string> Window::open(const WindowOptions& options) {
  if (glfwInit() != GLFW_TRUE)
    return tl::unexpected(
        fmt::format("no display to open a window on ({})", lastGlfwError("unknown reason")));

  std::unique_ptr<Window> window(new Window);
  constexpr std::array<std::pair<int, int>, 3> kVersions = {{{4, 5}, {4, 3}, {3, 3}}};
  for (const auto& [major, minor] : kVersions) {
    window->window_ = createWithVersion(options, major, minor);
    if (window->window_ != nullptr) break;
  }
  if (window->window_ == nullptr)
    return tl::unexpected(fmt::format("OpenGL 3.3 core is needed and not offered by this display ({})",
                                      lastGlfwError("no reason given")));

  window->title_ = options.title;
  glfwMakeContextCurrent(window->window_);
  glfwSwapInterval(1);
  window->installCallbacks();

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the layout is the program's own affair
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  window->wantedLook_ = options.look;
  window->look_ = options.look;
  if (window->look_.scale <= 0) window->look_.scale = window->displayScale();
  window->fonts_ = applyTheme(window->look_, window->missingFonts_);
  // Chains to our callbacks, which therefore must be installed already.
  if (!ImGui_ImplGlfw_InitForOpenGL(window->window_, true) || !ImGui_ImplOpenGL3_Init("#version 330 core"))
    return tl::unexpected(std::string("the interface could not be set up on this OpenGL context"));
  window->imguiReady_ = true;
  window->picture_ = std::make_unique<WindowPicture>();
  return window;
}

Window::~Window() {
  picture_.reset();
  if (imguiReady_) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
  }
  if (ImGui::GetCurrentContext() != nullptr) ImGui::DestroyContext();
  if (window_ != nullptr) glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::show(std::span<const WindowPlace> remembered, const std::optional<glm::ivec2>& size) {
  FrameSize frame;
  glfwGetWindowFrameSize(window_, &frame.left, &frame.top, &frame.right, &frame.bottom);
  const std::vector<Monitor> monitors = monitorsThere();
  const glm::ivec2 wanted(glm::vec2(kFirstSize) * displayScale());
  const PlacedWindow placed =
      size ? placeWithSize(*size, frame, monitors) : placeWindow(wanted, frame, monitors, remembered);
  normal_ = placed.rect;
  glfwSetWindowSize(window_, normal_.size.x, normal_.size.y);
  glfwSetWindowPos(window_, normal_.at.x, normal_.at.y);
  if (placed.maximised) glfwMaximizeWindow(window_);
  glfwShowWindow(window_);
}

void Window::setFullScreen(bool on) {
  if (on == isFullScreen()) return;
  if (on) {
    noteRect();
    maximised_ = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
    GLFWmonitor* const monitor = monitorOf(normal_);
    if (monitor == nullptr) return;
    const GLFWvidmode& mode = *glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode.width, mode.height, mode.refreshRate);
  } else {
    glfwSetWindowMonitor(window_, nullptr, normal_.at.x, normal_.at.y, normal_.size.x, normal_.size.y,
                         GLFW_DONT_CARE);
    if (maximised_) glfwMaximizeWindow(window_);
  }
  pacer_.request();
}

bool Window::isFullScreen() const { return glfwGetWindowMonitor(window_) != nullptr; }

std::optional<WindowPlace> Window::place() const {
  const bool maximised =
      isFullScreen() ? maximised_ : glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
  return placeToRemember({normal_, maximised}, monitorsThere());
}

void Window::noteRect() {
  if (isFullScreen() || glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE) return;
  glfwGetWindowPos(window_, &normal_.at.x, &normal_.at.y);
  glfwGetWindowSize(window_, &normal_.size.x, &normal_.size.y);
}

void Window::installCallbacks() {
  glfwSetWindowUserPointer(window_, this);
  using Kind = InputEvent::Kind;
  glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int, int action, int modifiers) {
    Window& self = windowOf(handle);
    const Kind kind = action == GLFW_PRESS    ? Kind::keyPress
                      : action == GLFW_REPEAT ? Kind::keyRepeat
                                              : Kind::keyRelease;
    self.input_.push({kind, key, modifiers, self.input_.pointer(), {}, seconds()});
    self.pacer_.request();
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* handle, int button, int action, int modifiers) {
    Window& self = windowOf(handle);
    const Kind kind = action == GLFW_PRESS ? Kind::buttonPress : Kind::buttonRelease;
    self.input_.push({kind, button, modifiers, self.input_.pointer(), {}, seconds()});
    self.pacer_.request();
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* handle, double x, double y) {
    Window& self = windowOf(handle);
    self.input_.push({Kind::move, 0, self.input_.modifiers(), {x, y}, {}, seconds()});
    self.pacer_.request();
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* handle, double x, double y) {
    Window& self = windowOf(handle);
    self.input_.push({Kind::scroll, 0, self.input_.modifiers(), self.input_.pointer(), {x, y}, seconds()});
    self.pacer_.request();
  });
  glfwSetDropCallback(window_, [](GLFWwindow* handle, int count, const char** paths) {
    Window& self = windowOf(handle);
    for (int i = 0; i < count; ++i) self.dropped_.emplace_back(paths[i]);
    self.pacer_.request();
  });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* handle) {
    Window& self = windowOf(handle);
    glfwSetWindowShouldClose(handle, GLFW_FALSE);  // the program asks about unsaved work first
    self.closeRequested_ = true;
    self.pacer_.request();
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* handle, int focused) {
    Window& self = windowOf(handle);
    if (focused == GLFW_FALSE) self.input_.releaseAll(seconds());
    self.pacer_.request();
  });
  glfwSetFramebufferSizeCallback(window_,
                                 [](GLFWwindow* handle, int, int) { windowOf(handle).pacer_.request(); });
  glfwSetWindowContentScaleCallback(
      window_, [](GLFWwindow* handle, float, float) { windowOf(handle).pacer_.request(); });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* handle) {
    windowOf(handle).exposed_ = true;
    windowOf(handle).pacer_.request();
  });
}

float Window::displayScale() const {
  float content = 1;
  glfwGetWindowContentScale(window_, &content, nullptr);
  // Where window coordinates are scaled by the system (Wayland), the framebuffer already has the pixels.
  int windowWidth = 0;
  int pixelWidth = 0;
  glfwGetWindowSize(window_, &windowWidth, nullptr);
  glfwGetFramebufferSize(window_, &pixelWidth, nullptr);
  if (windowWidth > 0 && pixelWidth > windowWidth) content *= float(windowWidth) / float(pixelWidth);
  constexpr float kLeast = 0.5F, kMost = 4;
  return std::isfinite(content) ? std::clamp(content, kLeast, kMost) : 1;
}

void Window::setLook(const Look& look) {
  wantedLook_ = look;
  pacer_.request();
}

void Window::applyLook() {
  Look look = wantedLook_;
  if (look.scale <= 0) look.scale = displayScale();
  if (look == look_) return;
  look_ = look;
  fonts_ = applyTheme(look_, missingFonts_);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  picture_->forget();
}

/// ImGui polls: a key that went down and up since the last frame would be missed by it.
void Window::feedShortPresses() {
  ImGuiIO& io = ImGui::GetIO();
  for (const int code : tapped_)
    if (!input_.keyHeld(code)) io.KeysDown[code] = false;
  tapped_.clear();
  for (const InputEvent& event : input_.pending()) {
    const bool known = event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown);
    if (event.kind != InputEvent::Kind::keyPress || !known || io.KeysDown[event.code]) continue;
    io.KeysDown[event.code] = true;
    tapped_.push_back(event.code);
  }
  if (!tapped_.empty()) pacer_.request();
  // ImGui's navigation presses buttons by Space alone; Enter shall, too, where it ends no text.
  if ((io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) == 0 || io.WantTextInput) return;
  const bool enter = io.KeysDown[key::enter] || io.KeysDown[key::keypadEnter];
  const bool tapped = std::ranges::find(tapped_, key::space) != tapped_.end();
  io.KeysDown[key::space] = enter || tapped || input_.keyHeld(key::space);
}

void Window::navigateByKeys(bool on) {
  ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
  flags = on ? flags | ImGuiConfigFlags_NavEnableKeyboard : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
}

void Window::run(const std::function<void()>& update, const std::function<void()>& draw) {
  while (!closing_) {
    const double sleep = pacer_.sleepSeconds(seconds());
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const bool hidden = glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || width < 1 || height < 1;
    if (hidden)
      glfwWaitEventsTimeout(FramePacer::kIdleSleep);
    else if (sleep > 0)
      glfwWaitEventsTimeout(sleep);
    else
      glfwPollEvents();
    update();
    if (!hidden) noteRect();
    if (!hidden && !closing_ && pacer_.shouldDraw(seconds())) drawFrame(draw);
  }
}

void Window::drawFrame(const std::function<void()>& draw) {
  FrameTime time{seconds()};
  pacer_.drawn(time.beginSeconds);
  applyLook();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  feedShortPresses();
  ImGui::NewFrame();
  draw();
  ImGui::Render();
  time.listSeconds = seconds() - time.beginSeconds;
  if (picture_->draw(*ImGui::GetDrawData(), palette::backdrop) || std::exchange(exposed_, false)) {
    picture_->show();
    if (tellFrame_) glFinish();
    glfwSwapBuffers(window_);
  }
  ++frames_;
  time.renderSeconds = seconds() - time.beginSeconds - time.listSeconds;
  lastFrame_ = time;
  if (tellFrame_) tellFrame_(time);
}

bool Window::takeCloseRequest() { return std::exchange(closeRequested_, false); }

void Window::wake() { glfwPostEmptyEvent(); }
double Window::seconds() { return glfwGetTime(); }

std::vector<std::filesystem::path> Window::takeDropped() { return std::exchange(dropped_, {}); }

void Window::setTitle(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::capturePointer(bool captured) {
  if (captured == captured_) return;
  captured_ = captured;
  glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

std::string Window::graphicsDescription() const {
  return fmt::format("OpenGL {}.{}, {}", epoxy_gl_version() / 10, epoxy_gl_version() % 10,
                     static_cast<const char*>(static_cast<const void*>(glGetString(GL_RENDERER))));
}

glm::ivec2 Window::size() const {
  glm::ivec2 result{0};
  glfwGetWindowSize(window_, &result.x, &result.y);
  return result;
}

}  // namespace acentric::ui
