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

void Walker::standAt(const WalkPose& pose) {
  setPose(pose);
  velocity_ = glm::dvec2(0);
  turning_ = false;
}

void Walker::setSpeed(double metresPerSecond) {
  speed_ = std::clamp(metresPerSecond, kLeastMetresPerSecond, kMostMetresPerSecond);
}

void Walker::look(const glm::dvec2& pixels, double radiansPerPixel) {
  WalkPose pose = pose_;
  pose.yawRadians -= pixels.x * radiansPerPixel;
  pose.pitchRadians -= pixels.y * radiansPerPixel;
  setPose(pose);
}

bool Walker::step(double seconds, const WalkKeys& keys, const EyeHeights& heights, const Ground& ground) {
  // A stalled window must not throw the eye across the room.
  const double dt = std::clamp(seconds, 0.0, 0.1);
  const int turn = int(keys.turnLeft) - int(keys.turnRight);
  const int rise = int(keys.up) - int(keys.down);
  turning_ = turn != 0 || rise != 0;
  if (turn != 0) pose_.yawRadians = wrapAngle(pose_.yawRadians + turn * kTurnRadiansPerSecond * dt);

  const glm::dvec2 ahead = directionOf(pose_.yawRadians);
  const glm::dvec2 leftward(-ahead.y, ahead.x);
  glm::dvec2 wanted = ahead * double(int(keys.forward) - int(keys.back)) +
                      leftward * double(int(keys.left) - int(keys.right));
  if (wanted != glm::dvec2(0)) wanted *= speed_ * (keys.fast ? kFastFactor : 1.0) / glm::length(wanted);

  velocity_ += (wanted - velocity_) * (1 - std::exp(-dt / kSettleSeconds));
  constexpr double kStandstill = 0.02;
  if (wanted == glm::dvec2(0) && glm::length(velocity_) < kStandstill) velocity_ = glm::dvec2(0);
  const glm::dvec2 place(pose_.eye);
  const glm::dvec2 next = velocity_ == glm::dvec2(0) ? place : ground(place, place + velocity_ * dt);
  // What the wall took is gone: whoever turns away from it starts at once.
  if (dt > 0 && velocity_ != glm::dvec2(0)) {
    const glm::dvec2 walked = (next - place) / dt;
    if (glm::length(walked) < glm::length(velocity_)) velocity_ = walked;
  }
  walkedMetres_ += glm::distance(place, next);
  const double z = std::clamp(pose_.eye.z + rise * kRiseMetresPerSecond * dt, heights.low, heights.high);
  pose_.eye = glm::dvec3(next, z);
  return moving();
}

}  // namespace acentric::editor
