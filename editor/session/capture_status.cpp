#include "editor/session/capture_status.h"

#include <algorithm>
#include <set>

#include "engine/base/contract.h"
#include "engine/pipeline/bake_plan.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

BakeState stateOf(const Region& region, const CaptureStatus& status, const BakeMarks& marks) {
  bool some = false, all = true, stale = false, baking = false, failed = false;
  for (const Cover& cover : region.covers)
    for (const Piece& piece : cover.pieces) {
      const auto camera = std::size_t(piece.camera);
      some = some || status.cameras[camera];
      all = all && status.cameras[camera];
      stale = stale || status.stale[camera];
      baking = baking || std::ranges::binary_search(marks.baking, piece.camera);
      failed = failed || std::ranges::binary_search(marks.failed, piece.camera);
    }
  if (failed) return BakeState::failed;
  if (baking) return BakeState::baking;
  if (some && all) return BakeState::baked;
  if (stale) return BakeState::stale;
  return some ? BakeState::partial : BakeState::missing;
}

}  // namespace

const char* nameOf(BakeState state) {
  switch (state) {
    case BakeState::missing:
      return tr("missing");
    case BakeState::partial:
      return tr("partly");
    case BakeState::stale:
      return tr("stale");
    case BakeState::baked:
      return tr("done");
    case BakeState::baking:
      return tr("baking");
    case BakeState::failed:
      break;
  }
  return tr("failed");
}

CaptureStatus captureStatus(const Layout& layout, CapturesOnDisk there) {
  require(there.baked.size() == layout.cameras.size(), "one flag per camera of the layout");
  CaptureStatus status;
  status.cameras = std::move(there.baked);
  status.stale = std::move(there.stale);
  status.bytes = std::move(there.bytes);
  status.baked = int(std::count(status.cameras.begin(), status.cameras.end(), true));
  status.regions = regionStates(layout, status, {});
  return status;
}

CaptureStatus emptyStatus(const Layout& layout) {
  const std::size_t cameras = layout.cameras.size();
  return captureStatus(layout, {std::vector<bool>(cameras, false), std::vector<bool>(cameras, false),
                                std::vector<std::uint64_t>(cameras, 0)});
}

BakeMarks bakeMarks(const BakeQueue& queue, const std::vector<ContentKey>& keys) {
  std::set<ContentKey> baking, failed;
  for (const QueuedCamera& row : queue.cameras()) {
    if (row.stage == CameraStage::tracing || row.stage == CameraStage::writing) baking.insert(row.key);
    if (row.stage == CameraStage::failed) failed.insert(row.key);
  }
  BakeMarks marks;
  if (baking.empty() && failed.empty()) return marks;
  for (std::size_t camera = 0; camera < keys.size(); ++camera) {
    if (baking.contains(keys[camera])) marks.baking.push_back(int(camera));
    if (failed.contains(keys[camera])) marks.failed.push_back(int(camera));
  }
  return marks;
}

std::vector<BakeState> regionStates(const Layout& layout, const CaptureStatus& status,
                                    const BakeMarks& marks) {
  std::vector<BakeState> states;
  states.reserve(layout.regions.size());
  for (const Region& region : layout.regions) states.push_back(stateOf(region, status, marks));
  return states;
}

std::vector<int> camerasOf(const Region& region) {
  std::vector<int> cameras;
  for (const Cover& cover : region.covers)
    for (const Piece& piece : cover.pieces) cameras.push_back(piece.camera);
  std::ranges::sort(cameras);
  cameras.erase(std::ranges::unique(cameras).begin(), cameras.end());
  return cameras;
}

std::vector<std::uint64_t> regionBytes(const Layout& layout, const std::vector<std::uint64_t>& cameras) {
  std::vector<std::uint64_t> bytes;
  bytes.reserve(layout.regions.size());
  for (const Region& region : layout.regions) {
    bytes.push_back(0);
    for (const int camera : camerasOf(region)) bytes.back() += cameras[std::size_t(camera)];
  }
  return bytes;
}

}  // namespace acentric::editor
