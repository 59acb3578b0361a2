#pragma once
/// The GLSL files of ui/shaders, embedded at build.

#include <span>
#include <string_view>

namespace acentric::ui {

struct ShaderSource {
  std::string_view name;  ///< file name: "mark.vert"
  std::string_view text;
};

std::span<const ShaderSource> shaderSources();

}  // namespace acentric::ui
