#pragma once
/// Plays a path in real time: where on it the eye is, and how evenly pictures came. Pure: times are handed
/// in, in seconds.

#include <optional>
#include <string>
#include <vector>

namespace acentric::editor {

/// How evenly the pictures of a replay came: times from one to the next while the eye moved.
struct ReplayReport {
  double seconds = 0;          ///< that were played
  int frames = 0;              ///< pictures
  int late = 0;                ///< that took longer than WalkReplay::kLateSeconds
  double median = 0, p99 = 0;  ///< seconds
};
/// "312 frames in 10.4 s, 3 of them took longer than 33 ms; 16.7 ms a frame (median), 24.1 ms (99th
/// percentile)"
std::string describe(const ReplayReport& report);

class WalkReplay {
 public:
  static constexpr double kLeastSpeed = 0.25, kMostSpeed = 4;
  static constexpr double kLateSeconds = 0.033;

  void play();
  /// It may be gone on with.
  void pause();
  /// Back to the beginning; what was measured is told.
  void stop();
  void seek(double seconds) { at_ = seconds; }
  bool playing() const { return playing_; }
  /// Seconds along the path.
  double at() const { return at_; }

  /// Kept within the limits above.
  void setSpeed(double factor);
  double speed() const { return speed_; }
  bool loop = false;

  /// Goes on to `now` on a path of so many seconds. At its end it begins again or stops there.
  void advance(double now, double pathSeconds);
  /// So many pictures have been shown by now, since whenever.
  void picturesShown(double now, unsigned long pictures);
  /// The eye stands: no picture is due until it moves.
  void resting() { lastPicture_.reset(); }
  /// Once, after the replay has ended or was stopped, if pictures were shown.
  std::optional<ReplayReport> takeReport();

 private:
  void finish();

  bool playing_ = false;
  double at_ = 0, speed_ = 1, played_ = 0;
  std::optional<double> lastAdvance_, lastPicture_;
  unsigned long pictures_ = 0;
  std::vector<double> frames_;  // seconds each
  std::optional<ReplayReport> report_;
};

}  // namespace acentric::editor
