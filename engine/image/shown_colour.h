#pragma once
/// What a display shows of a captured sample.

#include "engine/image/capture.h"
#include "engine/image/colour.h"

namespace acentric {

/// sRGB, straight alpha. `isShown`: Capture::shown.
inline Rgba8 shownColour(const HalfColour& colour, bool isShown, float exposure) {
  const glm::vec4 linear = unpackColour(colour);
  return isShown ? encodeShown(glm::vec3(linear), linear.a)
                 : encodeForDisplay(glm::vec3(linear), exposure, linear.a);
}

}  // namespace acentric
