#pragma once
/// What can be shown of a frame: itself, the truth, how they differ, which camera painted what, its holes.

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/bake/truth.h"
#include "engine/cli/command.h"
#include "engine/measure/source_colours.h"

namespace acentric::cli {

enum class PictureMode : std::uint8_t {
  picture,
  truth,       ///< ray-traced
  difference,  ///< from the truth, amplified
  beside,      ///< picture and truth side by side
  sources,     ///< which camera painted what
  holes,       ///< where no camera did
};
inline constexpr PictureMode kPictureModes[] = {PictureMode::picture,    PictureMode::truth,
                                                PictureMode::difference, PictureMode::beside,
                                                PictureMode::sources,    PictureMode::holes};
const char* nameOf(PictureMode mode);
std::vector<std::string> pictureModeNames();
/// Names of modes, as CLI11 has checked them.
std::vector<PictureMode> pictureModes(std::span<const std::string> names);

bool needsTruth(PictureMode mode);
inline bool needsTruth(std::span<const PictureMode> modes) {
  return std::ranges::any_of(modes, [](PictureMode mode) { return needsTruth(mode); });
}

/// Makes them of frames of a project's storeys.
class FramePictures {
 public:
  /// `storeys` must outlive it. `gain` amplifies differences.
  FramePictures(std::span<const OpenProject> storeys, int gain);

  /// `truth`: of the same view; may be null where the mode does not need it.
  ColourImage make(PictureMode mode, const Frame& frame, const PerspectiveView& view,
                   const TruthFrame* truth) const;
  /// The same with what its colours mean below, in the modes whose colours mean something.
  Result<ColourImage> makeWithLegend(PictureMode mode, const Frame& frame, const PerspectiveView& view,
                                     const TruthFrame* truth) const;
  /// "x4", of differences.
  int gain() const { return gain_; }
  /// [{source, role, share, colour}], the most first.
  Json sourcesJson(const Frame& frame, const PerspectiveView& view) const;

 private:
  const Layout& layoutAt(const PerspectiveView& view) const;
  const SourceColours& coloursAt(const PerspectiveView& view) const;

  std::span<const OpenProject> storeys_;
  int gain_;
  mutable std::vector<std::unique_ptr<const SourceColours>> colours_;  ///< of storeys_, made when needed
};

}  // namespace acentric::cli
