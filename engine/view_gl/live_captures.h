#pragma once
/// Which captures frames are drawn from that wait for none: of each camera that which the walk has, once all
/// that is drawn of it is on the graphics card, and until then that which was drawn before. After what the
/// eye sees now, captures around it are sent: those that it will see when it turns or walks on.

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/view/frame.h"
#include "engine/view_gl/capture_residency.h"

namespace acentric {

class LiveCaptures {
 public:
  /// `memoryBytes`: on the graphics card, that captures to come may take with those in view.
  LiveCaptures(CaptureResidency& captures, std::size_t memoryBytes)
      : captures_(captures), memoryBytes_(memoryBytes) {}

  /// Before a frame is planned: sends, within the limit, what was asked for and what is small enough to be
  /// sent here and now, and asks for the rest. Returns the walk to plan with: in place of captures that are
  /// not ready others of their cameras, or none. Valid until end(). Counts in `stats`.
  Result<const WalkScene*> choose(const WalkScene& scene, const PerspectiveView& view,
                                  const ViewSettings& settings, SendLimit limit, FrameStats& stats);
  /// Sends what was asked for, within the limit. True if a picture drawn now would show something that
  /// the last could not.
  Result<bool> receive(SendLimit& limit) { return captures_.receive(limit); }
  /// After the frame.
  void end() { planned_ = {}; }
  /// What the graphics card keeps beside the captures of the walk.
  void addKept(CaptureSet& set) const { addTo(set, drawn_); }
  /// Lets go of all captures: nothing stands in for what comes next.
  void clear() { drawn_.clear(); }

 private:
  using CapturePtr = std::shared_ptr<const DisplayCapture>;
  bool ready(const CapturePtr& capture);
  Status ask(const CapturePtr& capture, int camera, bool lacked);
  void askAhead(const WalkScene& scene, const glm::dvec3& eye, const std::vector<int>& inView);
  void letGo(const WalkScene& scene, const std::vector<int>& inView);
  Status sendSmall(const CapturePtr& capture, int camera, SendLimit& limit);

  CaptureResidency& captures_;
  std::size_t memoryBytes_;
  std::vector<CapturePtr> drawn_;  ///< by camera: that which was ready last; null = none
  WalkScene planned_;
};

}  // namespace acentric
