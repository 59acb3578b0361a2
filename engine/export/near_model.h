#pragma once
/// Local geometry as triangles that need no light: that is baked into their vertices' colours, on triangles
/// cut as fine as it.

#include "engine/export/draw_model.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Without flat mirrors: what they show lies behind them (patch_model.h). Blended meshes come last. Returns
/// how many triangles.
std::size_t addNear(const WalkScene& walk, const LocalGeometry& local, DrawModel& model);

}  // namespace acentric
