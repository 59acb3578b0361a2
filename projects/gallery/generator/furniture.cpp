// What stands and hangs in the hall.

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "projects/gallery/generator/canvas.h"
#include "projects/gallery/generator/gallery.h"
#include "projects/gallery/generator/noise.h"

namespace acentric::gallery {
namespace {

constexpr glm::vec3 kLampGlobe{-4.667f, 0, 3.0f};

/// A knot of two by three turns, standing.
Shape sculpture() {
  std::vector<glm::vec3> line;
  constexpr int kSteps = 168;
  for (int i = 0; i < kSteps; ++i) {
    const float t = 2 * glm::pi<float>() * static_cast<float>(i) / kSteps;
    const float ring = 0.088f * (2 + std::cos(3 * t));
    line.emplace_back(ring * std::cos(2 * t), 0.088f * std::sin(3 * t), ring * std::sin(2 * t));
  }
  Shape out = tube(line, 0.05f, 16, true);
  out.paint([](const glm::vec3& p, const glm::vec3&) {
    const float t = 0.5f + 1.7f * p.z + 0.12f * fractalNoise(p * 14.0f, 3, 5);
    return gradient({colour(0x123b4a), colour(0x1f7a8c), colour(0x58b3a3), colour(0xe9d8a6), colour(0xee9b00),
                     colour(0xbb3e03)},
                    t);
  });
  return out;
}

void addCase(Model& model, const Materials& materials) {
  Shape stone;
  addBox(stone, {-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0.08f}, 0.01f);
  const std::array<glm::vec2, 6> foot{
      {{0.06f, 0.2f}, {0.06f, 0.19f}, {0.045f, 0.15f}, {0.02f, 0.13f}, {0.015f, 0.1f}, {0, 0.08f}}};
  stone.append(moulding({0.49f, 0.49f}, foot));
  addBox(stone, {-0.43f, -0.43f, 0.08f}, {0.43f, 0.43f, 0.9f}, 0.006f);
  const std::array<glm::vec2, 5> panel{
      {{0.04f, 0}, {0.03f, 0.012f}, {0.018f, 0.012f}, {0.008f, 0.018f}, {0, 0}}};
  for (int side = 0; side < 4; ++side)
    stone.append(moulding({0.33f, 0.26f}, panel),
                 turned(90.0f * static_cast<float>(side)) * onWall({0, -0.43f, 0.54f}, {0, -1, 0}));
  addBox(stone, {-0.49f, -0.49f, 0.9f}, {0.49f, 0.49f, 0.98f}, 0.02f);

  // Five panes, a little inside their brass edges, which so take no shared plane.
  Shape glass, edges;
  const float half = 0.4f, low = 0.985f, high = 1.82f;
  for (int side = 0; side < 4; ++side) {
    Shape pane;
    addQuad(pane, {-half, -half, low}, {half, -half, low}, {half, -half, high}, {-half, -half, high});
    glass.append(pane, turned(90.0f * static_cast<float>(side)));
  }
  addQuad(glass, {-half, -half, high}, {half, -half, high}, {half, half, high}, {-half, half, high});
  const float rod = 0.011f;
  for (const float x : {-half, half})
    for (const float y : {-half, half})
      addBox(edges, {x - rod, y - rod, 0.98f}, {x + rod, y + rod, high + rod}, 0.003f);
  for (const float z : {low + rod, high})
    for (const float at : {-half, half}) {
      addBox(edges, {-half, at - rod, z - rod}, {half, at + rod, z + rod}, 0.003f);
      addBox(edges, {at - rod, -half, z - rod}, {at + rod, half, z + rod}, 0.003f);
    }
  const std::array<glm::vec2, 6> stand{
      {{0.2f, 0.98f}, {0.2f, 1.0f}, {0.19f, 1.01f}, {0.06f, 1.015f}, {0.045f, 1.05f}, {0, 1.1f}}};
  model.things.push_back({"Display case",
                          {{materials.plinthStone, std::move(stone)}, {materials.brass, std::move(edges)}},
                          {glm::mat4(1)}});
  model.add("Case glass", materials.glass, std::move(glass));
  Shape knot;
  knot.append(sculpture(), moved(0, 0, 1.4f) * turned(25));
  model.things.push_back({"Sculpture",
                          {{materials.sculpture, std::move(knot)}, {materials.bronzeTrim, lathe(stand, 32)}},
                          {glm::mat4(1)}});
}

void addRopes(Model& model, const Materials& materials) {
  const std::array<glm::vec2, 16> post{{{0.17f, 0},
                                        {0.17f, 0.012f},
                                        {0.15f, 0.022f},
                                        {0.05f, 0.035f},
                                        {0.025f, 0.06f},
                                        {0.021f, 0.1f},
                                        {0.021f, 0.86f},
                                        {0.034f, 0.87f},
                                        {0.034f, 0.89f},
                                        {0.02f, 0.9f},
                                        {0.02f, 0.915f},
                                        {0.035f, 0.935f},
                                        {0.042f, 0.96f},
                                        {0.035f, 0.985f},
                                        {0.02f, 1.0f},
                                        {0, 1.005f}}};
  constexpr float kHalf = 1.2f;
  Thing posts{"Rope post", {{materials.brass, lathe(post, 24)}}, {}};
  for (const float x : {-kHalf, kHalf})
    for (const float y : {-kHalf, kHalf}) posts.placements.push_back(moved(x, y, 0));
  std::vector<glm::vec3> line;
  for (int i = 0; i <= 28; ++i) {
    const float t = static_cast<float>(i) / 14 - 1;
    line.emplace_back(t * (kHalf - 0.03f), -kHalf, 0.68f + 0.2f * t * t);
  }
  Shape rope = tube(line, 0.019f, 10);
  Thing ropes{"Rope", {{materials.velvet, std::move(rope)}}, {}};
  for (int side = 0; side < 4; ++side) ropes.placements.push_back(turned(90.0f * static_cast<float>(side)));
  model.things.push_back(std::move(posts));
  model.things.push_back(std::move(ropes));
}

void addBenches(Model& model, const Materials& materials) {
  Shape wood, leather;
  const float length = 0.8f, width = 0.23f;
  for (const float x : {-length + 0.06f, length - 0.06f})
    for (const float y : {-width + 0.04f, width - 0.04f}) {
      // Tapered legs.
      const std::array<glm::vec2, 3> leg{{{0.024f, 0}, {0.036f, 0.3f}, {0.036f, 0.34f}}};
      wood.append(lathe(leg, 12), moved(x, y, 0));
    }
  addBox(wood, {-length, -width, 0.32f}, {length, width, 0.38f}, 0.008f);
  for (int i = 0; i < 4; ++i) {
    const float x0 = -length + 0.01f + static_cast<float>(i) * 0.395f;
    addBox(leather, {x0, -width + 0.005f, 0.38f}, {x0 + 0.39f, width - 0.005f, 0.465f}, 0.03f);
  }
  model.things.push_back(
      {"Bench",
       {{materials.walnut, std::move(wood)}, {materials.leather, std::move(leather)}},
       {moved(3.75f, 1.35f, 0), moved(3.75f, -1.35f, 0), moved(-3.4f, 1.35f, 0), moved(-3.4f, -1.35f, 0)}});
}

void addLamp(Model& model, const Materials& materials) {
  const glm::vec3 at = kLampGlobe;
  const Shape globe = blob(28, 16, [](const glm::vec3&) { return 0.13f; });
  Shape bulb;
  bulb.append(globe, moved(at.x, at.y, at.z));
  const std::array<glm::vec2, 9> dome{{{0.36f, 0.02f},
                                       {0.35f, 0.05f},
                                       {0.32f, 0.12f},
                                       {0.26f, 0.19f},
                                       {0.18f, 0.245f},
                                       {0.09f, 0.275f},
                                       {0.05f, 0.29f},
                                       {0.045f, 0.35f},
                                       {0, 0.37f}}};
  Shape shade;
  shade.append(lathe(dome, 40), moved(at.x, at.y, at.z));
  const std::array<glm::vec3, 2> cord{glm::vec3(at.x, at.y, at.z + 0.36f), glm::vec3(at.x, at.y, 4.78f)};
  shade.append(tube(cord, 0.008f, 8));
  const std::array<glm::vec2, 5> rose{
      {{0, 4.7f}, {0.05f, 4.71f}, {0.1f, 4.75f}, {0.11f, 4.78f}, {0.11f, 4.8f}}};
  shade.append(lathe(rose, 24), moved(at.x, at.y, 0));
  model.add("Lamp globe", materials.lampGlobe, std::move(bulb));
  model.add("Lamp shade", materials.lampShade, std::move(shade));
}

/// A leaf that leaves the pot at an angle and bows under its weight; the texture's stem is at its foot.
Shape leaf(float length, float width, float rise, float bow) {
  Shape out;
  addGrid(out, 2, 6, [&](float s, float t) {
    const float angle = rise - bow * t;
    // Arc length along a circle of that bow, and a slight trough across.
    const float reach = length * (std::sin(rise) - std::sin(rise - bow * t)) / bow;
    const float height = length * (std::cos(angle) - std::cos(rise)) / bow;
    const float across = 2 * s - 1;
    const float trough = 0.12f * width * across * across;
    return glm::vec3(reach - trough * std::sin(angle), 0.5f * width * across,
                     height + trough * std::cos(angle));
  });
  for (glm::vec2& uv : out.uv) uv.y = 1 - uv.y;
  return out;
}

void addPlants(Model& model, const Materials& materials) {
  const std::array<glm::vec2, 12> pot{{{0.15f, 0},
                                       {0.17f, 0.01f},
                                       {0.2f, 0.12f},
                                       {0.235f, 0.28f},
                                       {0.245f, 0.38f},
                                       {0.24f, 0.42f},
                                       {0.255f, 0.43f},
                                       {0.26f, 0.455f},
                                       {0.255f, 0.475f},
                                       {0.235f, 0.475f},
                                       {0.23f, 0.45f},
                                       {0.22f, 0.41f}}};
  const std::array<glm::vec2, 2> soil{{{0.225f, 0.43f}, {0, 0.44f}}};
  Shape leaves;
  Random random(7);
  constexpr int kLeaves = 34;
  for (int i = 0; i < kLeaves; ++i) {
    const float inner = static_cast<float>(i) / kLeaves;
    const float length = random.between(0.75f, 1.05f) * (1.15f - 0.25f * (1 - inner));
    const float rise = glm::radians(glm::mix(38.0f, 84.0f, inner)) + random.between(-0.1f, 0.1f);
    const Shape one = leaf(length, 0.24f * random.between(0.85f, 1.15f), rise, random.between(0.9f, 1.4f));
    leaves.append(one, turned(137.5f * static_cast<float>(i)) * moved(0.06f, 0, 0.43f));
  }
  model.things.push_back({"Plant",
                          {{materials.pot, lathe(pot, 32)},
                           {materials.soil, lathe(soil, 24)},
                           {materials.leaf, std::move(leaves)}},
                          {moved(6.3f, 3.15f, 0), moved(6.3f, -3.15f, 0) * turned(70),
                           moved(-6.35f, 2.05f, 0) * turned(140), moved(-6.35f, -2.05f, 0) * turned(210)}});
}

/// Vases on pedestals in the four corners.
void addVases(Model& model, const Materials& materials) {
  Shape stone;
  addBox(stone, {-0.24f, -0.24f, 0}, {0.24f, 0.24f, 0.1f}, 0.01f);
  addBox(stone, {-0.19f, -0.19f, 0.1f}, {0.19f, 0.19f, 0.92f}, 0.006f);
  addBox(stone, {-0.23f, -0.23f, 0.92f}, {0.23f, 0.23f, 1.0f}, 0.02f);
  const std::array<glm::vec2, 19> profile{{{0.09f, 1.0f},
                                           {0.095f, 1.015f},
                                           {0.07f, 1.03f},
                                           {0.055f, 1.06f},
                                           {0.075f, 1.1f},
                                           {0.115f, 1.16f},
                                           {0.145f, 1.23f},
                                           {0.158f, 1.3f},
                                           {0.15f, 1.37f},
                                           {0.12f, 1.43f},
                                           {0.08f, 1.47f},
                                           {0.06f, 1.5f},
                                           {0.055f, 1.54f},
                                           {0.065f, 1.575f},
                                           {0.09f, 1.6f},
                                           {0.088f, 1.607f},
                                           {0.06f, 1.58f},
                                           {0.045f, 1.54f},
                                           {0, 1.5f}}};
  Shape vase = lathe(profile, 22);
  vase.paint([](const glm::vec3& p, const glm::vec3&) {
    const float azimuth = std::atan2(p.y, p.x);
    const float wave = 0.022f * std::sin(9 * azimuth);
    const bool band = std::abs(p.z - 1.3f + wave) < 0.028f || std::abs(p.z - 1.5f) < 0.012f ||
                      std::abs(p.z - 1.11f) < 0.02f;
    return band ? colour(0x24506b) : colour(0xede4d0);
  });
  model.things.push_back(
      {"Vase",
       {{materials.plinthStone, std::move(stone)}, {materials.sculpture, std::move(vase)}},
       {moved(6.2f, 4.45f, 0), moved(6.2f, -4.45f, 0), moved(-6.2f, 4.45f, 0), moved(-6.2f, -4.45f, 0)}});
}

}  // namespace

void addFurniture(Model& model, const Materials& materials) {
  addCase(model, materials);
  addRopes(model, materials);
  addBenches(model, materials);
  addLamp(model, materials);
  addPlants(model, materials);
  addVases(model, materials);
}

void addLights(Model& model) {
  Light sun;
  sun.name = "Sun";
  sun.directional = true;
  sun.colour = {1.0f, 0.93f, 0.80f};
  sun.intensity = 7;
  sun.direction = glm::normalize(glm::vec3(-0.50f, 0.58f, -0.64f));
  model.lights.push_back(sun);
  Light lamp;
  lamp.name = "Lamp";
  lamp.colour = {1.0f, 0.80f, 0.55f};
  lamp.intensity = 14;
  // Below its globe, which would else keep its light in.
  lamp.position = kLampGlobe - glm::vec3(0, 0, 0.19f);
  model.lights.push_back(lamp);
}

}  // namespace acentric::gallery
