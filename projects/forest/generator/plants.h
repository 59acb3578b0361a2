#pragma once
/// What grows on the ground.

#include <cstddef>
#include <cstdint>

#include "projects/gallery/generator/model.h"

namespace acentric::forest {

inline constexpr std::size_t kFernTriangles = 1'600, kGrassTriangles = 1'500;  ///< with all of their detail

/// Fronds of cards around the origin, 0.7 m high. About so many triangles, at least 12.
gallery::Thing makeFern(std::size_t triangles, std::uint64_t seed, int leaf);

/// Blades over a disc of 0.7 m around the origin. `height` in metres; the material's picture has tints from
/// left to right, and a blade's foot below its tip. About so many triangles, at least 12.
gallery::Thing makeGrass(const char* name, std::size_t triangles, float height, std::uint64_t seed,
                         int blades);

}  // namespace acentric::forest
