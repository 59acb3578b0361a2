#pragma once
/// The reference picture: every pixel ray-traced at the novel eye, with the same shading as the bake.

#include <stop_token>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"

namespace acentric {

struct TruthFrame {
  ColourImage colour;
  FloatImage rayDistance;  ///< metres to the first opaque surface; infinity = sky or nothing
  RayCounts rays;
};

/// One ray through each pixel centre; `samplesPerPixel` > 1 averages a regular grid of n x n (1, 4, 9, 16).
/// A stop ends it within a row; the picture then means nothing.
TruthFrame renderTruth(const RayScene& scene, const PerspectiveView& view, const BakeSettings& settings,
                       float exposure, int samplesPerPixel, TaskRunner& runner,
                       const std::stop_token& stop = {});
/// The same of some of the view's pixels, as large as these.
TruthFrame renderTruth(const RayScene& scene, const PerspectiveView& view, const PixelRect& part,
                       const BakeSettings& settings, float exposure, int samplesPerPixel, TaskRunner& runner,
                       const std::stop_token& stop = {});

/// All around a place, equirectangular: twice as wide as high, row 0 at the zenith, the middle along azimuth
/// 0 (+x) and azimuths growing to the left, as from inside.
struct Panorama {
  LinearImage radiance;
  FloatImage rayDistance;  ///< metres to the first opaque surface; infinity = sky or nothing
};

/// One ray through each pixel centre. A stop ends it within a row; the panorama then means nothing.
Panorama tracePanorama(const RayScene& scene, const glm::dvec3& eye, int height, const BakeSettings& settings,
                       TaskRunner& runner, const std::stop_token& stop = {});

/// 1 where what a pixel's centre shows looks different from elsewhere: metals, mirrors, and what lies behind
/// glass; else 0. Shades nothing.
Image<std::uint8_t> viewDependentPixels(const RayScene& scene, const PerspectiveView& view,
                                        const PixelRect& part, TaskRunner& runner);

/// Exposure that puts the log-average radiance seen from `eyes` (all around, low resolution) at middle grey
/// 0.18.
float estimateExposure(const RayScene& scene, const std::vector<glm::dvec3>& eyes,
                       const BakeSettings& settings, TaskRunner& runner);

}  // namespace acentric
