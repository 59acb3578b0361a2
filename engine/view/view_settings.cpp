#include "engine/view/view_settings.h"

#include <fmt/format.h>

namespace acentric {

const char* nameOf(Renderer renderer) {
  switch (renderer) {
    case Renderer::list:
      return "list";
    case Renderer::scalar:
      return "scalar";
    case Renderer::zbuffer:
      return "zbuffer";
    case Renderer::gl:
      return "gl";
  }
  return "list";
}

Result<Renderer> parseRenderer(std::string_view name) {
  for (Renderer renderer : {Renderer::list, Renderer::scalar, Renderer::zbuffer, Renderer::gl})
    if (name == nameOf(renderer)) return renderer;
  return fail(ErrorKind::invalidArgument,
              fmt::format("no renderer is called '{}': use list, scalar, zbuffer or gl", name), "renderer");
}

Status ViewSettings::check() const {
  if (maxSplatPixels < 1 || maxSplatPixels > 64)
    return fail(ErrorKind::invalidArgument,
                fmt::format("largest splat of {} pixels: must lie in 1..64", maxSplatPixels),
                "view settings");
  return {};
}

}  // namespace acentric
