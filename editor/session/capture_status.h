#pragma once
/// How far the layout is baked, by camera and by region.

#include <cstdint>
#include <string>
#include <vector>

#include "editor/session/bake_queue.h"
#include "engine/layout/layout.h"
#include "engine/pipeline/bake_plan.h"

namespace acentric::editor {

/// Of a region; of several that hold of its cameras the last one here.
enum class BakeState : std::uint8_t {
  missing,
  partial,  ///< some cameras are there, the others never were
  stale,    ///< some are only there as the project was before
  baked,
  baking,  ///< one is being traced or written
  failed   ///< one could not be baked
};
inline constexpr int kBakeStates = 6;
const char* nameOf(BakeState state);

struct CaptureStatus {
  std::vector<bool> cameras;         ///< on disk
  std::vector<bool> stale;           ///< on disk as the project was before
  std::vector<std::uint64_t> bytes;  ///< of those on disk
  std::vector<BakeState> regions;    ///< by all the cameras that the region's covers name
  int baked = 0;                     ///< cameras on disk
  bool complete() const { return baked == int(cameras.size()); }
};

CaptureStatus captureStatus(const Layout& layout, CapturesOnDisk there);
/// Of a layout that nothing is known of yet.
CaptureStatus emptyStatus(const Layout& layout);

/// Cameras that a bake is at, or could not bake; in order.
struct BakeMarks {
  std::vector<int> baking, failed;
  bool operator==(const BakeMarks&) const = default;
};
/// `keys`: of the captures of a layout, which may have been edited since the bake began.
BakeMarks bakeMarks(const BakeQueue& queue, const std::vector<ContentKey>& keys);

/// The regions' states while a bake runs.
std::vector<BakeState> regionStates(const Layout& layout, const CaptureStatus& status,
                                    const BakeMarks& marks);

/// The cameras that a region's covers name, each once, in order.
std::vector<int> camerasOf(const Region& region);
/// Of the captures that each region shows; `cameras`: of each capture. One that serves several counts for
/// each.
std::vector<std::uint64_t> regionBytes(const Layout& layout, const std::vector<std::uint64_t>& cameras);

}  // namespace acentric::editor
