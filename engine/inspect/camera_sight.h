#pragma once
/// Do cameras see what is seen from the cells that they are for? A camera beyond a wall may well miss a room
/// and yet be none to mend: where the wall lies within the cell, it is drawn as local geometry, and what is
/// behind it nobody sees.

#include <map>
#include <vector>

#include "engine/inspect/surface_probe.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Of points seen from places in regions, those that a camera is to show, and of these the ones that
/// something hides from it and from all others that are drawn there: of the region's other cover, and
/// panoramas. As in a bake, what lies within the grown region hides nothing.
struct CameraSight {
  int places = 0;  ///< looked from
  int shown = 0, hidden = 0;
  void add(const CameraSight& other) { places += other.places, shown += other.shown, hidden += other.hidden; }
  /// Something is hidden from cameras that stand free, too: from another place one sees other things.
  bool suffices() const;
};

/// Looks around from places in one region, an element of layout.regions, level and half up and down: what its
/// cameras (into Layout::cameras) show.
std::map<int, CameraSight> lookFrom(const std::vector<glm::dvec2>& places, const Layout& layout,
                                    const Region& region, const Bounds& bounds, const SurfaceProbe& probe);

}  // namespace acentric
