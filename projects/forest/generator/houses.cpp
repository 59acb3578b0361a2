#include "projects/forest/generator/houses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace acentric::forest {
namespace {

using gallery::addBox;
using gallery::addQuad;
using gallery::lathe;
using gallery::moved;
using gallery::Shape;
using gallery::turned;

constexpr float kPlinth = 0.45f, kFloor = 2.6f, kBeam = 0.17f, kOut = 0.035f;  // beams stand out of walls
constexpr float kOverhang = 0.55f, kRoof = 0.14f;                              // the roof's, its thickness

struct House {
  Shape plaster, timber, frame, pane, paint, tiles, stone, door;
};

/// A flat bar on a wall in the xz plane that faces -y, from a to b.
void addBeam(Shape& out, const glm::vec2& a, const glm::vec2& b, float width = kBeam) {
  const glm::vec2 along = b - a;
  const float length = glm::length(along), angle = std::atan2(along.y, along.x);
  Shape bar;
  addBox(bar, {0, -kOut, -0.5f * width}, {length, 0, 0.5f * width});
  // Boards run along it.
  for (glm::vec2& uv : bar.uv) uv = {uv.y, uv.x};
  out.append(bar, moved(a.x, 0, a.y) * glm::rotate(glm::mat4(1), -angle, glm::vec3(0, 1, 0)));
}

/// Around (x, z) on a wall that faces -y: frame, panes, sill, shutters.
void addWindow(House& out, const glm::mat4& wall, float x, float z, float width, float height,
               bool shutters) {
  House w;
  const float l = x - 0.5f * width, r = x + 0.5f * width, b = z - 0.5f * height, t = z + 0.5f * height;
  addQuad(w.pane, {l, -0.012f, b}, {r, -0.012f, b}, {r, -0.012f, t}, {l, -0.012f, t});
  const float f = 0.07f;
  for (const auto& [low, high] : {std::pair(glm::vec2(l - f, b - f), glm::vec2(l, t + f)),
                                  {{r, b - f}, {r + f, t + f}},
                                  {{l, t}, {r, t + f}},
                                  {{l, b - f}, {r, b}},
                                  {{x - 0.025f, b}, {x + 0.025f, t}},
                                  {{l, z + 0.14f * height}, {r, z + 0.14f * height + 0.04f}}})
    addBox(w.frame, {low.x, -0.055f, low.y}, {high.x, 0, high.y});
  addBox(w.frame, {l - 0.12f, -0.13f, b - f - 0.05f}, {r + 0.12f, 0, b - f});
  if (shutters)
    for (const float side : {l - f - 0.02f - 0.5f * width, r + f + 0.02f})
      addBox(w.paint, {side, -0.05f, b - f}, {side + 0.5f * width, -0.012f, t + f});
  out.pane.append(w.pane, wall), out.frame.append(w.frame, wall), out.paint.append(w.paint, wall);
}

void addDoor(House& out, const glm::mat4& wall, float x) {
  Shape leaf, frame, steps;
  addBox(leaf, {x - 0.5f, -0.04f, kPlinth}, {x + 0.5f, 0, kPlinth + 2.05f});
  for (const float side : {-0.6f, 0.5f})
    addBox(frame, {x + side, -0.07f, kPlinth}, {x + side + 0.1f, 0, kPlinth + 2.15f});
  addBox(frame, {x - 0.5f, -0.07f, kPlinth + 2.05f}, {x + 0.5f, 0, kPlinth + 2.15f});
  for (int step = 0; step < 3; ++step)
    addBox(steps, {x - 0.8f, -0.3f * float(3 - step), 0}, {x + 0.8f, 0, 0.15f * float(step + 1)});
  out.door.append(leaf, wall), out.timber.append(frame, wall), out.stone.append(steps, wall);
}

/// Posts, rails, braces and windows of one side: `width` metres of wall from z = kPlinth to `top`.
void addFacade(House& out, const glm::mat4& wall, float width, float top, int bays, bool door, int skip) {
  Shape beams;
  const float half = 0.5f * width, storey = kPlinth + kFloor;
  for (const float z : {kPlinth + 0.5f * kBeam, storey, top - 0.5f * kBeam})
    addBeam(beams, {-half, z}, {half, z});
  const float bay = width / float(bays);
  for (int i = 0; i <= bays; ++i) {
    const float x = std::clamp(-half + bay * float(i), -half + 0.5f * kBeam, half - 0.5f * kBeam);
    addBeam(beams, {x, kPlinth}, {x, top});
  }
  // Braces at the corners of the upper floor.
  addBeam(beams, {-half + 0.1f, storey + 0.1f}, {-half + 0.62f * bay, top - 0.2f}, 0.13f);
  addBeam(beams, {half - 0.1f, storey + 0.1f}, {half - 0.62f * bay, top - 0.2f}, 0.13f);
  out.timber.append(beams, wall);
  for (int i = 0; i < bays; ++i) {
    const float x = -half + bay * (float(i) + 0.5f);
    const bool entrance = door && i == bays / 2;
    if (entrance)
      addDoor(out, wall, x);
    else if (i != skip)
      addWindow(out, wall, x, kPlinth + 1.45f, 0.85f, 1.15f, bay > 2.2f);
    if (top - storey > 1.7f && i != 0 && i + 1 != bays)
      addWindow(out, wall, x, storey + 0.5f * (top - storey), 0.75f, 0.95f, false);
  }
}

/// Two slabs over a ridge along x; a: half the length, b: half the width, both with what hangs over.
void addRoof(House& out, const glm::mat4& placement, float half, float depth, float eaves, float pitch) {
  const float slope = glm::radians(pitch), run = 0.5f * depth + kOverhang;
  const float length = run / std::cos(slope);
  Shape slab;
  addBox(slab, {-half - kOverhang, 0, 0}, {half + kOverhang, length, kRoof});
  const float foot = eaves - kOverhang * std::tan(slope);
  for (const float side : {0.0f, 180.0f})
    out.tiles.append(slab, placement * turned(side) * moved(0, -run, foot) *
                               glm::rotate(glm::mat4(1), slope, glm::vec3(1, 0, 0)));
  const float ridge = foot + run * std::tan(slope) + kRoof / std::cos(slope);
  Shape cap, chimney;
  addBox(cap, {-half - kOverhang, -0.13f, ridge - 0.12f}, {half + kOverhang, 0.13f, ridge + 0.05f}, 0.05f);
  out.tiles.append(cap, placement);
  addBox(chimney, {0.45f * half, -0.35f, ridge - 1.5f}, {0.45f * half + 0.7f, 0.35f, ridge + 0.8f});
  addBox(chimney, {0.45f * half - 0.07f, -0.42f, ridge + 0.8f}, {0.45f * half + 0.77f, 0.42f, ridge + 0.95f});
  out.stone.append(chimney, placement);
}

}  // namespace

HouseDesign houseDesign(int design) {
  switch (design) {
    case 0:
      return {10.5f, 5.1f, 48, false};
    case 1:
      return {8.2f, 5.3f, 52, true};
    default:
      return {9.4f, 4.1f, 50, false};
  }
}

gallery::Thing makeHouse(int design, const Materials& materials) {
  const HouseDesign how = houseDesign(design);
  House house;
  const float half = 0.5f * how.width, deep = 0.5f * kHouseDepth;
  // Around the middle of the house, to the front at the end.
  addBox(house.stone, {-half - 0.04f, -deep - 0.04f, -0.6f}, {half + 0.04f, deep + 0.04f, kPlinth});
  for (int side = 0; side < 4; ++side) {
    const bool ends = side % 2 == 1;
    const float width = ends ? kHouseDepth : how.width, away = ends ? half : deep;
    const glm::mat4 wall = turned(90 * float(side)) * moved(0, -away, 0);
    Shape body;
    const float w = 0.5f * width;
    addQuad(body, {-w, 0, kPlinth}, {w, 0, kPlinth}, {w, 0, how.eaves}, {-w, 0, how.eaves});
    if (ends != how.gableFront) {
      const float rise = w * std::tan(glm::radians(how.pitch));
      const auto a = body.add({-w, 0, how.eaves}, {0, -1, 0}, {-w, -how.eaves}),
                 b = body.add({w, 0, how.eaves}, {0, -1, 0}, {w, -how.eaves}),
                 c = body.add({0, 0, how.eaves + rise}, {0, -1, 0}, {0, -how.eaves - rise});
      body.triangle(a, b, c);
      Shape beams;
      addBeam(beams, {0, how.eaves}, {0, how.eaves + rise - 0.3f});
      addBeam(beams, {-0.5f * w, how.eaves + 0.5f * rise}, {0.5f * w, how.eaves + 0.5f * rise});
      for (const float s : {-1.0f, 1.0f}) {
        addBeam(beams, {s * 0.5f * w, how.eaves}, {s * 0.5f * w, how.eaves + 0.5f * rise});
        addBeam(beams, {s * (w - 0.05f), how.eaves + 0.02f}, {0, how.eaves + rise - 0.1f});
      }
      house.timber.append(beams, wall);
      for (const float s : {-0.25f, 0.25f})
        addWindow(house, wall, s * w, how.eaves + 0.24f * rise, 0.6f, 0.75f, false);
    }
    house.plaster.append(body, wall);
    addFacade(house, wall, width, how.eaves,
              ends             ? 3
              : how.width > 10 ? 5
                               : 4 - (how.width < 9 ? 1 : 0),
              side == 0, side == 2 ? 1 : -1);
  }
  if (how.gableFront)
    addRoof(house, turned(90), deep, how.width, how.eaves, how.pitch);
  else
    addRoof(house, glm::mat4(1), half, kHouseDepth, how.eaves, how.pitch);
  gallery::Thing thing;
  thing.name = "House";
  for (auto& [material, shape] : {std::pair(materials.plasters[design], &house.plaster),
                                  {materials.timber, &house.timber},
                                  {materials.frame, &house.frame},
                                  {materials.pane, &house.pane},
                                  {materials.paint[design], &house.paint},
                                  {materials.tiles, &house.tiles},
                                  {materials.stone, &house.stone},
                                  {materials.door, &house.door}}) {
    Shape front;
    front.append(*shape, moved(0, deep, 0));
    if (!front.indices.empty()) thing.parts.push_back({material, std::move(front)});
  }
  return thing;
}

gallery::Thing makeFence(float length, const Materials& materials) {
  Shape wood;
  const float half = 0.5f * length;
  for (const float z : {0.3f, 0.75f}) addBox(wood, {-half, -0.02f, z}, {half, 0.02f, z + 0.08f});
  const int slats = int(length / 0.16f);
  for (int i = 0; i < slats; ++i) {
    const float x = -half + length * (float(i) + 0.5f) / float(slats);
    addBox(wood, {x - 0.04f, -0.045f, 0.06f}, {x + 0.04f, -0.02f, 0.98f + 0.03f * float(i % 2)});
  }
  addBox(wood, {-half - 0.05f, -0.05f, -0.1f}, {-half + 0.05f, 0.05f, 1.1f});
  return {"Fence", {{materials.door, std::move(wood)}}, {}};
}

gallery::Thing makeLamp(const Materials& materials) {
  const std::array<glm::vec2, 8> post{{{0.13f, -0.1f},
                                       {0.13f, 0.25f},
                                       {0.07f, 0.4f},
                                       {0.05f, 0.5f},
                                       {0.04f, 2.9f},
                                       {0.09f, 2.95f},
                                       {0.09f, 3.0f},
                                       {0, 3.0f}}};
  const std::array<glm::vec2, 5> roof{
      {{0.02f, 3.4f}, {0.2f, 3.4f}, {0.12f, 3.52f}, {0.03f, 3.6f}, {0, 3.64f}}};
  const std::array<glm::vec2, 3> glass{{{0.08f, 3.0f}, {0.15f, 3.4f}, {0.02f, 3.4f}}};
  Shape iron = lathe(post, 8);
  iron.append(lathe(roof, 6));
  return {"Lamp", {{materials.pane, std::move(iron)}, {materials.frame, lathe(glass, 6)}}, {}};
}

gallery::Thing makeWell(const Materials& materials) {
  const std::array<glm::vec2, 5> ring{
      {{0.85f, -0.1f}, {0.82f, 0.8f}, {0.62f, 0.8f}, {0.62f, 0.2f}, {0, 0.2f}}};
  Shape wood, tiles;
  for (const float side : {-0.85f, 0.75f}) addBox(wood, {side, -0.06f, 0}, {side + 0.1f, 0.06f, 2.1f});
  wood.append(gallery::tube(std::array{glm::vec3(-0.8f, 0, 1.5f), glm::vec3(0.8f, 0, 1.5f)}, 0.07f, 8));
  Shape slab;
  addBox(slab, {-1.15f, 0, 0}, {1.15f, 1.15f, 0.06f});
  for (const float side : {0.0f, 180.0f})
    tiles.append(slab, turned(side) * moved(0, -0.85f, 1.95f) *
                           glm::rotate(glm::mat4(1), glm::radians(42.0f), glm::vec3(1, 0, 0)));
  return {"Well",
          {{materials.stone, lathe(ring, 20)},
           {materials.timber, std::move(wood)},
           {materials.tiles, std::move(tiles)}},
          {}};
}

gallery::Thing makeBench(const Materials& materials) {
  Shape wood, stone;
  for (int i = 0; i < 3; ++i) {
    addBox(wood, {-0.85f, -0.2f + 0.14f * float(i), 0.42f}, {0.85f, -0.08f + 0.14f * float(i), 0.46f});
    if (i > 0)
      addBox(wood, {-0.85f, 0.22f, 0.45f + 0.14f * float(i)}, {0.85f, 0.26f, 0.56f + 0.14f * float(i)});
  }
  for (const float x : {-0.65f, 0.55f}) {
    addBox(stone, {x, -0.18f, -0.05f}, {x + 0.1f, 0.2f, 0.42f});
    addBox(wood, {x + 0.02f, 0.2f, 0.3f}, {x + 0.08f, 0.24f, 0.88f});
  }
  return {"Bench", {{materials.door, std::move(wood)}, {materials.stone, std::move(stone)}}, {}};
}

}  // namespace acentric::forest
