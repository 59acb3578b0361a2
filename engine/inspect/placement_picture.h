#pragma once
/// The plan with what the placement checks found: centres marked by severity, an arrow where a push clears
/// one, regions without standing room marked.

#include "engine/inspect/placement_checks.h"
#include "engine/picture/plan_picture.h"

namespace acentric {

PlanPicture pictureOf(const Layout& layout, const PlacementReport& report, std::string title);

}  // namespace acentric
