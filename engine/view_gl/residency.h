#pragma once
/// What captures have on the graphics card, by the identity of the shared capture.

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>

#include "engine/view/walk_scene.h"

namespace acentric {

using CaptureSet = std::set<const DisplayCapture*>;
/// With what their mirrors show.
inline void addTo(CaptureSet& set, std::span<const std::shared_ptr<const DisplayCapture>> captures) {
  for (const auto& capture : captures) {
    if (!capture) continue;
    set.insert(capture.get());
    if (capture->reflections) set.insert(capture->reflections.get());
  }
}

/// `Buffers` has an `owner` (weak pointer to the capture), `bytes` and `lastUse`.
template <class Buffers>
class Residency {
 public:
  /// Null if there are none. Valid until the next call of dropGone or trim; used in this frame.
  Buffers* find(const std::shared_ptr<const DisplayCapture>& capture) {
    const auto found = resident_.find(capture.get());
    // Another capture may have been made at the address of one that died.
    if (found == resident_.end() || found->second.owner.lock() != capture) return nullptr;
    found->second.lastUse = frame_;
    return &found->second;
  }
  /// Instead of what there was.
  Buffers& put(const std::shared_ptr<const DisplayCapture>& capture, Buffers buffers) {
    buffers.owner = capture;
    buffers.lastUse = frame_;
    return resident_.insert_or_assign(capture.get(), std::move(buffers)).first->second;
  }
  /// Drops the captures that are no longer anywhere in memory or not among these.
  void dropGone(const CaptureSet& wanted) {
    std::erase_if(resident_, [&](const auto& entry) {
      return !wanted.contains(entry.first) || entry.second.owner.expired();
    });
  }
  /// Drops those unused for longest until at most `bytes` remain; keeps what was used since the last trim.
  void trim(std::size_t bytes) {
    for (std::size_t left = this->bytes(); left > bytes;) {
      const auto oldest =
          std::min_element(resident_.begin(), resident_.end(),
                           [](const auto& a, const auto& b) { return a.second.lastUse < b.second.lastUse; });
      if (oldest->second.lastUse == frame_) break;
      left -= oldest->second.bytes;
      resident_.erase(oldest);
    }
    ++frame_;
  }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& entry : resident_) sum += entry.second.bytes;
    return sum;
  }
  std::size_t count() const { return resident_.size(); }

 private:
  std::map<const DisplayCapture*, Buffers> resident_;
  std::uint64_t frame_ = 1;
};

}  // namespace acentric
