#include "engine/inspect/built_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/scene/instances.h"
namespace acentric {
namespace {

constexpr double kLevel = 0.985;  // |cosine| of the slope of treads and lintels
constexpr std::uint64_t kMostOfInstances =
    2'000'000;                               // their triangles that are asked whether they are level
constexpr std::size_t kMostPieces = 100000;  // level triangles that are looked at
constexpr std::size_t kMostFound = 2000;     // of steps and of doors
constexpr int kFlight = 4;                   // steps, at least
constexpr int kStrides = 4;                  // rays on the length of one riser
constexpr double kLeastGoing = 0.7, kLargestGoing = 4.5;  // length of a tread in risers
constexpr double kAlike = 0.25;                           // share that lengths of one flight may differ by
constexpr double kGroup = 1.2;  // of lengths that are about the same, the largest over the least
constexpr double kLeastDoor = 1.4, kLargestDoor = 3.5;  // height over width
constexpr int kMostPoints = 32;                         // of one lintel
constexpr double kOutOfDoor = 0.4;                      // of the height: how far both rooms are looked into
constexpr glm::dvec3 kDown(0, 0, -1), kUp(0, 0, 1);

using Corners = std::array<glm::dvec3, 3>;

struct Found {
  double length, other;  ///< metres: of a step its riser and going, of a door its height and width
  glm::dvec3 place;
};

/// Level triangles, either side up; a sample of them where there are very many.
std::vector<Corners> levelPieces(const Scene& scene) {
  std::vector<Corners> pieces;
  eachTriangle(scene, kMostOfInstances,
               [&](std::uint32_t, const PlacedMesh& placed, std::uint32_t triangle, double) {
                 const auto at = placed.corners(triangle);
                 const Corners c{at[0], at[1], at[2]};
                 const glm::dvec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
                 if (std::abs(across.z) > kLevel * glm::length(across)) pieces.push_back(c);
               });
  if (pieces.size() <= kMostPieces) return pieces;
  std::vector<Corners> sample;
  for (std::size_t k = 0; k < kMostPieces; ++k) sample.push_back(pieces[k * pieces.size() / kMostPieces]);
  return sample;
}

/// The same thing is met from several triangles: kept once, and no more than tell the sizes.
void keep(const Found& one, double apart, std::vector<Found>& found) {
  const auto same = [&](const Found& other) { return glm::distance(one.place, other.place) < apart; };
  if (found.size() < kMostFound && std::ranges::none_of(found, same)) found.push_back(one);
}

/// Level ground under a point, its height; nothing over a slope or the void.
std::optional<double> groundUnder(const glm::dvec3& point, const SurfaceProbe& probe) {
  const SurfaceHit hit = probe(point, kDown);
  if (!hit.found() || std::abs(hit.normal.z) < kLevel) return std::nullopt;
  return point.z - hit.distance;
}

/// Walks down from an edge, stride by stride, as long as one step is like the other. `outward`: unit, in
/// plan, away from the tread; `near`: metres past the edge that are surely past it.
std::optional<Found> followSteps(const glm::dvec3& edge, double width, const glm::dvec2& outward, double near,
                                 const SurfaceProbe& probe) {
  const auto groundAt = [&](double along, double from) {
    return groundUnder({glm::dvec2(edge) + along * outward, from}, probe);
  };
  const auto first = groundAt(near, edge.z + 0.5 * near);
  if (!first || edge.z - *first < near || edge.z - *first > width) return std::nullopt;
  const double riser = edge.z - *first, stride = riser / kStrides;
  double level = *first, begin = near, leastGoing = kLargestGoing * riser, longestGoing = 0;
  int steps = 1;
  for (double along = near + stride; steps < kFlight; along += stride) {
    const auto ground = groundAt(along, level + 0.5 * riser);
    if (!ground || along - begin > kLargestGoing * riser) return std::nullopt;
    const double drop = level - *ground;
    if (std::abs(drop) < 0.1 * riser) continue;
    if (std::abs(drop - riser) > kAlike * riser) return std::nullopt;
    leastGoing = std::min(leastGoing, along - begin);
    longestGoing = std::max(longestGoing, along - begin);
    begin = along, level = *ground;
    ++steps;
  }
  const double going = (begin - near) / (kFlight - 1);
  if (longestGoing - leastGoing > kAlike * going + stride || going < kLeastGoing * riser) return std::nullopt;
  return Found{(edge.z - level) / kFlight, going, edge};
}

struct Jambs {
  double width;   ///< metres between them
  double middle;  ///< metres along to the middle between them
};

/// The walls on both sides; nothing where there is none, or not one wall from knee to head.
std::optional<Jambs> findJambs(const glm::dvec3& floor, double height, const glm::dvec3& along,
                               const SurfaceProbe& probe) {
  Jambs least{std::numeric_limits<double>::infinity(), 0};
  double most = 0;
  for (const double share : {0.2, 0.5, 0.85}) {
    const glm::dvec3 at = floor + share * height * kUp;
    const double ahead = probe(at, along).distance, behind = probe(at, -along).distance;
    if (ahead + behind < least.width) least = {ahead + behind, 0.5 * (ahead - behind)};
    most = std::max(most, ahead + behind);
  }
  if (!(most <= (1 + kAlike) * least.width)) return std::nullopt;
  return least;
}

/// Is there a room that way: a way out at half height, over a floor of the same height, under a higher
/// ceiling?
bool leadsToRoom(const glm::dvec3& floor, double height, const glm::dvec3& along, const SurfaceProbe& probe) {
  const double far = kOutOfDoor * height;
  const glm::dvec3 chest = floor + 0.5 * height * kUp;
  if (probe(chest, along).distance < 1.2 * far) return false;
  const glm::dvec3 outside = chest + far * along;
  const auto ground = groundUnder(outside, probe);
  return ground && std::abs(*ground - floor.z) < 0.1 * height && probe(outside, kUp).distance > 0.55 * height;
}

/// `lintel`: a point of it; `along`: unit, in plan, from jamb to jamb.
std::optional<Found> measureDoor(const glm::dvec3& lintel, const glm::dvec3& along, double near,
                                 const SurfaceProbe& probe) {
  const auto ground = groundUnder(lintel - near * kUp, probe);
  if (!ground || lintel.z - *ground < 10 * near) return std::nullopt;
  const double height = lintel.z - *ground;
  const glm::dvec3 floor(glm::dvec2(lintel), *ground), through(-along.y, along.x, 0);
  const auto jambs = findJambs(floor, height, along, probe);
  if (!jambs || height < kLeastDoor * jambs->width || height > kLargestDoor * jambs->width)
    return std::nullopt;
  if (!leadsToRoom(floor, height, through, probe) || !leadsToRoom(floor, height, -through, probe))
    return std::nullopt;
  return Found{height, jambs->width, floor + jambs->middle * along};
}

/// Points of the triangle side by side along its side from `a` to `b`, about as far apart as it is wide:
/// one lintel may span several doorways.
std::vector<glm::dvec3> pointsAlong(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double length = glm::distance(a, b), at = glm::dot(c - a, b - a) / (length * length);
  const double wide = glm::length(glm::cross(b - a, c - a)) / length;
  const int count = std::clamp(int(length / (2 * wide)), 1, kMostPoints);
  std::vector<glm::dvec3> points;
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count;
    const glm::dvec3 across = t < at ? glm::mix(a, c, t / at) : glm::mix(c, b, (t - at) / (1 - at));
    points.push_back(0.5 * (glm::mix(a, b, t) + across));
  }
  return points;
}

/// The middle one of the largest group.
CommonLength commonOf(std::vector<Found>& found) {
  std::ranges::sort(found, {}, &Found::length);
  CommonLength common{0, 0, int(found.size())};
  for (std::size_t k = 0, end = 0; k < found.size(); ++k) {
    while (end < found.size() && found[end].length <= kGroup * found[k].length) ++end;
    if (int(end - k) > common.count) common = {found[(k + end) / 2].length, int(end - k), common.of};
  }
  return common;
}

/// Less than all that people see of a scene, more than single precision blurs.
double nearFor(const Bounds& bounds) {
  const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(bounds.min)), glm::abs(glm::dvec3(bounds.max)));
  return 1e-6 * std::max({reach.x, reach.y, reach.z, glm::length(glm::dvec3(bounds.size()))});
}

void findSteps(const Corners& piece, double near, const SurfaceProbe& probe, std::vector<Found>& steps) {
  for (int side = 0; side < 3; ++side) {
    const glm::dvec3 &a = piece[side], &b = piece[(side + 1) % 3];
    const glm::dvec2 edge(b - a), inward(piece[(side + 2) % 3] - a);
    const double width = glm::length(edge);
    if (!(width > 10 * near)) continue;
    glm::dvec2 outward(edge.y / width, -edge.x / width);
    if (glm::dot(outward, inward) > 0) outward = -outward;
    const glm::dvec3 middle = 0.5 * (a + b);
    const auto step = followSteps(middle, width, outward, std::max(near, 0.002 * width), probe);
    if (step) keep(*step, step->length, steps);
  }
}

/// Along the longest side, and across it.
void findDoors(const Corners& piece, double near, const SurfaceProbe& probe, std::vector<Found>& doors) {
  int longest = 0;
  const auto side = [&](int k) { return piece[std::size_t((k + 1) % 3)] - piece[std::size_t(k % 3)]; };
  for (int k = 1; k < 3; ++k)
    if (glm::length(side(k)) > glm::length(side(longest))) longest = k;
  const glm::dvec2 edge(side(longest));
  if (!(glm::length(edge) > near)) return;
  const glm::dvec3 along(glm::normalize(edge), 0), across(-along.y, along.x, 0);
  const auto corner = [&](int k) { return piece[std::size_t((longest + k) % 3)]; };
  for (const glm::dvec3& point : pointsAlong(corner(0), corner(1), corner(2))) {
    auto door = measureDoor(point, along, near, probe);
    if (!door) door = measureDoor(point, across, near, probe);
    if (door) keep(*door, 0.5 * door->other, doors);
  }
}

}  // namespace

BuiltSizes measureBuiltSizes(const Scene& scene, const SurfaceProbe& probe, const std::stop_token& stop) {
  BuiltSizes sizes;
  if (scene.bounds.empty()) return sizes;
  const double near = nearFor(scene.bounds);
  std::vector<Found> steps, doors;
  for (const Corners& piece : levelPieces(scene)) {
    if (stop.stop_requested()) break;
    findSteps(piece, near, probe, steps);
    findDoors(piece, near, probe, doors);
  }
  sizes.riser = commonOf(steps);
  sizes.doorHeight = commonOf(doors);
  std::vector<double> widths;
  for (const Found& door : doors)
    if (door.length >= sizes.doorHeight.metres / kGroup && door.length <= sizes.doorHeight.metres * kGroup)
      widths.push_back(door.other);
  std::ranges::sort(widths);
  if (!widths.empty()) sizes.doorWidth = widths[widths.size() / 2];
  return sizes;
}

}  // namespace acentric
