#include "engine/bake/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace acentric {
namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The direction at b's side of a, across it.
glm::dvec3 acrossFrom(const glm::dvec3& a, const glm::dvec3& b) { return unitOrZero(b - glm::dot(a, b) * a); }

}  // namespace

double triangleIrradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal) {
  std::array<glm::dvec3, 4> above;  // of the horizon
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &from = corners[i], &to = corners[(i + 1) % 3];
    const double h = glm::dot(from, normal), next = glm::dot(to, normal);
    if (h > 0) above[count++] = from;
    if ((h > 0) != (next > 0)) above[count++] = from + (to - from) * (h / (h - next));
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 &from = above[i], &to = above[(i + 1) % count];
    sum += angleBetween(from, to) * glm::dot(unitOrZero(glm::cross(from, to)), normal);
  }
  return 0.5 * std::abs(sum);
}

SphericalTriangle::SphericalTriangle(const std::array<glm::dvec3, 3>& corners)
    : a_(unitOrZero(corners[0])), b_(unitOrZero(corners[1])), c_(unitOrZero(corners[2])) {
  const auto angleAt = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return angleBetween(acrossFrom(a, b), acrossFrom(a, c));
  };
  angleAtA_ = angleAt(a_, b_, c_);
  solidAngle_ = std::max(0.0, angleAtA_ + angleAt(b_, c_, a_) + angleAt(c_, a_, b_) - std::numbers::pi);
}

glm::dvec3 SphericalTriangle::directionAt(glm::dvec2 u) const {
  // A smaller triangle a, b, c' with c' on the arc ac has the share u.x of the area ...
  const double phi = u.x * solidAngle_ - angleAtA_;
  const double s = std::sin(phi), t = std::cos(phi);
  const double sinA = std::sin(angleAtA_), cosA = std::cos(angleAtA_);
  const double p = t - cosA, r = s + sinA * glm::dot(a_, b_);
  const double below = (r * s + p * t) * sinA;
  const double q = below != 0 ? std::clamp(((r * t - p * s) * cosA - r) / below, -1.0, 1.0) : 1;
  const glm::dvec3 c = q * a_ + std::sqrt(1 - q * q) * acrossFrom(a_, c_);
  // ... and on the arc from b to c', heights are areas.
  const double z = 1 - u.y * (1 - glm::dot(c, b_));
  return unitOrZero(z * b_ + std::sqrt(std::max(0.0, 1 - z * z)) * acrossFrom(b_, c));
}

}  // namespace acentric
