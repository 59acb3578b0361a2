#pragma once
/// Which captures a view is painted from, before any of them is there.

#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/layout.h"
#include "engine/view/view_settings.h"

namespace acentric {

struct ViewCameras {
  int region = -1;           ///< where the eye stands; -1 = outside every region
  std::vector<int> cameras;  ///< into Layout::cameras, ascending
};

/// Those that planView looks for, in the order in which it paints them, back to front; one that the view is
/// split for comes where it is painted first.
std::vector<int> paintingOrder(const Layout& layout, const PerspectiveView& view,
                               const ViewSettings& settings);
/// The same with where the eye stands.
ViewCameras camerasOf(const Layout& layout, const PerspectiveView& view, const ViewSettings& settings);

}  // namespace acentric
