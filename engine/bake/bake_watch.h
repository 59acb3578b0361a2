#pragma once
/// What a bake tells of its cameras while it runs: where each stands, and how far the one being traced is.

#include <cstdint>
#include <functional>
#include <string>

namespace acentric {

enum class CameraStage : std::uint8_t {
  waiting,  ///< never told
  tracing,
  writing,  ///< traced; waits to be written or is being written
  done,
  reused,  ///< was there already
  failed
};

struct CameraNews {
  int camera = 0;  ///< of the layout
  CameraStage stage = CameraStage::waiting;
  bool preview = false;  ///< of the camera's preview, which comes before its capture
  int columns = 0, columnsDone = 0;
  std::uint64_t rays = 0;  ///< so far
  double seconds = 0;      ///< of tracing, so far
  std::string error = {};  ///< why it failed
};

/// Called from any of the bake's threads, one call at a time, often: keep it cheap.
using BakeWatch = std::function<void(const CameraNews&)>;

}  // namespace acentric
