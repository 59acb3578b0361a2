#include "engine/inspect/sampling_rate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {

SurfaceAxes axesOf(const glm::dvec3& normal) {
  const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(normal, other));
  return {first, glm::cross(normal, first)};
}

glm::dmat2 samplesPerMetre(const ColumnCamera& camera, const glm::dvec3& point, const SurfaceAxes& axes) {
  const glm::dvec3 offset = point - camera.centreOfProjection;
  const double flat = glm::length(glm::dvec2(offset)), square = glm::dot(offset, offset);
  // How azimuth and elevation change with the point.
  const glm::dvec3 azimuth = glm::dvec3(-offset.y, offset.x, 0) / (flat * flat);
  const glm::dvec3 elevation =
      (glm::dvec3(0, 0, flat) - glm::dvec3(offset.x, offset.y, 0) * (offset.z / flat)) / square;
  const auto step = [&](const glm::dvec3& axis) {
    return glm::dvec2(glm::dot(azimuth, axis) / camera.columnPitch(),
                      glm::dot(elevation, axis) / camera.rowPitch());
  };
  return {step(axes.first), step(axes.second)};
}

glm::dmat2 pixelsPerMetre(const glm::dvec3& eye, double focalPixels, const glm::dvec3& point,
                          const SurfaceAxes& axes) {
  const glm::dvec3 offset = point - eye;
  const double distance = glm::length(offset);
  const SurfaceAxes across = axesOf(offset / distance);
  const auto step = [&](const glm::dvec3& axis) {
    return focalPixels / distance * glm::dvec2(glm::dot(across.first, axis), glm::dot(across.second, axis));
  };
  return {step(axes.first), step(axes.second)};
}

double RateAndNeed::ratio() const { return need > 0 ? rate / need : std::numeric_limits<double>::infinity(); }

RateAndNeed compareRates(const glm::dmat2& samples, const glm::dmat2& pixels) {
  // The least of |samples t|^2 / |pixels t|^2: the smaller root x of det(S - x P) = 0.
  const glm::dmat2 s = glm::transpose(samples) * samples, p = glm::transpose(pixels) * pixels;
  const double mixed = s[0][0] * p[1][1] + s[1][1] * p[0][0] - 2 * s[0][1] * p[0][1];
  const double product = glm::determinant(s) * glm::determinant(p);
  const double root = std::sqrt(std::max(0.0, mixed * mixed - 4 * product));
  const double least = mixed + root > 0 ? 2 * glm::determinant(s) / (mixed + root) : 0;
  const glm::dmat2 rest{s[0] - least * p[0], s[1] - least * p[1]};
  // The direction that `rest` takes to zero, by its larger row.
  const glm::dvec2 upper(rest[0][0], rest[1][0]), lower(rest[0][1], rest[1][1]);
  const glm::dvec2 row = glm::dot(upper, upper) >= glm::dot(lower, lower) ? upper : lower;
  const double length = glm::length(row);
  const glm::dvec2 along = length > 0 ? glm::dvec2(-row.y, row.x) / length : glm::dvec2(1, 0);
  return {glm::length(samples * along), glm::length(pixels * along)};
}

}  // namespace acentric
