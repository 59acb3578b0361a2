#pragma once
/// Which variants of the inner loops this processor runs.

#include <span>

#include "engine/view/pixel_filter.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

struct Kernels {
  const char* name;
  ProjectSamples project;
  FindBlocks findBlocks;
  FilterPixels filter;
};

/// The scalar reference first, the fastest last.
std::span<const Kernels> supportedKernels();

}  // namespace acentric
