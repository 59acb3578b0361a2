#if defined(__x86_64__)
#include "engine/view/lanes_avx512.h"
#include "engine/view/surface_kernel_body.h"

namespace acentric {

void coverRowAvx512(const TriangleRow& row) { surface_kernel::coverRow<SixteenLanes>(row); }

void blendRowAvx512(const ClearShade& shade, const ClearRow& row) {
  surface_kernel::blendRow<SixteenLanes>(shade, row);
}

void shadeRunAvx512(const SurfaceShade& shade, const SurfaceRun& run) {
  surface_kernel::shadeRun<SixteenLanes>(shade, run);
}

}  // namespace acentric
#endif
