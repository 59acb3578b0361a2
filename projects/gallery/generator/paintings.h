#pragma once
/// What hangs on the walls: pictures painted by rule from fixed seeds. Sizes in pixels; all end under one
/// varnish (canvas weave, brush grain, darker rim), so that they look painted.

#include <cstdint>

#include "projects/gallery/generator/canvas.h"

namespace acentric::gallery {

Canvas paintMountains(int width, int height, std::uint32_t seed);     ///< ranges at dusk, one behind another
Canvas paintSea(int width, int height, std::uint32_t seed);           ///< low sun over water
Canvas paintBirches(int width, int height, std::uint32_t seed);       ///< trunks before autumn leaves
Canvas paintMeadow(int width, int height, std::uint32_t seed);        ///< poppies under a summer sky
Canvas paintNightSky(int width, int height, std::uint32_t seed);      ///< strokes that follow whirls
Canvas paintFields(int width, int height, std::uint32_t seed);        ///< floating fields of colour
Canvas paintRings(int width, int height, std::uint32_t seed);         ///< a board of squares with rings
Canvas paintConstruction(int width, int height, std::uint32_t seed);  ///< arcs, bars and a large disc
Canvas paintTown(int width, int height, std::uint32_t seed);          ///< roofs as facets
Canvas paintStillLife(int width, int height, std::uint32_t seed);     ///< bowl, bottle and oranges

/// The last layer of each.
void varnish(Canvas& canvas, std::uint32_t seed);

}  // namespace acentric::gallery
