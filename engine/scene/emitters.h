#pragma once
/// Surfaces that glow, as sources of light for others. Whatever glows is seen to glow (Effect::emission);
/// only what is bright and large enough to matter also lights its surroundings (Effect::areaLights).

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

/// Radiance of a triangle, on the average over its texture.
glm::vec3 meanEmission(const Scene& scene, const Mesh& mesh, std::uint32_t triangle);

/// Per mesh: does it light others? It does if a surface that faces it from a twentieth of the scene's size
/// away gets at least 1 % of the typical light: that of the sun, the sky, the lamps and the strongest
/// emitter. A hundredth is about the least difference of brightness that an eye notices, and no light that a
/// frame of 8 bits shows is lost. Both figures follow the scene, so that neither its unit nor its exposure
/// decides.
std::vector<std::uint8_t> lightingMeshes(const Scene& scene);

}  // namespace acentric
