// Floor, walls, windows and door.

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "projects/gallery/generator/gallery.h"
#include "projects/gallery/generator/wall.h"

namespace acentric::gallery {
namespace {

constexpr float kBorder = 0.3f;  // dark band along the walls

const Opening kDoor{0, kDoorHalf, 0, kDoorSpring, true};

/// Half-round windows high above the pictures, one a bay.
std::vector<Opening> lunettes() {
  std::vector<Opening> out;
  for (const float u : {-1.5f, -0.5f, 0.5f, 1.5f}) out.push_back({u * kBay, 0.75f, 3.28f, 3.38f, true});
  return out;
}

struct Wall {
  WallSide inside, outside;
  float half;  // of the inner face's length
  std::vector<Opening> openings;
};

std::array<Wall, 4> walls() {
  const auto make = [](const glm::vec3& normal, float distance, float half, std::vector<Opening> openings) {
    return Wall{
        {-normal * distance, normal}, {-normal * (distance + kWall), -normal}, half, std::move(openings)};
  };
  return {make({0, -1, 0}, kHalfWidth, kHalfLength, lunettes()),
          make({0, 1, 0}, kHalfWidth, kHalfLength, lunettes()),
          make({-1, 0, 0}, kHalfLength, kHalfWidth, {kDoor}), make({1, 0, 0}, kHalfLength, kHalfWidth, {})};
}

void addFloor(Model& model, const Materials& materials) {
  Shape tiles, dark;
  const float inner = kHalfLength - kBorder, nave = kColumnRow - kBeamHalf, aisle = kColumnRow + kBeamHalf;
  const auto level = [](Shape& out, float x0, float y0, float x1, float y1) {
    addQuad(out, {x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0});
  };
  level(tiles, -inner, -nave, inner, nave);
  for (const float side : {-1.0f, 1.0f}) {
    const float outer = kHalfWidth - kBorder;
    level(tiles, -inner, std::min(side * aisle, side * outer), inner, std::max(side * aisle, side * outer));
    level(dark, -inner, std::min(side * nave, side * aisle), inner, std::max(side * nave, side * aisle));
  }
  const std::array<glm::vec2, 2> border{{{kBorder, 0}, {0, 0}}};
  dark.append(moulding({kHalfLength, kHalfWidth}, border));
  // The threshold, through the wall.
  level(dark, kHalfLength, -kDoorHalf, kHalfLength + kWall, kDoorHalf);
  model.add("Floor", materials.floorTiles, std::move(tiles));
  model.add("Floor bands", materials.darkMarble, std::move(dark));
}

/// Framed panels along the dado.
void addDadoPanels(Shape& out, const Wall& wall) {
  const std::array<glm::vec2, 5> profile{
      {{0.045f, 0}, {0.035f, 0.014f}, {0.02f, 0.016f}, {0.01f, 0.022f}, {0, 0}}};
  const int count = static_cast<int>(std::lround(2 * wall.half / 1.25f));
  const float pitch = 2 * wall.half / static_cast<float>(count);
  for (int i = 0; i < count; ++i) {
    const float u = -wall.half + (static_cast<float>(i) + 0.5f) * pitch;
    bool free = true;
    for (const Opening& o : wall.openings)
      free = free && (o.sill > kDadoHeight || std::abs(u - o.centre) > o.half + 0.5f * pitch + 0.1f);
    if (!free) continue;
    out.append(moulding({0.5f * pitch - 0.09f, 0.28f}, profile),
               onWall(wall.inside.at(u, 0.54f), wall.inside.normal));
  }
}

void addWalls(Model& model, const Materials& materials) {
  Shape plaster, dado, trim, stucco;
  const std::array<glm::vec2, 5> skirting{
      {{0.032f, 0}, {0.032f, 0.13f}, {0.022f, 0.15f}, {0.016f, 0.17f}, {0, 0.175f}}};
  const std::array<glm::vec2, 6> rail{
      {{0, 0.885f}, {0.018f, 0.895f}, {0.022f, 0.92f}, {0.04f, 0.935f}, {0.04f, 0.955f}, {0, 0.965f}}};
  const std::array<glm::vec2, 7> surround{{{-0.01f, -0.02f},
                                           {-0.01f, 0.045f},
                                           {0.03f, 0.06f},
                                           {0.12f, 0.06f},
                                           {0.14f, 0.085f},
                                           {0.19f, 0.075f},
                                           {0.2f, 0}}};
  const std::array<glm::vec2, 5> windowSurround{
      {{-0.005f, -0.02f}, {-0.005f, 0.03f}, {0.05f, 0.045f}, {0.085f, 0.03f}, {0.09f, 0}}};
  for (const Wall& wall : walls()) {
    addWall(dado, wall.inside, -wall.half, wall.half, 0, kDadoHeight, wall.openings);
    addWall(plaster, wall.inside, -wall.half, wall.half, kDadoHeight, kHeight, wall.openings);
    addWall(stucco, wall.outside, -wall.half - kWall, wall.half + kWall, -0.5f, kParapet, wall.openings);
    addDadoPanels(dado, wall);
    const bool door = !wall.openings.empty() && wall.openings.front().sill < kDadoHeight;
    if (door) {
      for (const float side : {-1.0f, 1.0f}) {
        const float near = side * (kDoorHalf + 0.19f), far = side * wall.half;
        addRail(trim, wall.inside, std::min(near, far), std::max(near, far), skirting);
        addRail(trim, wall.inside, std::min(near, far), std::max(near, far), rail);
      }
    } else {
      addRail(trim, wall.inside, -wall.half, wall.half, skirting);
      addRail(trim, wall.inside, -wall.half, wall.half, rail);
    }
    for (const Opening& o : wall.openings) {
      addReveal(trim, wall.inside, o, kWall, o.sill > 0);
      addSurround(trim, wall.inside, o, door ? std::span<const glm::vec2>(surround) : windowSurround);
      addSurround(trim, wall.outside, o, door ? std::span<const glm::vec2>(surround) : windowSurround);
    }
  }
  // Cornice and coping outside.
  const std::array<glm::vec2, 7> coping{{{0.12f, kParapet},
                                         {-0.16f, kParapet},
                                         {-0.18f, kParapet - 0.06f},
                                         {-0.1f, kParapet - 0.16f},
                                         {-0.06f, kParapet - 0.3f},
                                         {-0.03f, kParapet - 0.32f},
                                         {0, kParapet - 0.45f}}};
  trim.append(moulding({kHalfLength + kWall, kHalfWidth + kWall}, coping));
  model.add("Walls", materials.plaster, std::move(plaster));
  model.add("Dado", materials.panel, std::move(dado));
  model.add("Wall mouldings", materials.trim, std::move(trim));
  model.add("Outside walls", materials.stucco, std::move(stucco));
}

/// Glazing bars of a half circle: rays and one ring.
void addFan(Shape& out, const WallSide& side, const Opening& o, int rays, float depth) {
  const float thick = 0.018f;
  const auto at = [&](float angle, float radius) {
    return side.at(o.centre + radius * std::cos(angle), o.head + radius * std::sin(angle), -depth);
  };
  for (int i = 1; i < rays; ++i) {
    const float angle = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(rays);
    const std::array<glm::vec3, 2> ends{at(angle, 0.3f * o.half), at(angle, o.half)};
    out.append(tube(ends, thick, 6));
  }
  std::vector<glm::vec3> ring;
  for (int i = 0; i <= 20; ++i)
    ring.push_back(at(glm::pi<float>() * static_cast<float>(i) / 20, 0.3f * o.half));
  out.append(tube(ring, thick, 6));
  const std::array<glm::vec3, 2> sill{side.at(o.centre - o.half, o.head, -depth),
                                      side.at(o.centre + o.half, o.head, -depth)};
  out.append(tube(sill, 0.03f, 4));
}

/// One leaf, hinged at the origin, along +x.
Shape doorLeaf() {
  Shape out;
  const float width = kDoorHalf - 0.02f, height = kDoorSpring - 0.03f, half = 0.026f;
  addBox(out, {0, -half, 0.015f}, {width, half, height}, 0.006f);
  const std::array<glm::vec2, 6> raised{
      {{0.14f, 0.022f}, {0.075f, 0.004f}, {0.06f, 0.004f}, {0.03f, 0.014f}, {0.01f, 0.012f}, {0, 0}}};
  struct Panel {
    float low, high;
  };
  for (const Panel panel : {Panel{0.14f, 0.62f}, Panel{0.76f, 1.42f}, Panel{1.56f, 2.14f}})
    for (const float side : {-1.0f, 1.0f}) {
      const glm::vec3 normal(0, side, 0);
      const glm::vec2 size(0.5f * width - 0.14f, 0.5f * (panel.high - panel.low));
      const glm::mat4 place = onWall({0.5f * width, side * half, 0.5f * (panel.low + panel.high)}, normal);
      Shape face = moulding(size, raised);
      addQuad(face, {-size.x + 0.14f, -size.y + 0.14f, 0.022f}, {size.x - 0.14f, -size.y + 0.14f, 0.022f},
              {size.x - 0.14f, size.y - 0.14f, 0.022f}, {-size.x + 0.14f, size.y - 0.14f, 0.022f});
      out.append(face, place);
    }
  return out;
}

Shape doorHandle() {
  Shape out;
  const std::array<glm::vec2, 7> knob{{{0, 0.05f},
                                       {0.018f, 0.05f},
                                       {0.03f, 0.062f},
                                       {0.034f, 0.08f},
                                       {0.026f, 0.098f},
                                       {0.012f, 0.105f},
                                       {0, 0.106f}}};
  const std::array<glm::vec2, 5> rose{
      {{0.035f, 0}, {0.032f, 0.008f}, {0.012f, 0.012f}, {0.01f, 0.055f}, {0, 0.055f}}};
  for (const float side : {-1.0f, 1.0f}) {
    const glm::mat4 place = onWall({kDoorHalf - 0.12f, side * 0.026f, 1.05f}, {0, side, 0});
    out.append(lathe(knob, 16), place);
    out.append(lathe(rose, 16), place);
  }
  return out;
}

void addDoor(Model& model, const Materials& materials) {
  const Wall wall = walls()[2];
  Shape bars;
  addFan(bars, wall.inside, kDoor, 6, 0.5f * kWall);
  for (const Wall& w : {walls()[0], walls()[1]})
    for (const Opening& o : w.openings) addFan(bars, w.inside, o, 5, 0.5f * kWall);
  model.add("Glazing bars", materials.trim, std::move(bars));
  Thing door{"Door leaf", {{materials.doorWood, doorLeaf()}, {materials.brass, doorHandle()}}, {}};
  door.placements.push_back(moved(kHalfLength - 0.06f, kDoorHalf, 0) * turned(168));
  door.placements.push_back(moved(kHalfLength - 0.06f, -kDoorHalf, 0) * turned(-168));
  model.things.push_back(std::move(door));
}

}  // namespace

void addHall(Model& model, const Materials& materials) {
  addFloor(model, materials);
  addWalls(model, materials);
  addDoor(model, materials);
}

}  // namespace acentric::gallery
