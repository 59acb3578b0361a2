#pragma once
/// Records where the eye goes, with the times at which it was there. What is stood before the first step and
/// after the last is left out. Pure: times and poses are handed in.

#include <optional>

#include "editor/tools/walker.h"
#include "engine/pipeline/camera_path.h"

namespace acentric::editor {

PathPose pathPose(const WalkPose& pose, double seconds = 0);
WalkPose walkPose(const PathPose& pose);

class WalkRecorder {
 public:
  static constexpr double kMostSeconds = 3600;
  /// Between moves that are farther apart the eye rested; nearer ones are one movement.
  static constexpr double kRestSeconds = 0.25;

  /// The eye is on a storey, by its number.
  void start(int storey);
  bool recording() const { return recording_; }
  int storey() const { return storey_; }
  /// Where the eye is, in each frame. `now` in seconds, monotonic.
  void take(double now, const WalkPose& pose);
  /// Since the first step; 0 before it.
  double seconds(double now) const { return path_.poses.empty() ? 0 : now - begin_; }
  bool full() const { return path_.seconds() >= kMostSeconds; }
  /// Ends it. What was recorded, thinned (engine/pipeline/thin_path.h); no pose if the eye never moved.
  CameraPath stop();

 private:
  void add(double now, const WalkPose& pose);

  bool recording_ = false;
  int storey_ = 0;
  double begin_ = 0;
  std::optional<WalkPose> last_;
  CameraPath path_;
};

}  // namespace acentric::editor
