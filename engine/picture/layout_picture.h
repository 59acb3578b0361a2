#pragma once
/// The plan picture of a layout: what inspections begin with.

#include "engine/layout/layout.h"
#include "engine/picture/plan_picture.h"

namespace acentric {

/// Polygons in the order of Layout::regions (filled by region kind), the walkable outline, the cameras'
/// sectors, and a legend of them. Give the polygons values and the picture a scale to colour by number.
PlanPicture pictureOf(const Layout& layout, std::string title);

}  // namespace acentric
