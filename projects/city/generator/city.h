#pragma once
/// A city for measuring how things grow with the number of triangles: the same streets and houses whatever
/// their number, with more windows, and finer ones, on every front.

#include "projects/gallery/generator/model.h"

namespace acentric::city {

/// 8 x 8 blocks of four houses each, with streets 12 m wide between them, around the origin; the crossing of
/// the middle streets is there. About so many triangles, within a tenth from 100,000 to 20 million.
gallery::Model makeCity(std::size_t triangles);

// Of the city and the town.
gallery::Material matt(const char* name, const glm::vec3& colour);
gallery::Light sunlight();

}  // namespace acentric::city
