#pragma once
/// Local geometry with the light of its surroundings alone: of a floor that reaches through a whole storey,
/// only what lies near the region.

#include "engine/scene/local_geometry.h"

namespace acentric {

/// `local` is self-contained. In place of a source triangle of which little is used comes the smallest one of
/// its samples' lattice that holds all of that: its samples, and at its corners the attributes there.
/// `unusedBits` of each channel of the light are rounded away.
LocalGeometry croppedLight(const LocalGeometry& local, int unusedBits = 0);

}  // namespace acentric
