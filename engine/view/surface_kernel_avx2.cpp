#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/surface_kernel_body.h"

namespace acentric {

void coverRowAvx2(const TriangleRow& row) { surface_kernel::coverRow<EightLanes>(row); }

void blendRowAvx2(const ClearShade& shade, const ClearRow& row) {
  surface_kernel::blendRow<EightLanes>(shade, row);
}

void shadeRunAvx2(const SurfaceShade& shade, const SurfaceRun& run) {
  surface_kernel::shadeRun<EightLanes>(shade, run);
}

}  // namespace acentric
#endif
