#pragma once
/// Where the second cover is worth a look: where the first samples a surface thinly, and a camera of the
/// second may sample it more densely by as much as is asked for (patch_kernel.h: kThinDensity, kDenser).
/// Most of what one camera samples thinly the others do too, since it is far away.

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/view/view_plan.h"

namespace acentric {

/// A place on a surface that a pixel of the picture shows.
struct SurfacePixel {
  glm::dvec3 place{0};            ///< from the eye, metres
  glm::dvec3 across{0}, down{0};  ///< how the place moves to the next pixel right and below, metres

  /// Of the plane through that place. `ray` leads through the pixel, one metre along the view axis, and
  /// changes by `rayAcross` and `rayDown` from pixel to pixel.
  static SurfacePixel onPlane(const glm::dvec3& normal, double zDepth, const glm::dvec3& ray,
                              const glm::dvec3& rayAcross, const glm::dvec3& rayDown);
};

/// As densityOf tells of the kernel's pixels, but as a number from 0 on, not limited to 1. `baseline` leads
/// from the eye to the camera.
double densityAt(const SurfacePixel& pixel, const glm::dvec3& baseline, double columnsPerRadian,
                 double rowsPerRadian);

class SecondLook {
 public:
  /// Of the pieces of the second cover.
  SecondLook(const WalkScene& scene, std::span<const PieceDraw> behind);

  /// May one of them show the pixel, which the first cover samples so densely, in its place?
  bool isWorth(const SurfacePixel& pixel, double density) const;

 private:
  struct Camera {
    glm::dvec3 baseline{0};
    glm::dvec2 middle{0};    ///< of its view, a direction
    double leastCosine = 0;  ///< of directions in its view with that, a little less
    double columnsPerRadian = 0, rowsPerRadian = 0;
  };
  std::vector<Camera> cameras_;
};

}  // namespace acentric
