#include "editor/tools/walker.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric::editor {

void Walker::setPose(const WalkPose& pose) {
  pose_ = pose;
  pose_.yawRadians = wrapAngle(pose.yawRadians);
  pose_.pitchRadians = std::clamp(pose.pitchRadians, -kMaxPitchRadians, kMaxPitchRadians);
}

void Walker::look(const glm::dvec2& pixels, double radiansPerPixel) {
  WalkPose pose = pose_;
  pose.yawRadians -= pixels.x * radiansPerPixel;
  pose.pitchRadians -= pixels.y * radiansPerPixel;
  setPose(pose);
}

bool Walker::step(double seconds, const WalkKeys& keys, const Clamp& clamp) {
  // A stalled window must not throw the eye across the room.
  const double dt = std::clamp(seconds, 0.0, 0.1);
  const int turn = int(keys.turnLeft) - int(keys.turnRight);
  turning_ = turn != 0;
  if (turning_) pose_.yawRadians = wrapAngle(pose_.yawRadians + turn * kTurnRadiansPerSecond * dt);

  const glm::dvec2 ahead = directionOf(pose_.yawRadians);
  const glm::dvec2 leftward(-ahead.y, ahead.x);
  glm::dvec2 wanted = ahead * double(int(keys.forward) - int(keys.back)) +
                      leftward * double(int(keys.left) - int(keys.right));
  if (wanted != glm::dvec2(0))
    wanted *= kMetresPerSecond * (keys.fast ? kFastFactor : 1.0) / glm::length(wanted);

  velocity_ += (wanted - velocity_) * (1 - std::exp(-dt / kSettleSeconds));
  constexpr double kStandstill = 0.02;
  if (wanted == glm::dvec2(0) && glm::length(velocity_) < kStandstill) velocity_ = glm::dvec2(0);
  const glm::dvec2 place(pose_.eye);
  const glm::dvec2 next = clamp(place + velocity_ * dt);
  pose_.eye = glm::dvec3(next, pose_.eye.z);
  return moving();
}

}  // namespace acentric::editor
