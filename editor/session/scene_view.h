#pragma once
/// What the 3D view shows of a project: where its ceiling is cut away, and what it frames.

#include <optional>
#include <set>

#include "engine/bake/preview.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

/// A little above the highest eye, world z.
double ceilingCut(const Layout& layout, double eyeRange);
/// Is there something overhead of most eyes? Asks a few of the layout's cells.
bool underCeiling(const RayScene& rays, const Layout& layout);

struct WalkableBox {
  glm::dvec2 low{0}, high{0};
  bool operator==(const WalkableBox&) const = default;
};
/// Around where one can walk: the outline as far as there are cells, what lies within an edge of a cell of
/// it, and cells and panoramas that were placed by hand. Of an outline in several pieces those that are
/// specks beside the largest do not count. Nothing where nothing is laid out.
std::optional<WalkableBox> walkableBox(const Layout& layout);

struct SceneBox {
  glm::dvec3 low{0}, high{0};
};
/// All that can be walked, from the floor to the eye's height; of a selection, its cells alone; of a layout
/// without cells, the scene.
SceneBox boxToFrame(const Bounds& scene, const Layout& layout, const std::set<CellId>& selection);

}  // namespace acentric::editor
