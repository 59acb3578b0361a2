#pragma once
/// The eye of the 3D view: it looks at a target from a distance, and is turned about it, moved along with it
/// and brought nearer by what the pointer does. Pure.

#include <glm/glm.hpp>

#include "engine/geometry/perspective_view.h"

namespace acentric::editor {

class OrbitCamera {
 public:
  static constexpr double kFovRadians = 0.9;  ///< of the wider side of the picture
  static constexpr double kMostPitchRadians = 1.553;
  static constexpr double kRadiansPerPixel = 0.006;
  static constexpr double kNearest = 1e-4, kFarthest = 1e7;  ///< metres from the target

  bool operator==(const OrbitCamera&) const = default;

  /// Pixels; at least 1 x 1.
  void setSize(const glm::ivec2& size);
  /// A picture of `scale` times as many pixels each way.
  PerspectiveView view(double scale = 1) const;
  glm::dvec3 eye() const { return target_ - distance_ * forward(); }
  const glm::dvec3& target() const { return target_; }
  double distance() const { return distance_; }

  /// Shows a box from obliquely above (`fresh`), or from where it is looked from now.
  void frame(const glm::dvec3& low, const glm::dvec3& high, bool fresh);
  /// Drags the world about the target: to the right turns it counter-clockwise seen from above.
  void orbit(const glm::dvec2& pixels);
  /// Moves so that a point stays under the pointer while that moves by `pixels`.
  void pan(const glm::dvec2& pixels, const glm::dvec3& held);
  /// `factor` < 1 comes nearer; the point stays where it is in the picture.
  void dolly(double factor, const glm::dvec3& towards);
  /// The point in the middle, at the same distance and from the same side.
  void centreOn(const glm::dvec3& point) { target_ = point; }

  /// Unit, through a place of the picture (pixels).
  glm::dvec3 rayThrough(const glm::dvec2& pixel) const;
  /// Where that ray meets the plane through the target that faces the eye: what to hold on to where there is
  /// no surface.
  glm::dvec3 besideTarget(const glm::dvec2& pixel) const;

 private:
  glm::dvec3 forward() const;

  glm::dvec3 target_{0};
  double distance_ = 10;
  double yawRadians_ = 1.1, pitchRadians_ = -0.75;
  glm::ivec2 size_{1};
};

/// Where a world point lies in a view's picture, pixels; `depth` along its axis, metres: <= 0 is behind.
struct Projected {
  glm::dvec2 pixel{0};
  double depth = 0;
};
Projected project(const PerspectiveView& view, const glm::dvec3& point);

}  // namespace acentric::editor
