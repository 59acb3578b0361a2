#include "projects/gallery/generator/wall.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace acentric::gallery {
namespace {

constexpr int kArchSegments = 28;

/// Height of the opening's top at a distance from its middle.
float topAt(const Opening& o, float fromCentre) {
  if (!o.arched) return o.head;
  return o.head + std::sqrt(std::max(0.0f, o.half * o.half - fromCentre * fromCentre));
}

/// u of the cuts through an opening: denser towards the springings, where an arch is steep.
std::vector<float> cutsOf(const Opening& o) {
  std::vector<float> cuts;
  const int count = o.arched ? kArchSegments : 1;
  for (int i = 0; i <= count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    cuts.push_back(o.centre - o.half * (o.arched ? std::cos(glm::pi<float>() * t) : 1 - 2 * t));
  }
  cuts.front() = o.centre - o.half;
  cuts.back() = o.centre + o.half;
  return cuts;
}

}  // namespace

void addQuadFacing(Shape& shape, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::vec3& d, const glm::vec3& towards) {
  if (glm::dot(glm::cross(c - a, d - b), towards) >= 0)
    addQuad(shape, a, b, c, d);
  else
    addQuad(shape, a, d, c, b);
}

void addWall(Shape& shape, const WallSide& side, float uFrom, float uTo, float zFrom, float zTo,
             std::span<const Opening> openings) {
  const auto panel = [&](float u0, float u1, float z0, float z1, float z2, float z3) {
    // Corners: (u0, z0), (u1, z1), (u1, z2), (u0, z3).
    if (u1 - u0 < 1e-5f || (z3 - z0 < 1e-5f && z2 - z1 < 1e-5f)) return;
    addQuad(shape, side.at(u0, z0), side.at(u1, z1), side.at(u1, z2), side.at(u0, z3));
  };
  std::vector<Opening> sorted(openings.begin(), openings.end());
  std::ranges::sort(sorted, {}, &Opening::centre);
  float u = uFrom;
  for (const Opening& o : sorted) {
    panel(u, o.centre - o.half, zFrom, zFrom, zTo, zTo);
    const std::vector<float> cuts = cutsOf(o);
    const float bottom = std::clamp(o.sill, zFrom, zTo);
    panel(cuts.front(), cuts.back(), zFrom, zFrom, bottom, bottom);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const float left = std::clamp(topAt(o, cuts[i] - o.centre), zFrom, zTo);
      const float right = std::clamp(topAt(o, cuts[i + 1] - o.centre), zFrom, zTo);
      panel(cuts[i], cuts[i + 1], left, right, zTo, zTo);
    }
    u = o.centre + o.half;
  }
  panel(u, uTo, zFrom, zFrom, zTo, zTo);
}

void addReveal(Shape& shape, const WallSide& side, const Opening& o, float depth, bool withSill) {
  const glm::vec3 along = side.along(), up(0, 0, 1);
  const float left = o.centre - o.half, right = o.centre + o.half;
  const auto strip = [&](float u0, float z0, float u1, float z1, const glm::vec3& towards) {
    addQuadFacing(shape, side.at(u0, z0), side.at(u1, z1), side.at(u1, z1, -depth), side.at(u0, z0, -depth),
                  towards);
  };
  strip(left, o.sill, left, o.head, along);
  strip(right, o.sill, right, o.head, -along);
  if (withSill) strip(left, o.sill, right, o.sill, up);
  const std::vector<float> cuts = cutsOf(o);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const float a = cuts[i] - o.centre, b = cuts[i + 1] - o.centre;
    const glm::vec3 inwards =
        o.arched ? -(0.5f * (a + b) * along + 0.5f * (topAt(o, a) + topAt(o, b) - 2 * o.head) * up) : -up;
    strip(cuts[i], topAt(o, a), cuts[i + 1], topAt(o, b), inwards);
  }
}

void addRail(Shape& shape, const WallSide& side, float uFrom, float uTo, std::span<const glm::vec2> profile) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 a = profile[i], b = profile[i + 1];
    const glm::vec3 towards = side.normal * (b.y - a.y) + glm::vec3(0, 0, a.x - b.x);
    addQuadFacing(shape, side.at(uFrom, a.y, a.x), side.at(uTo, a.y, a.x), side.at(uTo, b.y, b.x),
                  side.at(uFrom, b.y, b.x), towards);
  }
  // Its two ends, as a fan from the wall.
  for (const float u : {uFrom, uTo}) {
    const glm::vec3 towards = side.along() * (u == uFrom ? -1.0f : 1.0f);
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
      addQuadFacing(shape, side.at(u, profile[i].y), side.at(u, profile[i].y, profile[i].x),
                    side.at(u, profile[i + 1].y, profile[i + 1].x), side.at(u, profile[i + 1].y), towards);
  }
}

void addSurround(Shape& shape, const WallSide& side, const Opening& o, std::span<const glm::vec2> profile) {
  struct Step {
    glm::vec2 place;  // u, z
    glm::vec2 away;   // from the opening
  };
  const float left = o.centre - o.half, right = o.centre + o.half;
  std::vector<std::vector<Step>> runs;
  runs.push_back({{{left, o.sill}, {-1, 0}}, {{left, o.head}, {-1, 0}}});
  if (o.arched) {
    runs.emplace_back();
    for (int i = 0; i <= kArchSegments; ++i) {
      const float angle = glm::pi<float>() * (1 - static_cast<float>(i) / kArchSegments);
      const glm::vec2 away(std::cos(angle), std::sin(angle));
      runs.back().push_back({glm::vec2(o.centre, o.head) + o.half * away, away});
    }
  } else {
    runs.push_back({{{left, o.head}, {-1, 1}}, {{right, o.head}, {1, 1}}});
    runs[0][1].away = {-1, 1};
  }
  runs.push_back(
      {{{right, o.head}, o.arched ? glm::vec2(1, 0) : glm::vec2(1, 1)}, {{right, o.sill}, {1, 0}}});
  const glm::vec3 along = side.along(), up(0, 0, 1);
  for (const auto& run : runs)
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const glm::vec2 step = profile[i + 1] - profile[i];
      const glm::vec2 facing = glm::normalize(glm::vec2(-step.y, step.x));
      const auto first = static_cast<std::uint32_t>(shape.positions.size());
      float length = 0;
      for (std::size_t k = 0; k < run.size(); ++k) {
        if (k > 0) length += glm::length(run[k].place - run[k - 1].place);
        // Straight runs face by their own direction, arcs by each place's.
        const glm::vec2 away = o.arched ? run[k].away : glm::normalize(run[0].away + run[1].away);
        const glm::vec3 normal =
            glm::normalize(facing.x * (away.x * along + away.y * up) + facing.y * side.normal);
        for (const glm::vec2& p : {profile[i], profile[i + 1]}) {
          const glm::vec2 place = run[k].place + p.x * run[k].away;
          shape.add(side.at(place.x, place.y, p.y), normal, {length, p.x});
        }
      }
      for (std::uint32_t k = 0; k + 1 < static_cast<std::uint32_t>(run.size()); ++k) {
        const std::uint32_t a = first + 2 * k, b = a + 1, c = a + 3, d = a + 2;
        const glm::vec3 across =
            glm::cross(shape.positions[c] - shape.positions[a], shape.positions[d] - shape.positions[b]);
        if (glm::dot(across, shape.normals[a]) > 0) {
          shape.triangle(a, b, c);
          shape.triangle(a, c, d);
        } else {
          shape.triangle(a, c, b);
          shape.triangle(a, d, c);
        }
      }
    }
}

}  // namespace acentric::gallery
