#include "projects/forest/generator/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "projects/gallery/generator/noise.h"

namespace acentric::forest {
namespace {

using gallery::Random;
using gallery::Shape;

constexpr float kGolden = 137.50776f;  // degrees between stems that follow each other
constexpr float kTip = 0.25f;          // radius of a stem's end, share of its foot's

struct Stem {
  int level = 0;
  std::vector<glm::vec3> points;
  float radius = 0;  ///< at its foot

  float radiusAt(float t) const { return radius * glm::mix(1.0f, kTip, t); }
  glm::vec3 at(float t) const {
    const float place = std::clamp(t, 0.0f, 1.0f) * float(points.size() - 1);
    const auto i = std::min(std::size_t(place), points.size() - 2);
    return glm::mix(points[i], points[i + 1], place - float(i));
  }
  glm::vec3 directionAt(float t) const {
    const auto i =
        std::min(std::size_t(std::clamp(t, 0.0f, 1.0f) * float(points.size() - 1)), points.size() - 2);
    return glm::normalize(points[i + 1] - points[i]);
  }
};

glm::vec3 turnedAbout(const glm::vec3& v, const glm::vec3& axis, float degrees) {
  return glm::vec3(glm::rotate(glm::mat4(1), glm::radians(degrees), axis) * glm::vec4(v, 0));
}

/// Some unit vector at right angles.
glm::vec3 besideOf(const glm::vec3& v) {
  return glm::normalize(glm::cross(v, std::abs(v.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
}

/// Length of a branch by where it grows; `above` is 1 where branches begin and 0 at the top (Weber and Penn,
/// Creation and Rendering of Realistic Trees, 1995).
float shareOfCrown(Crown crown, float above) {
  switch (crown) {
    case Crown::cone:
      return 0.12f + 0.88f * above;
    case Crown::flame:
      return above <= 0.7f ? 0.3f + 0.7f * above / 0.7f : 0.3f + 0.7f * (1 - above) / 0.3f;
    case Crown::broad:
      return 0.45f + 0.55f * std::sin(0.5f * glm::pi<float>() * std::min(1.0f, above + 0.2f));
    case Crown::round:
      break;
  }
  return 0.35f + 0.65f * std::sin(glm::pi<float>() * std::clamp(0.12f + 0.82f * above, 0.0f, 1.0f));
}

Stem grown(const StemLevel& how, int level, const glm::vec3& foot, glm::vec3 direction, float length,
           float radius, Random& random) {
  Stem stem{level, {foot}, radius};
  const float step = length / float(how.segments);
  for (int i = 0; i < how.segments; ++i) {
    const float bend = how.bend / std::sqrt(float(how.segments));
    const glm::vec3 beside = besideOf(direction), other = glm::cross(direction, beside);
    direction = turnedAbout(direction, beside, random.between(-bend, bend));
    direction = turnedAbout(direction, other, random.between(-bend, bend));
    direction = glm::normalize(direction + glm::vec3(0, 0, how.up / float(how.segments)));
    stem.points.push_back(stem.points.back() + step * direction);
  }
  return stem;
}

std::vector<Stem> grow(const Species& species, Random& random) {
  std::vector<Stem> stems;
  const StemLevel& trunk = species.levels.front();
  for (int i = 0; i < trunk.count; ++i) {
    const float around = kGolden * float(i) + random.between(0, 40);
    const float lean = trunk.count > 1 ? trunk.angle + random.between(-1, 1) * trunk.angleSpread : 0;
    const glm::vec3 direction = turnedAbout(turnedAbout({0, 0, 1}, {1, 0, 0}, lean), {0, 0, 1}, around);
    const glm::vec3 foot = trunk.count > 1 ? 0.12f * glm::vec3(direction.x, direction.y, 0) : glm::vec3(0);
    stems.push_back(grown(trunk, 0, foot, direction,
                          trunk.length * (1 + random.between(-1, 1) * trunk.lengthSpread), trunk.radius,
                          random));
  }
  std::size_t from = 0;
  for (std::size_t level = 1; level < species.levels.size(); ++level) {
    const StemLevel& how = species.levels[level];
    const std::size_t to = stems.size();
    for (std::size_t s = from; s < to; ++s) {
      float around = random.between(0, 360), length = 0;
      for (std::size_t i = 0; i + 1 < stems[s].points.size(); ++i)
        length += glm::distance(stems[s].points[i], stems[s].points[i + 1]);
      for (int c = 0; c < how.count; ++c) {
        const float t = glm::mix(how.first, 0.98f, (float(c) + random.unit()) / float(how.count));
        const glm::vec3 along = stems[s].directionAt(t);
        // Twigs in a plane grow to the sides; others around.
        around += how.flat ? 180.0f : kGolden;
        const glm::vec3 up = besideOf(along);  // level
        const glm::vec3 axis =
            how.flat ? turnedAbout(glm::cross(up, along), along, around + random.between(-18, 18))
                     : turnedAbout(up, along, around);
        const float angle = glm::mix(how.angle, how.angleAtTip, t) + random.between(-1, 1) * how.angleSpread;
        const glm::vec3 direction = turnedAbout(along, axis, angle);
        const float share =
            level == 1 ? shareOfCrown(species.crown, (1 - t) / (1 - how.first)) : 1 - 0.55f * t;
        stems.push_back(grown(how, int(level), stems[s].at(t), direction,
                              length * how.length * share * (1 + random.between(-1, 1) * how.lengthSpread),
                              std::max(0.003f, stems[s].radiusAt(t) * how.radius), random));
      }
    }
    from = to;
  }
  return stems;
}

/// How finely bark is modelled: sides of the tubes by level, 0 = none, and of how many points one is taken.
struct BarkDetail {
  std::array<int, 4> sides;
  int stride;
};
constexpr std::array<BarkDetail, 6> kBarkDetails{{{{3, 0, 0, 0}, 4},
                                                  {{5, 3, 0, 0}, 4},
                                                  {{6, 3, 3, 0}, 2},
                                                  {{8, 5, 3, 0}, 1},
                                                  {{10, 6, 4, 3}, 1},
                                                  {{16, 8, 5, 3}, 1}}};

void addTube(Shape& out, const Stem& stem, int sides, int stride, float flare) {
  std::vector<std::size_t> rings;
  for (std::size_t i = 0; i + 1 < stem.points.size(); i += std::size_t(stride)) rings.push_back(i);
  rings.push_back(stem.points.size() - 1);
  glm::vec3 side = besideOf(stem.directionAt(0));
  const auto first = std::uint32_t(out.positions.size());
  // The picture, a metre wide, fits around a whole number of times, or a part of it once.
  const float around = 2 * glm::pi<float>() * stem.radius;
  const float width = around > 0.6f ? std::round(around) + (around < 1 ? 1 : 0) : around;
  float length = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const float t = float(rings[r]) / float(stem.points.size() - 1);
    const glm::vec3 along = stem.directionAt(t);
    side = glm::normalize(side - along * glm::dot(side, along));
    const glm::vec3 other = glm::cross(along, side);
    if (r > 0) length += glm::distance(stem.points[rings[r]], stem.points[rings[r - 1]]);
    const float radius = stem.radiusAt(t) * (1 + flare * std::exp(-length / (2.2f * stem.radius)));
    for (int s = 0; s <= sides; ++s) {
      const float angle = s == sides ? 0.0f : 2 * glm::pi<float>() * float(s) / float(sides);
      const glm::vec3 normal = std::cos(angle) * side + std::sin(angle) * other;
      out.add(stem.points[rings[r]] + radius * normal, normal, {width * float(s) / float(sides), -length});
    }
  }
  const auto row = std::uint32_t(sides + 1);
  for (std::uint32_t r = 0; r + 1 < std::uint32_t(rings.size()); ++r)
    for (std::uint32_t s = 0; s < std::uint32_t(sides); ++s) {
      const std::uint32_t a = first + r * row + s;
      out.triangle(a, a + 1, a + row + 1);
      out.triangle(a, a + row + 1, a + row);
    }
}

/// The trunk's foot goes a little into the ground.
Shape barkOf(const std::vector<Stem>& stems, const Species& species, const BarkDetail& detail) {
  Shape out;
  for (const Stem& stem : stems)
    if (const int sides = detail.sides[std::size_t(std::min(stem.level, 3))]; sides > 0)
      addTube(out, stem, sides, detail.stride, stem.level == 0 ? species.flare : 0.0f);
  for (glm::vec3& p : out.positions)
    if (p.z < 0.02f) p.z -= 0.25f;
  return out;
}

/// A card of four triangles, bent along its length: `along` and `across` are its sides, one of the four
/// pictures on it.
void addCard(Shape& out, const glm::vec3& foot, const glm::vec3& along, const glm::vec3& across,
             const glm::vec3& sag, const glm::vec3& normal, int picture) {
  const glm::vec2 corner(0.5f * float(picture & 1), 0.5f * float(picture >> 1));
  std::array<std::uint32_t, 6> v{};
  for (int row = 0; row < 3; ++row) {
    const float t = 0.5f * float(row);
    const glm::vec3 middle = foot + t * along + t * t * sag;
    for (int side = 0; side < 2; ++side)
      v[std::size_t(2 * row + side)] =
          out.add(middle + (float(side) - 0.5f) * across, normal,
                  corner + 0.5f * glm::vec2(0.01f + 0.98f * float(side), 0.99f - 0.98f * t));
  }
  for (const std::size_t row : {std::size_t(0), std::size_t(2)}) {
    out.triangle(v[row], v[row + 1], v[row + 3]);
    out.triangle(v[row], v[row + 3], v[row + 2]);
  }
}

constexpr std::size_t kCard = 4;  // triangles

Shape leavesOf(const std::vector<Stem>& stems, const Species& species, std::size_t cards, std::size_t all,
               Random random) {
  std::vector<const Stem*> twigs;
  const int last = int(species.levels.size()) - 1;
  glm::vec3 low(1e9f), high(-1e9f);
  for (const Stem& stem : stems)
    if (stem.level == last) {
      twigs.push_back(&stem);
      low = glm::min(low, stem.points.back()), high = glm::max(high, stem.points.back());
    }
  // Twigs far apart from each other come one after the other, so that few cards are spread evenly.
  for (std::size_t i = twigs.size(); i > 1; --i)
    std::swap(twigs[i - 1], twigs[std::size_t(random.below(int(i)))]);
  const Leaves& leaves = species.leaves;
  // As much is covered, whatever their number; but no card gets larger than a large branch.
  const float size = std::min(6.0f, std::sqrt(float(all) / float(std::max<std::size_t>(cards, 1))));
  const glm::vec3 middle = 0.5f * (low + high), half = glm::max(0.5f * (high - low), glm::vec3(0.1f));
  Shape out;
  for (std::size_t i = 0; i < cards; ++i) {
    const Stem& twig = *twigs[i % twigs.size()];
    const float t =
        glm::mix(leaves.from, 1.0f,
                 std::fmod(0.7548777f * float(i / twigs.size()) + random.unit() * 0.2f + 0.3f, 1.0f));
    const glm::vec3 direction = twig.directionAt(t);
    const glm::vec3 axis =
        turnedAbout(besideOf(direction), direction, kGolden * float(i) + random.between(-30, 30));
    glm::vec3 along = turnedAbout(direction, axis, leaves.angle + random.between(-15, 15));
    glm::vec3 normal = glm::cross(axis, along);
    const glm::vec3 outwards =
        glm::normalize((twig.at(t) - middle) / half + glm::vec3(0, 0, 0.35f) +
                       0.3f * glm::vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    if (glm::dot(normal, outwards) < 0) normal = -normal;
    if (leaves.upright > 0) {
      normal = glm::normalize(glm::mix(normal, glm::vec3(0, 0, 1), leaves.upright));
      along = glm::normalize(along - normal * glm::dot(along, normal));
    }
    const glm::vec3 across = glm::normalize(glm::cross(along, normal));
    const float scale = size * random.between(0.75f, 1.2f);
    // Light falls on a crown as on one round body.
    addCard(out, twig.at(t), scale * leaves.length * along, scale * leaves.width * across,
            {0, 0, -scale * leaves.length * leaves.droop}, glm::normalize(0.5f * normal + 0.5f * outwards),
            random.below(4));
  }
  return out;
}

}  // namespace

gallery::Thing makeTree(const Species& species, std::size_t triangles, std::uint64_t seed, int bark,
                        int leaf) {
  Random random(seed);
  const std::vector<Stem> stems = grow(species, random);
  const auto barkFor = [&](std::size_t most) {
    for (std::size_t d = kBarkDetails.size(); d > 1; --d)
      if (Shape shape = barkOf(stems, species, kBarkDetails[d - 1]); shape.indices.size() / 3 <= most)
        return shape;
    return barkOf(stems, species, kBarkDetails[0]);
  };
  const auto cardsBeside = [&](const Shape& shape, std::size_t wanted) {
    const std::size_t used = shape.indices.size() / 3;
    return std::max<std::size_t>(4, wanted > used ? (wanted - used) / kCard : 0);
  };
  constexpr float kBarkShare = 0.4f;
  Shape stemShape = barkFor(std::size_t(kBarkShare * float(triangles)));
  const std::size_t all =
      cardsBeside(barkFor(std::size_t(kBarkShare * float(species.triangles))), species.triangles);
  Shape crown = leavesOf(stems, species, cardsBeside(stemShape, triangles), all, random);
  return {species.name, {{bark, std::move(stemShape)}, {leaf, std::move(crown)}}, {}};
}

Species oak() {
  Species s;
  s.name = "Oak", s.crown = Crown::broad, s.flare = 0.7f, s.triangles = 70'000;
  s.levels = {{1, 0, 0, 0, 0, 9.0f, 0.1f, 0.34f, 12, 18, 0.1f},
              {13, 0.22f, 72, 32, 10, 0.58f, 0.2f, 0.5f, 9, 40, 0.35f},
              {8, 0.25f, 58, 38, 14, 0.42f, 0.25f, 0.5f, 6, 45, 0.15f},
              {7, 0.2f, 52, 40, 14, 0.42f, 0.3f, 0.5f, 4, 40, 0.0f}};
  s.leaves = {0.36f, 0.30f, 55, 0.2f, 0.1f, 0.15f};
  return s;
}

Species lime() {
  Species s;
  s.name = "Lime", s.crown = Crown::round, s.flare = 0.4f, s.triangles = 48'000;
  s.levels = {{1, 0, 0, 0, 0, 9.5f, 0.08f, 0.22f, 12, 7, 0.1f},
              {17, 0.24f, 62, 28, 7, 0.36f, 0.15f, 0.42f, 8, 25, 0.45f},
              {7, 0.2f, 52, 36, 12, 0.4f, 0.25f, 0.5f, 5, 35, 0.1f},
              {5, 0.2f, 50, 40, 12, 0.45f, 0.3f, 0.5f, 3, 35, -0.1f}};
  s.leaves = {0.34f, 0.3f, 55, 0.3f, 0.1f, 0.25f};
  return s;
}

Species birch() {
  Species s;
  s.name = "Birch", s.crown = Crown::flame, s.flare = 0.35f, s.triangles = 30'000;
  s.levels = {{1, 0, 0, 0, 0, 10.0f, 0.1f, 0.15f, 12, 14, 0.15f},
              {16, 0.28f, 52, 30, 8, 0.3f, 0.2f, 0.36f, 7, 30, 0.3f},
              {6, 0.25f, 48, 36, 12, 0.5f, 0.25f, 0.45f, 5, 35, -0.7f},
              {4, 0.2f, 40, 30, 12, 0.6f, 0.3f, 0.5f, 4, 30, -1.4f}};
  s.leaves = {0.32f, 0.24f, 35, 0.5f, 0.05f, 0};
  return s;
}

Species spruce() {
  Species s;
  s.name = "Spruce", s.crown = Crown::cone, s.flare = 0.4f, s.triangles = 60'000;
  s.levels = {{1, 0, 0, 0, 0, 15.0f, 0.12f, 0.24f, 14, 2, 0.05f},
              {66, 0.07f, 104, 58, 6, 0.22f, 0.12f, 0.24f, 6, 10, 0.35f},
              {11, 0.12f, 55, 38, 6, 0.42f, 0.2f, 0.45f, 3, 14, -0.25f, true}};
  s.leaves = {0.55f, 0.26f, 28, 0.25f, 0.0f, 0.55f};
  return s;
}

Species pine() {
  Species s;
  s.name = "Pine", s.crown = Crown::broad, s.flare = 0.35f, s.triangles = 40'000;
  s.levels = {{1, 0, 0, 0, 0, 13.5f, 0.1f, 0.21f, 14, 9, 0.1f},
              {18, 0.55f, 88, 45, 10, 0.24f, 0.25f, 0.45f, 7, 40, 0.45f},
              {7, 0.3f, 55, 40, 14, 0.42f, 0.25f, 0.5f, 4, 40, 0.4f},
              {5, 0.3f, 50, 40, 14, 0.42f, 0.3f, 0.5f, 3, 30, 0.4f}};
  s.leaves = {0.34f, 0.24f, 35, 0.1f, 0.35f, 0.1f};
  return s;
}

Species apple() {
  Species s;
  s.name = "Apple tree", s.crown = Crown::round, s.flare = 0.4f, s.triangles = 24'000;
  s.levels = {{1, 0, 0, 0, 0, 3.4f, 0.1f, 0.12f, 8, 18, 0.1f},
              {9, 0.38f, 62, 35, 10, 0.6f, 0.2f, 0.5f, 7, 45, 0.35f},
              {7, 0.2f, 55, 40, 14, 0.45f, 0.25f, 0.5f, 5, 45, 0.15f},
              {5, 0.2f, 50, 40, 14, 0.5f, 0.3f, 0.5f, 3, 40, 0.1f}};
  s.leaves = {0.24f, 0.19f, 50, 0.2f, 0.1f, 0.2f};
  return s;
}

Species hazel() {
  Species s;
  s.name = "Hazel", s.crown = Crown::round, s.flare = 0.1f, s.triangles = 14'000;
  s.levels = {{9, 0, 24, 24, 14, 2.6f, 0.25f, 0.028f, 7, 26, 0.1f},
              {7, 0.18f, 48, 30, 12, 0.36f, 0.25f, 0.55f, 5, 35, 0.2f},
              {5, 0.15f, 48, 36, 14, 0.5f, 0.3f, 0.6f, 3, 40, 0}};
  s.leaves = {0.27f, 0.24f, 52, 0.25f, 0.05f, 0.25f};
  return s;
}

}  // namespace acentric::forest
