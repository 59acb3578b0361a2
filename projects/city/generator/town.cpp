#include "projects/city/generator/town.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "projects/city/generator/city.h"

namespace acentric::city {
namespace {

using gallery::Shape;

constexpr int kTownBlocks = 20;  // each way
constexpr float kTownPitch = 100, kTownStreet = 12, kReach = 0.5f * kTownPitch * kTownBlocks;
constexpr int kSlots = 7;       // for houses, along a side of a block
constexpr float kSlot = 12;     // metres
constexpr float kCentre = 300;  // half the width of where houses are close together

/// 0..1, the same on every machine.
float chance(int a, int b, int c, int d) {
  std::uint32_t bits = 2166136261u;
  for (const int value : {a, b, c, d}) bits = (bits ^ std::uint32_t(value + 1000)) * 16777619u;
  bits ^= bits >> 15;
  bits *= 2246822519u;
  bits ^= bits >> 13;
  return float(bits >> 8) / float(1 << 24);
}

/// From the street at y = 0 backwards, its ridge along x.
void addHouse(Shape& walls, Shape& roof, const glm::mat4& placement, float width, float depth, float eaves) {
  const float x = 0.5f * width, ridge = eaves + 0.35f * depth;
  Shape body, top;
  const glm::vec3 a(-x, 0, 0), b(x, 0, 0), c(x, depth, 0), d(-x, depth, 0), up(0, 0, eaves);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
    gallery::addQuad(body, from, to, to + up, from + up);
  const glm::vec3 left(-x, 0.5f * depth, ridge), right(x, 0.5f * depth, ridge);
  for (const auto& [from, to, tip, normal] : {std::tuple(b + up, c + up, right, glm::vec3(1, 0, 0)),
                                              std::tuple(d + up, a + up, left, glm::vec3(-1, 0, 0))})
    body.triangle(body.add(from, normal, {0, 0}), body.add(to, normal, {depth, 0}),
                  body.add(tip, normal, {0.5f * depth, ridge - eaves}));
  gallery::addQuad(top, a + up, b + up, right, left);
  gallery::addQuad(top, c + up, d + up, left, right);
  walls.append(body, placement);
  roof.append(top, placement);
}

}  // namespace

gallery::Model makeTown() {
  gallery::Model model;
  const auto material = [&](const char* name, const glm::vec3& colour) {
    return model.add(matt(name, colour));
  };
  const int grass = material("grass", {0.14f, 0.22f, 0.08f}),
            asphalt = material("asphalt", {0.16f, 0.16f, 0.17f}),
            tiles = material("tiles", {0.35f, 0.12f, 0.08f});
  const int paints[] = {material("brick", {0.42f, 0.17f, 0.12f}), material("plaster", {0.62f, 0.55f, 0.42f}),
                        material("stone", {0.45f, 0.45f, 0.46f}), material("render", {0.35f, 0.44f, 0.48f})};
  const auto level = [](float x0, float y0, float x1, float y1, float z) {
    Shape shape;
    gallery::addQuad(shape, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    return shape;
  };
  model.add("ground", grass, level(-kReach, -kReach, kReach, kReach, 0));
  Shape streets;
  for (int s = 0; s <= kTownBlocks; ++s) {
    const float at = kTownPitch * (float(s) - 0.5f * kTownBlocks);
    const float low = std::max(at - 0.5f * kTownStreet, -kReach),
                high = std::min(at + 0.5f * kTownStreet, kReach);
    streets.append(level(low, -kReach, high, kReach, 0.03f));
    streets.append(level(-kReach, low, kReach, high, 0.02f));
  }
  model.add("streets", asphalt, std::move(streets));

  Shape walls[4], roofs;
  const float side = kTownPitch - kTownStreet;
  for (int bx = 0; bx < kTownBlocks; ++bx)
    for (int by = 0; by < kTownBlocks; ++by) {
      const glm::vec2 middle(kTownPitch * (float(bx) + 0.5f - 0.5f * kTownBlocks),
                             kTownPitch * (float(by) + 0.5f - 0.5f * kTownBlocks));
      const float out = std::max(std::abs(middle.x), std::abs(middle.y));
      const bool centre = out < kCentre, market = middle.x == 50 && middle.y == 50;
      if (market || (!centre && chance(bx, by, -1, -1) < 0.25f)) continue;  // the others are fields
      for (int s = 0; s < 4; ++s)
        for (int k = 0; k < kSlots; ++k) {
          // At corners, houses of two sides have the same ground.
          if (s % 2 == 1 && (k == 0 || k + 1 == kSlots)) continue;
          if (chance(bx, by, s, k) > (centre ? 0.6f : 0.24f)) continue;
          const float width = 8.5f + 2 * chance(bx, by, s, k + 10), depth = 8 + 3 * chance(bx, by, s, k + 20);
          const float eaves = (centre ? 6.0f : 3.0f) + 3 * chance(bx, by, s, k + 30);
          const glm::mat4 placement = gallery::moved(middle.x, middle.y, 0) * gallery::turned(90 * float(s)) *
                                      gallery::moved(kSlot * (float(k) - 0.5f * (kSlots - 1)),
                                                     (centre ? 0.0f : 4.0f) - 0.5f * side, 0);
          addHouse(walls[(bx + 2 * by + 3 * s + k) % 4], roofs, placement, width, depth, eaves);
        }
    }
  for (int i = 0; i < 4; ++i) model.add("walls", paints[i], std::move(walls[i]));
  model.add("roofs", tiles, std::move(roofs));
  model.lights.push_back(sunlight());
  return model;
}

}  // namespace acentric::city
