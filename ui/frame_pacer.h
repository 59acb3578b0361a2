#pragma once
/// Decides when to draw and how long to sleep: nothing is drawn while nothing changes, and never more often
/// than the cap. Pure: times are handed in, in seconds.

namespace acentric::ui {

class FramePacer {
 public:
  static constexpr double kIdleSleep = 1.0;  ///< longest sleep, so that timed housekeeping goes on
  static constexpr int kSettleFrames = 3;    ///< ImGui needs this many to settle after an event

  explicit FramePacer(double framesPerSecond = 60) : interval_(1 / framesPerSecond) {}

  /// At least `count` more frames.
  void request(int count = kSettleFrames);
  /// One frame at `seconds` or soon after; the earliest request wins.
  void requestAt(double seconds);

  bool shouldDraw(double now) const;
  /// Seconds to sleep unless an event comes; 0 = draw now.
  double sleepSeconds(double now) const;
  /// A frame begins now.
  void drawn(double now);

 private:
  bool timedDue(double now) const { return timed_ >= 0 && now >= timed_; }

  double interval_;
  double last_ = -1e9;
  double timed_ = -1;  // < 0: none
  int wanted_ = kSettleFrames;
};

}  // namespace acentric::ui
