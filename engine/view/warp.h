#pragma once
/// Paints a plan's pieces on a canvas: the background of a frame.

#include <span>

#include "engine/view/canvas.h"
#include "engine/view/view_plan.h"

namespace acentric {

/// Splats are this much larger than a sample seen face on: surfaces that the capture saw at a slant, and the
/// eye does not, are sampled farther apart. With what a ceiling then adds, cracks are rare up to about 45
/// degrees.
inline constexpr double kSlantAllowance = 1.25;

struct WarpOptions {
  bool precise = false;               ///< in doubles
  bool depthTest = false;             ///< nearest sample wins instead of the last one
  const CoverImage* cover = nullptr;  ///< what hides the captures in the end
  /// By what covers a pixel: the mirror that it is, 0 = none. There reflections are drawn, over nothing.
  std::span<const std::uint8_t> coverMirrors = {};
};

/// Of one canvas.
struct WarpCounts {
  std::uint64_t samplesRead = 0;   ///< that may fall on it
  std::uint64_t samplesDrawn = 0;  ///< whose first pixel lies in the columns asked for

  WarpCounts& operator+=(const WarpCounts& other) {
    samplesRead += other.samplesRead, samplesDrawn += other.samplesDrawn;
    return *this;
  }
};

/// Are frames made of patches where captures have them?
bool wantsPatches(const ViewSettings& settings);
/// Are frames of this plan made of patches? All of its captures must have them.
bool drawsPatches(const WalkScene& scene, const ViewPlan& plan, const ViewSettings& settings);

/// So many pixels on either side of a pixel have a say in it.
int pixelsReadBeside(const ViewPlan& plan);

/// Makes it an empty canvas of columns [x0, x1) of the picture, with what the plan needs: stamps if some
/// piece holds blended samples, mirrors if there are reflections.
void clearCanvas(const WalkScene& scene, const PerspectiveView& view, const ViewPlan& plan, int x0, int x1,
                 Canvas& canvas);

/// Slots on the canvas, from back to front: holes, the background without a capture, backgrounds of captures,
/// pieces (those of the second cover, which only fill what the first leaves open, before the others),
/// reflections.
inline constexpr std::uint32_t kBackgroundSlot = 1;
inline std::uint32_t capturedBackgroundSlot(std::size_t i) {
  return kBackgroundSlot + 1 + static_cast<std::uint32_t>(i);
}
inline std::uint32_t pieceSlot(const ViewPlan& plan, std::size_t i) {
  return capturedBackgroundSlot(plan.backgrounds.size() + i);
}
inline std::uint32_t reflectionSlot(const ViewPlan& plan, std::size_t i) {
  return pieceSlot(plan, plan.pieces.size() + i);
}

/// Paints the pieces of the first cover; those of the second where nothing of the first lies, and before it
/// in its cracks (cracks.h); then what mirrors show over those pixels that the same mirror came to cover:
/// they keep the mirror's depth. Where a mirror of local geometry covers a pixel it shows that alone, or is a
/// hole. At most kMaxSlots slots. Columns [x0, x1) of the canvas are those that are counted, and are right if
/// it holds pixelsReadBeside more on either side. Pixels do not depend on how the picture is cut into
/// canvases: a capture's columns fall on nearly vertical lines, so few samples fall on two.
WarpCounts warpPieces(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                      const ViewPlan& plan, const WarpOptions& options, int x0, int x1, Canvas& canvas);

}  // namespace acentric
