#pragma once
/// Which variants of the inner loops this processor runs.

#include <span>

#include "engine/view/canvas_rows.h"
#include "engine/view/patch_kernel.h"
#include "engine/view/surface_kernel.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

struct Kernels {
  const char* name;
  ProjectSamples project;
  WriteRows writeRows;
  ShadeRun shadeRun;
  CoverRow coverRow;
  BlendRow blendRow;
  const PatchKernel* patches;
};

/// The scalar reference first, the fastest last.
std::span<const Kernels> supportedKernels();

}  // namespace acentric
