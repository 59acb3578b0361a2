#pragma once
/// Reading textures on the CPU: bilinear with wrap modes, level 0, sRGB decoded to linear where the use is a
/// colour. One routine for bake, truth and the software renderer, so that their pictures agree.

#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace acentric {

/// Linear RGBA of a colour texture (sRGB in the file; alpha as it is). `uv` is untransformed.
glm::vec4 sampleColour(const Scene& scene, const TextureUse& use, glm::vec2 uv);
/// RGBA as stored, in [0,1] (normal and metallic-roughness maps).
glm::vec4 sampleLinear(const Scene& scene, const TextureUse& use, glm::vec2 uv);

}  // namespace acentric
