#pragma once
/// The GLSL files of shaders/, embedded at build.

#include <span>
#include <string_view>

namespace acentric {

struct ShaderSource {
  std::string_view name;  ///< file name: "points.vert"
  std::string_view text;
};

std::span<const ShaderSource> shaderSources();

}  // namespace acentric
