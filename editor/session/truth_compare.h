#pragma once
/// The walk against the truth: the picture that ray tracing gives at the eye of a frame, finer and finer, and
/// how near the frame is to the newest one. Traced and compared in the background; dropped as soon as the eye
/// is elsewhere. Main thread only.

#include <memory>
#include <optional>
#include <string>

#include "editor/session/job.h"
#include "engine/measure/compare.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

/// What a truth may end with, rays per pixel: squares, as renderTruth takes them.
inline constexpr int kTruthRays[] = {1, 4, 9, 16};
/// The first truth of all has one ray for so many pixels in each direction.
inline constexpr int kCoarseTruthPixels = 4;

/// From the same place in the same direction, whatever the size of the picture?
bool samePlace(const PerspectiveView& a, const PerspectiveView& b);
bool sameSize(const PerspectiveView& a, const PerspectiveView& b);

struct Truth {
  PerspectiveView view;
  int raysPerPixel = 0;  ///< 0: the coarse one, enlarged
  TruthFrame frame;      ///< as large as the view; no distances in the coarse one
};

struct CompareRequest {
  std::shared_ptr<const OpenProject> open;  ///< whose scene and bake settings light the truth
  PerspectiveView view;                     ///< of the frame
  float exposure = 1;                       ///< of the frame
  int raysPerPixel = 4;                     ///< of kTruthRays: the truth ends with them
  std::shared_ptr<const Frame> frame;
};

struct Compared {
  Comparison figures;
  int raysPerPixel = 0;  ///< of the truth
  int width = 0, height = 0;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const Truth> truth;
};

/// "PSNR 31.2 dB   SSIM 0.951   holes 0.12 % of pixels"
std::string figuresText(const Compared& compared);
/// What they are of: "against 4 rays per pixel, 592×501 pixels"
std::string againstText(const Compared& compared);
/// "truth, 4 rays per pixel", "truth, coarse: 1 ray for 4×4 pixels"
std::string describe(const Truth& truth);

class TruthCompare {
 public:
  TruthCompare(Inbox& inbox, int threads) : threads_(threads), tracing_(inbox), comparing_(inbox) {}

  /// What the walk shows; called each frame of the window. Nothing: the eye moves, or nobody compares.
  void follow(const std::optional<CompareRequest>& wanted);
  /// The finest so far of what is wanted; null before the first.
  const std::shared_ptr<const Truth>& truth() const { return truth_; }
  /// Of the frame that is wanted, against the finest truth that it was compared with; null before that.
  const std::shared_ptr<const Compared>& compared() const { return compared_; }
  /// Is a finer truth on its way?
  bool tracing() const { return tracing_.running(); }

 private:
  /// All that a truth depends on.
  struct Key {
    RayScenePtr rays;
    BakeSettings bake;
    float exposure = 1;
    PerspectiveView view;
    bool operator==(const Key& other) const;
  };
  void trace(const Key& key, int from, int to);
  void compareNewest(const std::shared_ptr<const Frame>& frame);

  int threads_;
  std::optional<Key> key_;
  int rays_ = 0;  // that the truth of key_ ends with
  std::shared_ptr<const Truth> truth_;
  std::shared_ptr<const Compared> compared_;
  std::shared_ptr<const Frame> askedFrame_;  // these two were last compared, or are being
  std::shared_ptr<const Truth> askedTruth_;
  Job tracing_, comparing_;
};

}  // namespace acentric::editor
