#include "engine/inspect/surroundings.h"

#include <array>
#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr int kLevel = 24, kTilted = 12;
constexpr int kDirections = kLevel + 2 * kTilted + 2;
constexpr int kMostCrossings = 64;

/// Level first, where walls are; straight down last. A small turn keeps rays off planes through the axes.
std::array<glm::dvec3, kDirections> makeDirections() {
  std::array<glm::dvec3, kDirections> directions;
  std::size_t n = 0;
  constexpr double kTurn = 0.013;  // radians
  for (int k = 0; k < kLevel; ++k) directions[n++] = glm::dvec3(directionOf(kTurn + kTwoPi * k / kLevel), 0);
  for (const double side : {1.0, -1.0})
    for (int k = 0; k < kTilted; ++k)
      directions[n++] = glm::normalize(glm::dvec3(directionOf(kTurn + kTwoPi * k / kTilted), side));
  directions[n++] = {0, 0, 1};
  directions[n++] = {0, 0, -1};
  return directions;
}

const std::array<glm::dvec3, kDirections>& directionsAround() {
  static const auto directions = makeDirections();
  return directions;
}

bool crossesOdd(const glm::dvec3& point, const glm::dvec3& direction, const SurfaceProbe& probe) {
  double from = 0;
  int crossings = 0;
  for (; crossings < kMostCrossings; ++crossings) {
    const SurfaceHit hit = probe(point + from * direction, direction);
    if (!hit.found()) break;
    from += hit.distance + std::max(1e-4, 4e-6 * (from + hit.distance));
  }
  return crossings % 2 == 1;
}

}  // namespace

Surroundings lookAround(const glm::dvec3& point, const SurfaceProbe& probe) {
  Surroundings around;
  for (const glm::dvec3& direction : directionsAround()) {
    ++around.directions;
    const SurfaceHit hit = probe(point, direction);
    if (!hit.found()) continue;
    if (hit.distance < around.nearest) around.nearest = hit.distance, around.towards = direction;
    if (hit.showsBack(direction)) ++around.backs;
    if (direction.z == -1) around.floor = point.z - hit.distance;
  }
  if (4 * around.backs > around.directions)
    for (const glm::dvec3& direction : directionsAround())
      if (crossesOdd(point, direction, probe)) ++around.odd;
  return around;
}

bool hasRoom(const glm::dvec3& point, double room, const SurfaceProbe& probe) {
  for (const glm::dvec3& direction : directionsAround())
    if (probe(point, direction).distance < room) return false;
  return true;
}

}  // namespace acentric
