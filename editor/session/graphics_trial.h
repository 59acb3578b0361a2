#pragma once
/// Whether walks are drawn on the graphics card where the project does not say so: only if the card draws a
/// frame of this walk as the processor does, and takes less time.

#include <string>
#include <string_view>

#include "editor/session/preferences.h"
#include "engine/view/frame.h"

namespace acentric::editor {

/// A description by OpenGL of a driver that draws on the processor.
bool isSoftwareRasteriser(std::string_view description);

class GraphicsTrial {
 public:
  /// Frames that differ more are not of the same walk, dB of their sRGB codes.
  static constexpr double kLeastLikeness = 35;

  /// Is a frame to be drawn for comparison?
  bool wanted(Graphics graphics, std::string_view description) const;
  bool passed(Graphics graphics) const { return graphics != Graphics::processor && state_ == State::passed; }
  /// Of the same view. `graphics`: whether the time counts. Returns what the user is to be told: empty where
  /// the card does, or is only slower.
  std::string judge(const Frame& processor, const Frame& card, Graphics graphics);
  /// It cannot draw at all.
  void refuse(Graphics graphics);

 private:
  enum class State { untried, passed, refused };
  State state_ = State::untried;
  Graphics triedFor_ = Graphics::automatic;
};

}  // namespace acentric::editor
