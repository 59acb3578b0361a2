#include "engine/view/lanes_scalar.h"
#include "engine/view/surface_kernel_body.h"

namespace acentric {

void coverRowScalar(const TriangleRow& row) { surface_kernel::coverRow<OneLane>(row); }

void blendRowScalar(const ClearShade& shade, const ClearRow& row) {
  surface_kernel::blendRow<OneLane>(shade, row);
}

void shadeRunScalar(const SurfaceShade& shade, const SurfaceRun& run) {
  surface_kernel::shadeRun<OneLane>(shade, run);
}

}  // namespace acentric
