#pragma once
/// The plan with its regions coloured by the bytes that their captures will take.

#include <span>

#include "engine/inspect/estimates.h"
#include "engine/layout/layout.h"
#include "engine/picture/plan_picture.h"

namespace acentric {

/// Bytes of each region's captures, those that neighbours share counted for each of them. `cameraPixels`: of
/// Layout::cameras; a capture's bytes are taken to grow with its pixels.
std::vector<double> bytesPerRegion(const Layout& layout, std::span<const double> cameraPixels,
                                   const BakeEstimate& estimate);

PlanPicture pictureOf(const Layout& layout, std::span<const double> cameraPixels,
                      const BakeEstimate& estimate, std::string title);

}  // namespace acentric
