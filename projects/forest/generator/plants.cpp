#include "projects/forest/generator/plants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "projects/gallery/generator/noise.h"

namespace acentric::forest {
namespace {

using gallery::Random;
using gallery::Shape;

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// A strip of `rows` quads from the foot along an arc, its picture from (u0, 1) at the foot to (u1, 0).
void addStrip(Shape& out, const glm::vec3& foot, const glm::vec2& way, float length, float width, float rise,
              float bend, int rows, bool pointed, float u0, float u1) {
  const glm::vec3 across(-way.y, way.x, 0);
  glm::vec3 at = foot;
  std::uint32_t before[2] = {0, 0};
  for (int row = 0; row <= rows; ++row) {
    const float t = float(row) / float(rows);
    const float angle = rise - bend * t;
    const glm::vec3 along(std::cos(angle) * way.x, std::cos(angle) * way.y, std::sin(angle));
    const glm::vec3 normal = glm::normalize(glm::cross(along, -across) + glm::vec3(0, 0, 0.8f));
    const float half = 0.5f * width * (pointed ? 1 - 0.9f * t : 1.0f);
    if (pointed && row == rows) {
      out.triangle(before[0], before[1], out.add(at, normal, {0.5f * (u0 + u1), 0}));
      return;
    }
    const std::uint32_t a = out.add(at + half * across, normal, {u0, 1 - t}),
                        b = out.add(at - half * across, normal, {u1, 1 - t});
    if (row > 0) {
      out.triangle(before[0], before[1], b);
      out.triangle(before[0], b, a);
    }
    before[0] = a, before[1] = b;
    at += length / float(rows) * along;
  }
}

}  // namespace

gallery::Thing makeFern(std::size_t triangles, std::uint64_t seed, int leaf) {
  Random random(seed);
  Shape out;
  const int rows = triangles > 200 ? 8 : 3;
  const int fronds = std::max(2, int(triangles) / (2 * rows));
  // A few crowns of fronds beside each other.
  const int crowns = std::max(1, fronds / 11);
  for (int f = 0; f < fronds; ++f) {
    const int crown = f % crowns;
    const float spread = crowns > 1 ? 0.75f * std::sqrt(float(crown) / float(crowns)) : 0;
    const float where = 2.39996f * float(crown);
    const float around = kTurn * random.unit();
    addStrip(out, {spread * std::cos(where), spread * std::sin(where), 0},
             {std::cos(around), std::sin(around)}, random.between(0.55f, 0.95f), random.between(0.2f, 0.3f),
             random.between(0.9f, 1.35f), random.between(1.1f, 1.9f), rows, false, 0, 1);
  }
  return {"Fern", {{leaf, std::move(out)}}, {}};
}

gallery::Thing makeGrass(const char* name, std::size_t triangles, float height, std::uint64_t seed,
                         int blades) {
  Random random(seed);
  Shape out;
  const int rows = triangles > 300 ? 3 : 2;
  const int count = std::max(4, int(triangles) / (2 * rows - 1));
  // As much is covered, whatever their number.
  const float width = 0.011f * std::sqrt(std::max(1.0f, float(kGrassTriangles) / float(5 * count)));
  for (int b = 0; b < count; ++b) {
    const float from = 0.7f * std::sqrt(random.unit()), where = kTurn * random.unit();
    const float around = kTurn * random.unit(), u = random.between(0.02f, 0.96f);
    // Lower towards the rim, so that patches run into each other.
    const float tall = height * random.between(0.45f, 1.1f) * (1 - 0.5f * from);
    addStrip(out, {from * std::cos(where), from * std::sin(where), -0.02f},
             {std::cos(around), std::sin(around)}, tall, std::min(0.08f, width * random.between(0.7f, 1.3f)),
             random.between(1.1f, 1.5f), random.between(0.2f, 1.2f), rows, true, u, u + 0.015f);
  }
  return {name, {{blades, std::move(out)}}, {}};
}

}  // namespace acentric::forest
