#pragma once
/// Facets that a camera sees nearly edge on, although eyes of the regions that it serves see them well: the
/// sides of mouldings, and what lies along the rims of round bodies. Where they are no wider than a few parts
/// of a pixel, rays through the parts meet them by chance, and what they meet tells little of how far the
/// facet reaches: what lies behind would show through gaps, and planes as steep would reach out of the body.
///
/// Each gets samples on a plane that is turned towards the camera, about the facet's middle line, until the
/// facet covers a few parts. Its edges move by less than a part, and keep their distances: an eye to the side
/// sees the facet as wide as it is.

#include "engine/bake/column_march.h"

namespace acentric {

/// Of a capture that has its silhouettes, and of what mirrors show in it: adds these samples, and drops those
/// that rays met on the same facets. Rays and samples are counted. A part only when stopped.
void turnEdgeOnFacets(const ColumnMarch::Setting& setting, Capture& capture, TaskRunner& runner,
                      CaptureCounts& counts, const std::stop_token& stop);

}  // namespace acentric
