#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "engine/view_gl/gl_renderer.h"

namespace acentric {
namespace {

const char* nameOfEglError(EGLint error) {
  switch (error) {
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return "an unknown EGL error";
  }
}

tl::unexpected<Error> noContext(const std::string& what) {
  return fail(
      ErrorKind::unsupported,
      what +
          ": use one of the CPU renderers (list, scalar, zbuffer), or install an OpenGL 4.3 driver with EGL",
      "OpenGL without a window");
}

bool lists(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  const std::string_view all(extensions);
  for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
    const bool starts = at == 0 || all[at - 1] == ' ';
    const std::size_t end = at + name.size();
    if (starts && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

/// Displays that need no window system, best first: graphics cards, Mesa's surfaceless platform (which may
/// be a card's too), software devices.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> cards, others;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(client, "EGL_EXT_platform_base")) return {};
  const auto add = [](std::vector<EGLDisplay>& to, EGLDisplay display) {
    if (display != EGL_NO_DISPLAY) to.push_back(display);
  };
  if (lists(client, "EGL_MESA_platform_surfaceless"))
    add(others, eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (lists(client, "EGL_EXT_platform_device") && lists(client, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count) == EGL_TRUE)
      for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[std::size_t(i)];
        const bool software =
            lists(client, "EGL_EXT_device_query") &&
            lists(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        add(software ? others : cards, eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
      }
  }
  cards.insert(cards.end(), others.begin(), others.end());
  return cards;
}

/// An OpenGL 4.3 core context of the display, made current.
Result<EGLContext> currentContext(EGLDisplay display) {
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
    return noContext("EGL offers no display without a window system");
  if (!lists(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context") &&
      epoxy_egl_version(display) < 15)
    return noContext("this EGL cannot make a context current without a surface");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return noContext("this EGL offers no desktop OpenGL");

  const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                        EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &configs) != EGL_TRUE || configs < 1)
    return noContext("EGL offers no configuration for desktop OpenGL");

#ifdef NDEBUG
  constexpr EGLint debug = EGL_FALSE;
#else
  constexpr EGLint debug = EGL_TRUE;
#endif
  const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_CONTEXT_OPENGL_DEBUG,
                                            debug,
                                            EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT)
    return noContext(fmt::format("EGL gave no OpenGL 4.3 core context ({})", nameOfEglError(eglGetError())));
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    const EGLint error = eglGetError();
    eglDestroyContext(display, context);
    return noContext(fmt::format("the OpenGL context could not be made current ({})", nameOfEglError(error)));
  }
  return context;
}

}  // namespace

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::create() {
  Result<EGLContext> context = noContext("EGL offers no display without a window system");
  for (const EGLDisplay display : displays()) {
    context = currentContext(display);
    if (!context) continue;
    std::unique_ptr<HeadlessContext> headless(new HeadlessContext);
    headless->display_ = display;
    headless->context_ = *context;
    return headless;
  }
  return tl::unexpected(context.error());
}

HeadlessContext::~HeadlessContext() {
  // The display stays initialised: it is one per process, and another context may be using it.
  if (eglGetCurrentContext() == context_)
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

std::string HeadlessContext::description() const {
  std::string text;
  for (GLenum name : {GL_RENDERER, GL_VERSION}) {
    const GLubyte* value = glGetString(name);
    if (!text.empty()) text += ", OpenGL ";
    text += value == nullptr ? "unknown" : reinterpret_cast<const char*>(value);
  }
  return text;
}

}  // namespace acentric
