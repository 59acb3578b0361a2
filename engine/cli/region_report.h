#pragma once
/// How reports name a region: its cell's address, kind and place.

#include "engine/cli/command.h"

namespace acentric::cli {

const char* nameOf(RegionKind kind);
Json toJson(const CellId& id);      ///< as in the project file
Json toJson(const Region& region);  ///< cell, kind, centre
/// "[3, -1, 0] ring        at (1.20, -0.40) m".
std::string placeText(const Region& region);

}  // namespace acentric::cli
