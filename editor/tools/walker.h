#pragma once
/// Walking: keys move the eye at walking speed and raise and lower it within its range, dragging looks
/// around, and a soft wall keeps the eye where one may stand (it slides along the border). Pure: time and
/// keys are handed in.

#include <functional>
#include <glm/glm.hpp>

namespace acentric::editor {

struct WalkKeys {
  bool forward = false, back = false, left = false, right = false;
  bool turnLeft = false, turnRight = false;
  bool up = false, down = false;
  bool fast = false;
  bool any() const { return forward || back || left || right || turnLeft || turnRight || up || down; }
};

/// Heights at which an eye may be, z in metres.
struct EyeHeights {
  double low = 0, high = 0;
};

struct WalkPose {
  glm::dvec3 eye{0};
  double yawRadians = 0;
  double pitchRadians = 0;
  bool operator==(const WalkPose&) const = default;
};

class Walker {
 public:
  static constexpr double kMetresPerSecond = 1.4;
  static constexpr double kLeastMetresPerSecond = 0.1, kMostMetresPerSecond = 20;
  static constexpr double kRiseMetresPerSecond = 0.3;
  static constexpr double kFastFactor = 3.0;
  static constexpr double kTurnRadiansPerSecond = 1.6;
  static constexpr double kSettleSeconds = 0.08;  ///< time constant of starting and stopping
  static constexpr double kMaxPitchRadians = 1.45;
  /// Where a walk from one place to another ends.
  using Ground = std::function<glm::dvec2(const glm::dvec2& from, const glm::dvec2& to)>;

  const WalkPose& pose() const { return pose_; }
  void setPose(const WalkPose& pose);
  /// Standing there, whatever it did before.
  void standAt(const WalkPose& pose);
  /// Kept within the limits above.
  void setSpeed(double metresPerSecond);
  double speed() const { return speed_; }
  /// Plan, metres per second.
  const glm::dvec2& velocity() const { return velocity_; }
  /// Dragging by pixels: to the right turns right, downwards looks down.
  void look(const glm::dvec2& pixels, double radiansPerPixel);
  /// True while the eye moves or still glides.
  bool step(double seconds, const WalkKeys& keys, const EyeHeights& heights, const Ground& ground);
  /// On all walks together.
  double walkedMetres() const { return walkedMetres_; }
  bool moving() const { return velocity_ != glm::dvec2(0) || turning_; }

 private:
  WalkPose pose_;
  glm::dvec2 velocity_{0};  // plan, metres per second
  double speed_ = kMetresPerSecond;
  bool turning_ = false;
  double walkedMetres_ = 0;
};

}  // namespace acentric::editor
