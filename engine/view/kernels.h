#pragma once
/// Which variants of the inner loops this processor runs.

#include <span>

#include "engine/view/patch_kernel.h"
#include "engine/view/surface_kernel.h"

namespace acentric {

struct Kernels {
  const char* name;
  ShadeRun shadeRun;
  CoverRow coverRow;
  BlendRow blendRow;
  const PatchKernel* patches;
};

/// The scalar reference first, the fastest last.
std::span<const Kernels> supportedKernels();

}  // namespace acentric
