#pragma once
/// How far the layout is baked, by camera and by region.

#include <cstdint>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric::editor {

enum class BakeState : std::uint8_t { missing, partial, baked };

struct CaptureStatus {
  std::vector<bool> cameras;       ///< on disk
  std::vector<BakeState> regions;  ///< all, some or none of the cameras that the region's covers name
  int baked = 0;                   ///< cameras on disk
  bool complete() const { return baked == int(cameras.size()); }
};

CaptureStatus captureStatus(const Layout& layout, std::vector<bool> cameras);

}  // namespace acentric::editor
