#pragma once
/// A picture fitted into an area with its aspect kept.

#include <glm/glm.hpp>

#include "ui/texture.h"

namespace acentric::ui {

struct FittedImage {
  glm::dvec2 min{0};  ///< window pixels
  glm::dvec2 size{0};
};

/// The largest rectangle of the given aspect (width / height), centred in the area. Pure.
FittedImage fitImage(const glm::dvec2& areaMin, const glm::dvec2& areaSize, double aspect);

/// Draws it into the current window's draw list; `bottomUp` for OpenGL's own framebuffers.
void drawImage(ImTextureID texture, const FittedImage& place, bool bottomUp);

}  // namespace acentric::ui
