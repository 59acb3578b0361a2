#include "engine/view/view_settings.h"

#include <fmt/format.h>

#include <array>

namespace acentric {

Renderer withoutOpenGl(Renderer renderer) { return onOpenGl(renderer) ? Renderer::list : renderer; }

const char* nameOf(Renderer renderer) {
  constexpr std::array kNames{"list", "scalar", "double", "zbuffer", "gl"};
  return kNames[std::size_t(renderer)];
}

Result<Renderer> parseRenderer(std::string_view name) {
  for (Renderer renderer : kRenderers)
    if (name == nameOf(renderer)) return renderer;
  return fail(
      ErrorKind::invalidArgument,
      fmt::format("no renderer is called '{}': use one of {}", name, fmt::join(rendererNames(), ", ")),
      "renderer");
}

std::string_view rendererNow(std::string_view name) {
  return name == "gl-mesh" ? "gl" : name == "gl-zbuffer" ? "zbuffer" : name;
}

std::vector<std::string> rendererNames() {
  std::vector<std::string> names;
  for (Renderer renderer : kRenderers) names.emplace_back(nameOf(renderer));
  return names;
}

const char* nameOf(Reconstruction reconstruction) {
  constexpr std::array kNames{"point", "splat", "patches"};
  return kNames[std::size_t(reconstruction)];
}

Result<Reconstruction> parseReconstruction(std::string_view name) {
  for (Reconstruction reconstruction : kReconstructions)
    if (name == nameOf(reconstruction)) return reconstruction;
  return fail(ErrorKind::invalidArgument,
              fmt::format("no reconstruction is called '{}': use point, splat or patches", name),
              "reconstruction");
}

std::string_view reconstructionNow(std::string_view name) {
  return name == "surface" || name == "filtered" ? "patches" : name;
}

Status ViewSettings::check() const {
  if (maxSplatPixels < 1 || maxSplatPixels > 64)
    return fail(ErrorKind::invalidArgument,
                fmt::format("largest splat of {} pixels: must lie in 1..64", maxSplatPixels),
                "view settings");
  return {};
}

}  // namespace acentric
