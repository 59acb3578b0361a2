#pragma once
/// Rays through pixels of a perspective picture against level planes and lines, and lines of the world as
/// they are drawn in it. World metres, azimuths counter-clockwise from +x, pixels from the picture's upper
/// left corner. What lies behind the eye, and what a ray meets only far away at a grazing angle, is refused.
/// Pure.

#include <optional>
#include <span>
#include <vector>

#include "engine/geometry/perspective_view.h"

namespace acentric::editor {

struct PointerRay {
  glm::dvec3 from{0};
  glm::dvec3 way{1, 0, 0};  ///< unit
};
PointerRay rayThrough(const PerspectiveView& view, const glm::dvec2& pixel);

/// Sine of the angle to a plane below which a ray is refused: it meets a plane 1 m below it 500 m away.
inline constexpr double kLeastPlaneSine = 0.002;
/// The same of the angle to a line, as far as it can still be told where they are nearest.
inline constexpr double kLeastLineSine = 0.03;

/// Where the ray meets the level plane of that height.
std::optional<glm::dvec2> onLevel(const PointerRay& ray, double height);
/// Metres from `origin` along `axis` (unit) to the place of that line that is nearest to the ray.
std::optional<double> alongLine(const PointerRay& ray, const glm::dvec3& origin, const glm::dvec3& axis);
/// The azimuth of the place where the ray meets the level plane through `centre`, as seen from there.
std::optional<double> azimuthAbout(const PointerRay& ray, const glm::dvec3& centre);

/// A line in the picture, pixels.
struct Stroke {
  glm::dvec2 from{0}, to{0};
};
/// The part of a line of the world that lies before the eye; nothing where all of it is behind.
std::optional<Stroke> strokeOf(const PerspectiveView& view, const glm::dvec3& from, const glm::dvec3& to);
/// The part of a convex polygon of the world that lies before the eye: its corners in the picture, in order.
std::vector<glm::dvec2> cornersBeforeEye(const PerspectiveView& view, std::span<const glm::dvec3> corners);
/// How large a metre across the line of sight is at a place; 0 behind the eye.
double pixelsPerMetre(const PerspectiveView& view, const glm::dvec3& place);
/// Pixels from a place of the picture to a line in it; `share`, if asked for: how far along it is nearest,
/// 0..1.
double distanceTo(const Stroke& stroke, const glm::dvec2& pixel, double* share = nullptr);

}  // namespace acentric::editor
