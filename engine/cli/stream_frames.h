#pragma once
/// Walks that are timed while their captures come and go: where the eye is, what draws, what is counted.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/cli/command.h"
#include "engine/geometry/perspective_view.h"
#include "engine/view/view_cameras.h"
#include "engine/view_gl/gl_renderer.h"

namespace acentric::cli {

/// Views along a path by the time at which a walker reaches them.
class TimedPath {
 public:
  TimedPath(std::vector<PerspectiveView> views, double metresPerSecond);
  double seconds() const { return at_.back(); }

  struct Pose {
    PerspectiveView view;
    glm::dvec2 velocity{0};
  };
  Pose at(double seconds) const;

 private:
  std::vector<PerspectiveView> views_;
  std::vector<double> at_;
};

/// Draws with a renderer of either kind; no picture is read back.
class StreamRenderer {
 public:
  static Result<StreamRenderer> open(const ViewSettings& settings, bool waitForCaptures, TaskRunner& runner);
  Result<FrameStats> draw(const WalkScene& walk, const PerspectiveView& view);

 private:
  StreamRenderer(const ViewSettings& settings, TaskRunner& runner) : settings_(settings), runner_(&runner) {}

  ViewSettings settings_;
  TaskRunner* runner_;
  FrameMemory memory_;
  std::unique_ptr<HeadlessContext> context_;
  std::unique_ptr<GlRenderer> gl_;  // destroyed before its context
};

/// What of a view's cameras is in memory.
struct ViewCaptures {
  bool missing = false;  ///< of some there is nothing
  bool standIn = false;  ///< of some there is a coarse one alone
};
ViewCaptures capturesOf(const LoadedWalk& walk, const ViewCameras& needed);

/// What the frames of a walk were like.
struct WalkTally {
  std::vector<double> frameMs, takeMs, sendMs;
  int incomplete = 0;          ///< frames with a camera of which nothing was there
  int coarse = 0;              ///< frames with a coarse stand-in
  int awaiting = 0;            ///< frames with captures in memory that were not on the graphics card
  int unsent = 0;              ///< of these: with nothing in their place
  std::uint64_t mostSent = 0;  ///< bytes, by a frame
  double firstFullSeconds = -1;

  void count(const FrameStats& stats);
  void count(const LoadedWalk& walk, const ViewCameras& needed, double seconds);
};

/// The most memory of this process that was resident, bytes.
std::uint64_t peakResidentBytes();
/// From now on, as far as the system can forget it.
void forgetPeakResident();

}  // namespace acentric::cli
