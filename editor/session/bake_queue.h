#pragma once
/// The cameras of the running bake, or of the last one: where each stands, how fast it goes, and how long the
/// rest takes at that rate. Pure: news and times are handed in, in seconds.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/session/eta.h"
#include "engine/bake/bake_watch.h"
#include "engine/base/hash.h"

namespace acentric::editor {

struct QueuedCamera {
  int storey = 0;  ///< of the project
  int camera = 0;  ///< of the storey's layout as it was when the bake began
  double pixels = 0;
  CameraStage stage = CameraStage::waiting;
  bool previewing = false;  ///< what is being traced or written is its preview
  bool previewed = false;   ///< its preview is there
  double traced = 0;        ///< share of its columns, while it is traced
  double seconds = 0;       ///< of tracing
  std::string error = {};   ///< why it failed
  ContentKey key = {};      ///< of its capture
};

class BakeQueue {
 public:
  /// In baking order; those that are on disk already are `reused`.
  void begin(std::vector<QueuedCamera> cameras);
  void tell(double now, int storey, const CameraNews& news);
  /// Time that passes until the next news is no part of any rate.
  void pause();
  /// What was begun of a camera is given up.
  void end();

  const std::vector<QueuedCamera>& cameras() const { return cameras_; }
  int count(CameraStage stage) const { return counts_[std::size_t(stage)]; }
  int previewed() const { return previewed_; }
  /// Of those that were to be baked: how many there are, and how many are on disk, or given up.
  int toBake() const { return int(cameras_.size()) - reusedFirst_; }
  int finished() const;
  /// Of the pixels of all captures to be baked; previews do not count.
  double share() const;
  /// Of the last half minute.
  std::optional<double> raysPerSecond() const { return rays_.perSecond(); }
  /// Until the last capture is traced; nothing before a first one has told the rate.
  std::optional<double> secondsLeft(double now) const;
  /// The row of the camera that is traced, or was last.
  std::size_t current() const { return current_; }

 private:
  void setStage(QueuedCamera& row, CameraStage stage);

  std::vector<QueuedCamera> cameras_;
  std::map<std::pair<int, int>, std::size_t> rows_;  ///< by storey and camera
  std::array<int, 6> counts_{};                      ///< by stage
  int reusedFirst_ = 0;                              ///< of the list as it was begun
  int previewed_ = 0;
  double pixels_ = 0;                         ///< of all
  double donePixels_ = 0;                     ///< traced to the end, or reused
  double tracedPixels_ = 0, tracedRays_ = 0;  ///< since the bake began, without the camera that is traced
  Eta pace_, rays_;
  double lastTold_ = 0;
  std::size_t current_ = 0;
};

}  // namespace acentric::editor
