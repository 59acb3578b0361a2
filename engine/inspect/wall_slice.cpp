#include "engine/inspect/wall_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/geometry/conventions.h"
#include "engine/scene/instances.h"

namespace acentric {
namespace {

constexpr double kUprightCosine = 0.342;  ///< of 70 degrees: between a wall's normal and the vertical
constexpr double kShortest = 0.002;       ///< metres
constexpr double kJoin = 0.005;           ///< metres within which ends meet
constexpr double kTurn = 0.26;            ///< radians: straighter joints are no corners
constexpr int kBins = 360;                ///< over a right angle

struct Piece {
  glm::dvec2 from, to;
};

std::optional<Piece> cut(const std::array<glm::vec3, 3>& corners, double height) {
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0]));
  if (std::abs(normal.z) > kUprightCosine * glm::length(normal)) return std::nullopt;
  std::array<glm::dvec2, 2> ends;
  std::size_t found = 0;
  for (int k = 0; k < 3 && found < 2; ++k) {
    const glm::dvec3 a(corners[std::size_t(k)]), b(corners[std::size_t((k + 1) % 3)]);
    if ((a.z < height) == (b.z < height)) continue;
    const double t = (height - a.z) / (b.z - a.z);
    ends[found++] = glm::dvec2(a) + t * (glm::dvec2(b) - glm::dvec2(a));
  }
  if (found < 2 || glm::distance(ends[0], ends[1]) < kShortest) return std::nullopt;
  return Piece{ends[0], ends[1]};
}

/// The mean of the directions about the heaviest bin, by length.
std::optional<double> directionOfMost(const std::vector<Piece>& pieces) {
  if (pieces.empty()) return std::nullopt;
  const double quarter = kPi / 2;
  const auto angleOf = [&](const Piece& piece) {
    const glm::dvec2 way = piece.to - piece.from;
    const double angle = std::fmod(std::atan2(way.y, way.x) + kTwoPi, quarter);
    return angle < quarter ? angle : 0.0;
  };
  std::array<double, kBins> lengths{};
  for (const Piece& piece : pieces)
    lengths[std::min(std::size_t(angleOf(piece) / quarter * kBins), std::size_t(kBins - 1))] +=
        glm::distance(piece.from, piece.to);
  // Neighbours count with it: noise about one direction falls on both sides of a bin's border.
  int best = 0;
  double most = -1;
  for (int bin = 0; bin < kBins; ++bin) {
    double sum = 0;
    for (int k = -2; k <= 2; ++k) sum += lengths[std::size_t((bin + k + kBins) % kBins)];
    if (sum > most) most = sum, best = bin;
  }
  const double middle = (best + 0.5) * quarter / kBins;
  double sum = 0, weight = 0;
  for (const Piece& piece : pieces) {
    double away = angleOf(piece) - middle;
    away -= std::round(away / quarter) * quarter;
    if (std::abs(away) > 2.5 * quarter / kBins) continue;
    const double length = glm::distance(piece.from, piece.to);
    sum += length * away, weight += length;
  }
  const double direction = std::fmod(middle + (weight > 0 ? sum / weight : 0) + quarter, quarter);
  return direction > quarter - 1e-9 ? 0 : direction;
}

std::vector<glm::dvec2> cornersOf(const std::vector<Piece>& pieces) {
  struct Joint {
    glm::dvec2 place, way;
    bool bends = false;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Joint> joints;
  for (const Piece& piece : pieces) {
    const glm::dvec2 way = glm::normalize(piece.to - piece.from);
    for (const glm::dvec2& end : {piece.from, piece.to}) {
      const std::pair key(std::llround(end.x / kJoin), std::llround(end.y / kJoin));
      const auto [joint, isNew] = joints.try_emplace(key, Joint{end, way});
      if (!isNew && std::abs(cross(joint->second.way, way)) > std::sin(kTurn)) joint->second.bends = true;
    }
  }
  std::vector<glm::dvec2> corners;
  for (const auto& [key, joint] : joints)
    if (joint.bends) corners.push_back(joint.place);
  return corners;
}

}  // namespace

WallSlice sliceWalls(const Scene& scene, double height, const std::stop_token& stop) {
  std::vector<Piece> pieces;
  const std::vector<Bounds> own = boundsOf(scene.prototypes);
  for (std::uint32_t m = 0; m < scene.placedCount(); ++m) {
    if (stop.stop_requested()) return {};
    if (scene.isInstance(m)) {
      const Instance& instance = scene.instances[m - scene.meshes.size()];
      const Bounds box = boundsOf(instance, own[instance.prototype]);
      if (!(double(box.min.z) < height && double(box.max.z) >= height)) continue;
    }
    const PlacedMesh placed(scene, m);
    for (std::uint32_t t = 0; t < placed.mesh().triangles.size(); ++t)
      if (const auto piece = cut(placed.corners(t), height)) pieces.push_back(*piece);
  }
  return {cornersOf(pieces), directionOfMost(pieces)};
}

}  // namespace acentric
