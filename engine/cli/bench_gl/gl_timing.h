#pragma once
/// Frame times of the OpenGL renderer along the path of a packed walk.

#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/result.h"
#include "engine/bench/packed_walk.h"

namespace acentric::cli {

struct GlTimingOptions {
  glm::ivec2 pixels{1920, 1080};
  int frames = 0;   ///< of the path, evenly chosen; 0 = all
  int repeats = 3;  ///< times each frame is drawn, after once to warm up
};

struct GlTiming {
  nlohmann::ordered_json json;
  std::string text;
};

/// Opens OpenGL without a window.
Result<GlTiming> timeGl(const PackedWalk& packed, const GlTimingOptions& options);

}  // namespace acentric::cli
