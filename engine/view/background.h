#pragma once
/// Directions in which a view shows nothing but the background: steeper than the scene's top and bottom are
/// seen across the near band. Captures have no rows there (columnCameraFor); local geometry is drawn over it.

#include "engine/geometry/perspective_view.h"
#include "engine/view/canvas.h"
#include "engine/view/sky_table.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Row tangents; +-infinity where there is no such direction.
struct BackgroundLimits {
  float above = std::numeric_limits<float>::infinity();
  float below = -std::numeric_limits<float>::infinity();
  bool holds(const glm::vec3& direction) const;
};

/// Of an eye in one of the layout's regions. None without a scene.
BackgroundLimits backgroundLimits(const WalkScene& scene, const glm::dvec3& eye);

/// World direction through image position (u, v) in pixels: as long as its pixel is away, so linear in both.
glm::dvec3 directionThrough(const PerspectiveView& view, double u, double v);

/// Does the view show such a direction?
bool showsBackground(const BackgroundLimits& limits, const PerspectiveView& view);

/// The colours it has.
Sky backgroundSky(const WalkScene& scene);

/// Paints it, at the distance of the sky, as the piece of slot `slot`.
void paintBackground(const SkyTable& sky, const PerspectiveView& view, const BackgroundLimits& limits,
                     std::uint32_t slot, Canvas& canvas);

}  // namespace acentric
