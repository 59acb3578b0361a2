#pragma once
/// Stairs and ramps as storeys of a project: each piece (inspect/stairs.h) has a level layout of its own, at
/// the eye's height over the middle of its ground, and says how that ground rises (LayoutSpec::slope). So
/// cameras of one cover lie at one height, and bake, captures, bundles and runtimes know nothing of stairs.

#include "engine/bake/ray_scene.h"
#include "engine/inspect/stairs.h"
#include "engine/pipeline/project.h"

namespace acentric {

inline bool isStairs(const Storey& storey) { return storey.layout.slope.has_value(); }

/// Between which two storeys of a project.
struct StairEnds {
  int lower = 0, upper = 0;  ///< into Project::storeys, in either order
};

struct StairRequest {
  WalkableOptions walkable;          ///< as the storeys were looked for
  std::optional<StairEnds> between;  ///< none: all storeys
};

struct AddedStairs {
  int ways = 0, pieces = 0;
  std::vector<std::string> leftOut;  ///< ways without cells, each with its reason, for a person
};

/// Adds a storey for each piece of the stairs and ramps that join storeys of the project, or two of them,
/// where it has none yet. `found`: the planes and ways of its scene. Near band, eye height and eye range are
/// the project's. Fails where nothing joins the two.
Result<AddedStairs> addStairs(Project& project, const RayScene& rays, const Storeys& found,
                              const StairRequest& request, const Progress& progress = {},
                              std::stop_token stop = {});
/// Takes all of them away. How many pieces there were.
int removeStairs(Project& project);

/// One ring over all of a piece where it is about as long as wide; else rings in a row along it, with the
/// gaps between them, of configuration b. Rings' edges run along the sides of the piece.
LayoutSpec layoutOf(const StairPiece& piece, const LayoutSpec& like);

}  // namespace acentric
