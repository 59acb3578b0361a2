#pragma once
/// What of the layout lies under a pixel of the 3D view. Pure.

#include <optional>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

/// Where the lattice is drawn: above the floor by a share of the eye height, so that rugs do not hide it.
double latticeHeight(const LayoutSpec& spec);
double latticeHeight(const Layout& layout);

/// The placed cell of the lattice that a ray meets before `surfaceDistance` metres (infinity: nothing is in
/// the way); else the one that the surface there stands in or over.
std::optional<CellId> cellUnder(const Layout& layout, const glm::dvec3& eye, const glm::dvec3& ray,
                                double surfaceDistance);

/// The camera whose centre of projection is drawn nearest to a pixel, within reach; of several at one place
/// the first. Where a surface lies before one, others are preferred. Looks at every camera.
std::optional<int> cameraUnder(const Layout& layout, const PerspectiveView& view, const glm::dvec2& pixel,
                               double surfaceDistance);

}  // namespace acentric::editor
