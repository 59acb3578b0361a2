#pragma once
/// Which way a triangle faces.

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/scene/placed_mesh.h"
#include "engine/scene/scene.h"

namespace acentric {

/// In double: the cross product of a small triangle's edges underflows in float once it is squared. Upwards
/// where there is no direction.
glm::vec3 unitNormal(const glm::dvec3& across);

/// Unit normal of a triangle as wound; up where it has no area.
glm::vec3 triangleNormal(const Mesh& mesh, std::uint32_t triangle);
/// The same where the mesh stands.
glm::vec3 triangleNormal(const PlacedMesh& placed, std::uint32_t triangle);

}  // namespace acentric
