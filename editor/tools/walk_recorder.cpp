#include "editor/tools/walk_recorder.h"

#include <cmath>
#include <utility>

#include "engine/pipeline/project.h"
#include "engine/pipeline/thin_path.h"

namespace acentric::editor {
namespace {

constexpr double kStepSeconds = 1.0 / 60;  // how long before a first step the eye still stood

}  // namespace

PathPose pathPose(const WalkPose& pose, double seconds) {
  return {pose.eye, pose.yawRadians, pose.pitchRadians, seconds};
}

WalkPose walkPose(const PathPose& pose) { return {pose.eye, pose.yawRadians, pose.pitchRadians}; }

void WalkRecorder::start(int storey) {
  *this = {};
  recording_ = true;
  storey_ = storey;
}

void WalkRecorder::add(double now, const WalkPose& pose) {
  const double seconds = std::round((now - begin_) * 1e4) / 1e4;  // short in files
  if (path_.poses.empty() || seconds > path_.poses.back().seconds)
    path_.poses.push_back(pathPose(pose, seconds));
}

void WalkRecorder::take(double now, const WalkPose& pose) {
  if (!recording_) return;
  if (last_ && pose != *last_) {
    if (path_.poses.empty()) begin_ = now - kStepSeconds;
    if (path_.poses.empty() || now - begin_ - path_.seconds() > kRestSeconds) add(now - kStepSeconds, *last_);
    add(now, pose);
  }
  last_ = pose;
}

CameraPath WalkRecorder::stop() {
  CameraPath recorded = std::move(path_);
  *this = {};
  return thinned(recorded, {}, kMaxPathPoses);
}

}  // namespace acentric::editor
