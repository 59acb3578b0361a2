#pragma once
/// Where in its pixel each sample's surface ends, and how it looks there on the whole.
///
/// A surface that goes on in all pixels around covers its own whole. Elsewhere rays through the 4x4 parts of
/// the pixel ask for that surface alone, right around its plane, whatever lies before it: what hides it may
/// move aside. So does a surface of a neighbouring pixel that no sample of this pixel belongs to: where it
/// covers a part here, the pixel gets a sample of it, for the same roles.
///
/// A sample that looks different from a neighbour on its surface gets the mean colour of what it covers.

#include "engine/bake/column_march.h"

namespace acentric {

/// Planes are one where no served eye can tell them apart by a quarter of a sample, 1/m.
double planeToleranceFor(const LayoutCamera& camera, const ColumnCamera& columns);

/// Of a capture whose samples have planes and cover whole pixels; its background and reflections stay. Rays
/// and samples are counted. A part only when stopped.
void traceSilhouettes(const ColumnMarch::Setting& setting, Capture& capture, TaskRunner& runner,
                      CaptureCounts& counts, const std::stop_token& stop);

}  // namespace acentric
