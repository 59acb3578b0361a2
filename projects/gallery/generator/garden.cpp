// Terrace, lawn, hedges, trees and hills.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "projects/gallery/generator/canvas.h"
#include "projects/gallery/generator/gallery.h"
#include "projects/gallery/generator/noise.h"
#include "projects/gallery/generator/wall.h"

namespace acentric::gallery {
namespace {

constexpr float kStairHalf = 1.3f;  // the way down to the lawn
constexpr float kTerraceStart = kHalfLength + kWall;

Shape baluster() {
  const std::array<glm::vec2, 12> profile{{{0.05f, 0.2f},
                                           {0.05f, 0.225f},
                                           {0.032f, 0.24f},
                                           {0.04f, 0.27f},
                                           {0.062f, 0.34f},
                                           {0.066f, 0.39f},
                                           {0.052f, 0.47f},
                                           {0.034f, 0.58f},
                                           {0.03f, 0.68f},
                                           {0.044f, 0.7f},
                                           {0.032f, 0.72f},
                                           {0.05f, 0.76f}}};
  return lathe(profile, 8);
}

/// Bottom course and rail from one corner to another, with balusters between.
void addBalustrade(Shape& stone, Thing& balusters, const glm::vec2& from, const glm::vec2& to) {
  const glm::vec2 low = glm::min(from, to), high = glm::max(from, to);
  const auto course = [&](float half, float z0, float z1, float bevel) {
    addBox(stone, {low.x - half, low.y - half, z0}, {high.x + half, high.y + half, z1}, bevel);
  };
  course(0.11f, 0, 0.2f, 0.01f);
  course(0.1f, 0.76f, 0.83f, 0);
  course(0.14f, 0.83f, 0.9f, 0.02f);
  const float length = glm::length(to - from);
  const int count = std::max(1, static_cast<int>(std::lround(length / 0.27f)));
  for (int i = 0; i < count; ++i) {
    const glm::vec2 p = glm::mix(from, to, (static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    balusters.placements.push_back(moved(p.x, p.y, 0));
  }
}

/// A block of clipped leaves: a rough box from z = 0 up.
Shape hedgeBlock(const glm::vec3& size) {
  Shape out;
  const auto rough = [](const glm::vec3& p) {
    return p + 0.05f * glm::vec3(noise(p * 5.0f, 1), noise(p * 5.0f, 2), noise(p * 5.0f, 3)) +
           0.035f * glm::vec3(noise(p * 8.0f, 4), noise(p * 8.0f, 5), noise(p * 8.0f, 6));
  };
  const glm::vec3 h(0.5f * size.x, 0.5f * size.y, size.z);
  struct Face {
    glm::vec3 corner, s, t;
  };
  const std::array<Face, 5> faces{{{{-h.x, -h.y, 0}, {size.x, 0, 0}, {0, 0, h.z}},
                                   {{h.x, h.y, 0}, {-size.x, 0, 0}, {0, 0, h.z}},
                                   {{h.x, -h.y, 0}, {0, size.y, 0}, {0, 0, h.z}},
                                   {{-h.x, h.y, 0}, {0, -size.y, 0}, {0, 0, h.z}},
                                   {{-h.x, -h.y, h.z}, {size.x, 0, 0}, {0, size.y, 0}}}};
  for (const Face& f : faces) {
    const int columns = std::max(4, static_cast<int>(glm::length(f.s) / 0.17f)),
              rows = std::max(4, static_cast<int>(glm::length(f.t) / 0.17f));
    addGrid(out, columns, rows, [&](float s, float t) { return rough(f.corner + s * f.s + t * f.t); });
  }
  return out;
}

void paintFoliage(Shape& shape, const glm::vec3& dark, const glm::vec3& light, std::uint32_t seed) {
  shape.paint([&](const glm::vec3& p, const glm::vec3& n) {
    const float spot = fractalNoise(p * 6.0f, 4, seed);
    return glm::mix(dark, light, std::clamp(0.4f + 0.75f * spot + 0.25f * n.z, 0.0f, 1.0f));
  });
}

Shape cypress() {
  Shape out;
  addGrid(out, 22, 28, [](float s, float t) {
    const float turn = 2 * glm::pi<float>() * (s - std::floor(s)), up = std::clamp(t, 0.0f, 1.0f);
    const float body =
        0.62f *
        std::pow(std::max(0.0f, std::sin(glm::pi<float>() * std::pow(0.02f + 0.98f * up, 0.62f))), 0.85f);
    const glm::vec3 ring(std::cos(turn), std::sin(turn), 5.6f * up);
    const float rough = 1 + 0.30f * fractalNoise({ring.x * 2.6f, ring.y * 2.6f, ring.z * 3.2f}, 3, 9);
    return glm::vec3(body * rough * glm::vec2(ring), 0.25f + 5.6f * t);
  });
  paintFoliage(out, colour(0x16301d), colour(0x47683a), 12);
  return out;
}

Thing roundTree(const Materials& materials) {
  Shape bark, crown;
  const std::array<glm::vec3, 5> trunk{
      {{0, 0, 0}, {0.05f, 0.02f, 0.7f}, {0.0f, -0.03f, 1.4f}, {0.12f, 0.05f, 2.1f}, {0.1f, 0, 2.8f}}};
  bark.append(tube(trunk, 0.12f, 10));
  Random random(3);
  for (int i = 0; i < 7; ++i) {
    const float azimuth = 2.4f * static_cast<float>(i), out = i == 0 ? 0.0f : random.between(0.5f, 1.05f);
    const float size = random.between(0.65f, 0.95f);
    const Shape puff = blob(14, 9, [&](const glm::vec3& d) {
      return size * (1 + 0.32f * fractalNoise(d * 2.6f + static_cast<float>(i) * 3.0f, 3, 17));
    });
    crown.append(
        puff, moved(out * std::cos(azimuth), out * std::sin(azimuth), 3.0f + random.between(-0.45f, 0.8f)));
  }
  paintFoliage(crown, colour(0x3b5526), colour(0x9bb068), 15);
  return {"Tree", {{materials.bark, std::move(bark)}, {materials.hedge, std::move(crown)}}, {}};
}

/// A ridge around the east, `height(azimuth)` metres high.
void addRidge(Shape& out, float distance, float low, float high, std::uint32_t seed, const glm::vec3& foot,
              const glm::vec3& crest) {
  Shape ridge;
  addGrid(ridge, 110, 5, [&](float s, float t) {
    const float azimuth = glm::pi<float>() * (0.5f - s) * 1.1f;  // from north to south: faces the middle
    const float tall = low + (high - low) * (0.5f + 0.5f * fractalNoise({6 * s, 0, 0}, 5, seed));
    return glm::vec3(kHalfLength + (distance + 3.5f * t) * std::cos(azimuth),
                     (distance + 3.5f * t) * std::sin(azimuth), kLawn - 0.2f + tall * t);
  });
  ridge.paint([&](const glm::vec3& p, const glm::vec3&) {
    const float spot = 0.5f + 0.5f * fractalNoise({p.x * 0.35f, p.y * 0.35f, p.z * 0.8f}, 4, seed + 1U);
    return glm::mix(foot, crest, std::clamp(0.25f * p.z + 0.5f * spot - 0.3f, 0.0f, 1.0f));
  });
  out.append(ridge);
}

}  // namespace

void addTerrace(Model& model, const Materials& materials) {
  Shape paving, stone;
  addQuad(paving, {kTerraceStart, -kTerraceHalf, 0}, {kTerraceEnd, -kTerraceHalf, 0},
          {kTerraceEnd, kTerraceHalf, 0}, {kTerraceStart, kTerraceHalf, 0});
  // Its edge, and three steps down.
  addBox(stone, {kTerraceStart, -kTerraceHalf - 0.15f, kLawn - 0.2f},
         {kTerraceEnd + 0.15f, kTerraceHalf + 0.15f, -0.005f});
  for (int step = 0; step < 3; ++step) {
    const float top = -0.125f * static_cast<float>(step + 1);
    const float x = kTerraceEnd + 0.15f + 0.32f * static_cast<float>(step);
    addBox(stone, {x, -kStairHalf, kLawn - 0.2f}, {x + 0.32f, kStairHalf, top}, 0.01f);
  }
  Thing balusters{"Baluster", {{materials.stucco, baluster()}}, {}};
  constexpr float kPier = 0.2f;
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * kTerraceHalf;
    addBalustrade(stone, balusters, {kTerraceStart + 0.3f, y}, {kTerraceEnd - kPier, y});
    addBalustrade(stone, balusters, {kTerraceEnd, side * (kStairHalf + 2 * kPier)},
                  {kTerraceEnd, y - side * kPier});
    for (const float pierY : {side * (kStairHalf + kPier), y}) {
      addBox(stone, {kTerraceEnd - kPier, pierY - kPier, 0}, {kTerraceEnd + kPier, pierY + kPier, 0.95f},
             0.01f);
      addBox(stone, {kTerraceEnd - kPier - 0.05f, pierY - kPier - 0.05f, 0.95f},
             {kTerraceEnd + kPier + 0.05f, pierY + kPier + 0.05f, 1.03f}, 0.02f);
    }
  }
  // Urns with clipped balls on the piers.
  const std::array<glm::vec2, 12> urn{{{0.11f, 1.03f},
                                       {0.12f, 1.05f},
                                       {0.06f, 1.08f},
                                       {0.05f, 1.12f},
                                       {0.1f, 1.16f},
                                       {0.17f, 1.24f},
                                       {0.2f, 1.34f},
                                       {0.2f, 1.42f},
                                       {0.23f, 1.44f},
                                       {0.23f, 1.47f},
                                       {0.2f, 1.47f},
                                       {0, 1.44f}}};
  Shape ball =
      blob(18, 12, [](const glm::vec3& d) { return 0.24f * (1 + 0.16f * fractalNoise(d * 6.0f, 3, 33)); });
  paintFoliage(ball, colour(0x1f3d22), colour(0x6c8f46), 34);
  Shape green;
  green.append(ball, moved(0, 0, 1.6f));
  Thing urns{"Urn", {{materials.stucco, lathe(urn, 20)}, {materials.hedge, std::move(green)}}, {}};
  for (const float y : {-kTerraceHalf, -kStairHalf - kPier, kStairHalf + kPier, kTerraceHalf})
    urns.placements.push_back(moved(kTerraceEnd, y, 0));
  model.add("Terrace paving", materials.paving, std::move(paving));
  model.add("Terrace stone", materials.stucco, std::move(stone));
  model.things.push_back(std::move(balusters));
  model.things.push_back(std::move(urns));
}

void addGarden(Model& model, const Materials& materials) {
  Shape lawn, path;
  addGrid(lawn, 10, 48, [](float s, float t) {
    const float azimuth = glm::pi<float>() * (t - 0.5f) * 1.1f, distance = 4 + 42 * s;
    return glm::vec3(kHalfLength + distance * std::cos(azimuth), distance * std::sin(azimuth), kLawn);
  });
  for (std::size_t i = 0; i < lawn.uv.size(); ++i)
    lawn.uv[i] = glm::vec2(lawn.positions[i].x, -lawn.positions[i].y);
  addQuad(path, {kTerraceEnd, -kStairHalf, kLawn + 0.01f}, {30.5f, -kStairHalf, kLawn + 0.01f},
          {30.5f, kStairHalf, kLawn + 0.01f}, {kTerraceEnd, kStairHalf, kLawn + 0.01f});
  Shape block = hedgeBlock({4.6f, 0.8f, 0.85f});
  paintFoliage(block, colour(0x1d3a1f), colour(0x6a8a41), 22);
  Thing hedges{"Hedge", {{materials.hedge, std::move(block)}}, {}};
  Thing cypresses{"Cypress", {{materials.hedge, cypress()}}, {}};
  Thing trees = roundTree(materials);
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < 3; ++i) {
      const float x = 18.2f + 5.6f * static_cast<float>(i);
      hedges.placements.push_back(moved(x, side * 2.2f, kLawn));
      cypresses.placements.push_back(moved(x - 2.8f, side * 2.7f, kLawn) *
                                     turned(70.0f * static_cast<float>(i) + 40 * side));
    }
    hedges.placements.push_back(moved(16.2f, side * 5.2f, kLawn) * turned(90));
    trees.placements.push_back(moved(19.5f, side * 7.4f, kLawn) * turned(60 * side));
    trees.placements.push_back(moved(28.5f, side * 5.4f + 0.5f, kLawn) * turned(130 * side));
    trees.placements.push_back(moved(38.0f, side * 4.2f - 0.4f, kLawn) * turned(200 * side));
    trees.placements.push_back(moved(15.5f, side * 12.0f, kLawn) * turned(20 * side));
  }
  Shape hills;
  addRidge(hills, 40, 0.8f, 2.4f, 51, colour(0x5f7d4a), colour(0x86a06b));
  addRidge(hills, 43, 2.0f, 7.0f, 61, colour(0x7d9a86), colour(0xa6bdb6));
  model.add("Lawn", materials.grass, std::move(lawn));
  model.add("Path", materials.paving, std::move(path));
  model.things.push_back(std::move(hedges));
  model.things.push_back(std::move(cypresses));
  model.things.push_back(std::move(trees));
  model.add("Hills", materials.distance, std::move(hills));
}

}  // namespace acentric::gallery
