#pragma once
/// Two variants of a project in one walk: one that was kept, with its captures as far as they are on disk,
/// and the one that is edited. The kept one's frame is drawn in the background at the eye of the walk's, and
/// both are compared with the ray-traced truth. Main thread only.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/session/job.h"
#include "engine/measure/compare.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric::editor {

struct VariantFigures {
  Comparison kept, now;                  ///< against the truth
  std::vector<std::uint64_t> keptBytes;  ///< on disk, by camera
};

struct VariantRequest {
  std::shared_ptr<const OpenProject> now;
  PerspectiveView view;                ///< of the frame
  std::shared_ptr<const Frame> frame;  ///< null: not known yet
  std::size_t memoryBytes = 0;         ///< for the kept one's captures
};

class VariantCompare {
 public:
  static constexpr int kTruthRays = 4;  ///< per pixel

  VariantCompare(Inbox& inbox, int threads) : threads_(threads), drawing_(inbox), comparing_(inbox) {}

  void keep(std::shared_ptr<const OpenProject> variant);
  const std::shared_ptr<const OpenProject>& kept() const { return kept_; }
  void forget();

  /// Called each frame of the window. Nothing: the eye moves, or nobody compares.
  void follow(const std::optional<VariantRequest>& wanted);
  /// The kept one's, of the view that is wanted; null while it is drawn.
  const std::shared_ptr<const Frame>& frame() const { return frame_; }
  const std::shared_ptr<const VariantFigures>& figures() const { return figures_; }
  const std::string& problem() const { return problem_; }  ///< why there is no frame, one line; empty: none

 private:
  struct Key {
    std::shared_ptr<const OpenProject> kept;
    PerspectiveView view;
    bool operator==(const Key& other) const;
  };
  void draw(const Key& key, std::size_t memoryBytes);
  void compare(const VariantRequest& wanted);
  void clear();

  int threads_;
  std::shared_ptr<const OpenProject> kept_;
  std::shared_ptr<WalkStream> stream_;  ///< of kept_; only the drawing job reads it
  std::optional<Key> key_;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const VariantFigures> figures_;
  std::shared_ptr<const Frame> askedFrame_;  ///< figures are of it, or will be
  std::string problem_;
  Job drawing_, comparing_;
};

/// "kept 31.2 dB   58 MB   168 cameras"
std::string keptText(const VariantFigures& figures);
/// `bytes`: on disk by now, by camera.
std::string nowText(const VariantFigures& figures, std::span<const std::uint64_t> bytes);

}  // namespace acentric::editor
