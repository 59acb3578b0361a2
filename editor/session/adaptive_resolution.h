#pragma once
/// Resolution of the walk: lower while the eye moves and frames take too long, full once it rests. Pure.

namespace acentric::editor {

class AdaptiveResolution {
 public:
  static constexpr double kTargetSeconds = 0.033;  ///< a moving frame
  static constexpr double kLeast = 0.2;            ///< of the full width

  /// Fraction of the full width and height for a moving eye.
  double movingScale() const { return scale_; }
  /// A frame at `scale` took `seconds`; cost grows with the number of pixels and a fixed part.
  void measured(double scale, double seconds);

 private:
  double scale_ = 0.5;
};

}  // namespace acentric::editor
