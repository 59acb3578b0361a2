#pragma once
/// How much of what lies behind a clear surface it hides. Shared by whatever shades: captures, the reference
/// picture and local geometry must agree on it.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace acentric {

/// Glass seen at an angle: a faint film that grows by Schlick's Fresnel term, and a body: what the glass
/// keeps back of the light behind it (tint, partial transmission), since one alpha cannot tint per channel.
struct GlassAlpha {
  float film = 0;  ///< shows what the glass mirrors
  float body = 0;  ///< shows the glass's own colour
  float alpha() const { return film + body; }
};

/// `transmission` in [0,1]; `cosine` between the shading normal and the direction to the viewer.
inline GlassAlpha glassAlpha(float transmission, const glm::vec3& baseColour, float cosine) {
  const float grazing = 1 - std::clamp(cosine, 0.0f, 1.0f);
  const float fresnel = 0.04f + 0.96f * std::pow(grazing, 5.0f);
  const float film = std::min(1.0f, 0.08f + fresnel);
  const float luminance = glm::dot(baseColour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  const float passing = std::clamp(transmission * luminance, 0.0f, 1.0f);
  return {film, (1 - film) * (1 - passing)};
}

}  // namespace acentric
