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

const char* nameOf(Reconstruction reconstruction) {
  switch (reconstruction) {
    case Reconstruction::point:
      return "point";
    case Reconstruction::splat:
      return "splat";
    case Reconstruction::filtered:
      return "filtered";
  }
  return "splat";
}

Result<Reconstruction> parseReconstruction(std::string_view name) {
  for (Reconstruction reconstruction : kReconstructions)
    if (name == nameOf(reconstruction)) return reconstruction;
  return fail(ErrorKind::invalidArgument,
              fmt::format("no reconstruction is called '{}': use point, splat or filtered", name),
              "reconstruction");
}

Status ViewSettings::check() const {
  if (maxSplatPixels < 1 || maxSplatPixels > 64)
    return fail(ErrorKind::invalidArgument,
                fmt::format("largest splat of {} pixels: must lie in 1..64", maxSplatPixels),
                "view settings");
  return {};
}

}  // namespace acentric
