#pragma once
/// Units, frames and pixel conventions of the whole engine, stated once.
///
/// World frame: metres, right-handed, Z up; the walk plane is horizontal. Positions are relative to the
/// project origin (a double-precision offset kept in the Scene), so float is enough for geometry.
/// Angles: radians unless a name says Degrees. Azimuth (yaw) is counter-clockwise seen from above, 0 = +X,
/// pi/2 = +Y. Pitch is positive upwards. "Left/right" are as seen by the eye.
/// Images: column u to the right, row v downwards, pixel (0,0) covers [0,1)x[0,1), its centre is (0.5,0.5).
/// View axes: x right, y down, z forward; zDepth is along z, rayDistance along the ray,
/// inverseDistance w = 1 / horizontal distance from a centre of projection (0 = sky).
/// Polygons in plan: counter-clockwise, seen from above.

#include <glm/glm.hpp>
#include <numbers>

namespace acentric {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2 * std::numbers::pi;

constexpr double radians(double degrees) { return degrees * kPi / 180; }
constexpr double degrees(double radiansValue) { return radiansValue * 180 / kPi; }

/// The angle in [0, 2 pi).
double wrapAngle(double radiansValue);

/// Unit direction of an azimuth.
glm::dvec2 directionOf(double azimuth);

/// z component of the cross product: > 0 if b is counter-clockwise of a.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace acentric
