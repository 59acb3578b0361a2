#pragma once
/// What the newest frames of the walk took, part by part, for the graph of frame times. Pure.

#include <array>
#include <deque>

#include "engine/measure/statistics.h"
#include "engine/view/frame.h"

namespace acentric::editor {

enum class FramePart { plan, send, captures, local, fill, present };
inline constexpr std::size_t kFrameParts = 6;
const char* nameOf(FramePart part);  ///< for a legend
const char* helpFor(FramePart part);

struct FrameCost {
  std::array<double, kFrameParts> seconds{};  ///< by FramePart
  double total() const;
};

class FrameTimes {
 public:
  static constexpr std::size_t kMost = 240;

  /// A frame that was drawn; the oldest beyond kMost is forgotten.
  void add(const FrameStats& stats);
  /// How long the window took to show the newest frame. Only the first time counts: later frames of the
  /// window show the same picture.
  void presented(double seconds);
  const std::deque<FrameCost>& frames() const { return frames_; }  ///< oldest first
  /// Of their totals, seconds.
  Spread spread() const;

 private:
  std::deque<FrameCost> frames_;
  bool awaitsPresent_ = false;
};

}  // namespace acentric::editor
