#include "editor/session/capture_status.h"

#include <algorithm>

#include "engine/base/contract.h"

namespace acentric::editor {
namespace {

BakeState stateOf(const Region& region, const std::vector<bool>& cameras) {
  bool some = false;
  bool all = true;
  for (const Cover& cover : region.covers)
    for (const Piece& piece : cover.pieces) {
      const bool there = cameras[std::size_t(piece.camera)];
      some = some || there;
      all = all && there;
    }
  return some && all ? BakeState::baked : some ? BakeState::partial : BakeState::missing;
}

}  // namespace

CaptureStatus captureStatus(const Layout& layout, std::vector<bool> cameras) {
  require(cameras.size() == layout.cameras.size(), "one flag per camera of the layout");
  CaptureStatus status;
  status.cameras = std::move(cameras);
  status.baked = int(std::count(status.cameras.begin(), status.cameras.end(), true));
  status.regions.reserve(layout.regions.size());
  for (const Region& region : layout.regions) status.regions.push_back(stateOf(region, status.cameras));
  return status;
}

}  // namespace acentric::editor
