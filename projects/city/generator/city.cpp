#include "projects/city/generator/city.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace acentric::city {
namespace {

using gallery::Shape;

constexpr int kBlocks = 8;
constexpr float kBlock = 40, kStreet = 12, kPitch = kBlock + kStreet, kYard = 8;
constexpr float kHouse = (kBlock - kYard) / 2, kFloor = 3.2f;
constexpr std::size_t kFronts = std::size_t(kBlocks * kBlocks * 4 * 4);

/// Windows of a front and how finely their frames are turned.
struct Detail {
  int floors = 2, columns = 2, steps = 1;
  /// A pane, and four sides of a moulding of so many steps.
  std::size_t trianglesOfFront() const {
    return std::size_t(floors * columns) * (2 + 8 * std::size_t(steps));
  }
};

Detail detailFor(std::size_t triangles) {
  constexpr std::size_t kRest = 12 * kFronts / 4 + 2;  // houses and ground
  const double wanted = double(triangles > kRest ? triangles - kRest : 0) / double(kFronts);
  Detail best;
  double off = std::abs(double(best.trianglesOfFront()) - wanted);
  for (int floors = 2; floors <= 8; ++floors)
    for (int columns = 2; columns <= 14; ++columns)
      for (int steps = 1; steps <= 24; ++steps) {
        // Windows and frames grow finer together.
        if (steps > 1 + floors * columns / 4) continue;
        const Detail detail{floors, columns, steps};
        if (const double d = std::abs(double(detail.trianglesOfFront()) - wanted); d < off)
          off = d, best = detail;
      }
  return best;
}

/// A window in the xy plane, its frame standing out towards z.
gallery::Thing window(const Detail& detail, float width, float height, int frame, int pane) {
  const glm::vec2 half(0.5f * width, 0.5f * height);
  const float depth = 0.12f, breadth = 0.16f * std::min(width, height);
  std::vector<glm::vec2> profile;
  for (int i = 0; i <= detail.steps; ++i) {  // a quarter round, from the wall to the pane
    const float angle = 0.5f * std::numbers::pi_v<float> * float(i) / float(detail.steps);
    profile.emplace_back(breadth * (1 - std::cos(angle)), depth * std::sin(angle) + 0.01f);
  }
  gallery::Thing thing;
  thing.name = "window";
  thing.parts.push_back({frame, gallery::moulding(half, profile)});
  Shape glass;
  const glm::vec2 in = half - breadth;
  gallery::addQuad(glass, {-in.x, -in.y, 0.02f}, {in.x, -in.y, 0.02f}, {in.x, in.y, 0.02f},
                   {-in.x, in.y, 0.02f});
  thing.parts.push_back({pane, std::move(glass)});
  return thing;
}

}  // namespace

gallery::Model makeCity(std::size_t triangles) {
  const Detail detail = detailFor(triangles);
  gallery::Model model;
  const auto material = [&](const char* name, const glm::vec3& colour) {
    return model.add(matt(name, colour));
  };
  const int ground = material("asphalt", {0.16f, 0.16f, 0.17f}),
            frame = material("frame", {0.7f, 0.68f, 0.62f}), pane = material("pane", {0.05f, 0.08f, 0.12f});
  const int walls[] = {material("brick", {0.42f, 0.17f, 0.12f}), material("plaster", {0.62f, 0.55f, 0.42f}),
                       material("stone", {0.45f, 0.45f, 0.46f}), material("render", {0.35f, 0.44f, 0.48f})};
  const float reach = 0.5f * kBlocks * kPitch + kStreet;
  Shape street;
  gallery::addQuad(street, {-reach, -reach, 0}, {reach, -reach, 0}, {reach, reach, 0}, {-reach, reach, 0});
  model.add("ground", ground, std::move(street));

  constexpr float front = kHouse - 2;
  gallery::Thing windows = window(detail, 0.55f * front / float(detail.columns), 0.55f * kFloor, frame, pane);
  Shape houses[4];
  for (int bx = 0; bx < kBlocks; ++bx)
    for (int by = 0; by < kBlocks; ++by)
      for (int h = 0; h < 4; ++h) {
        const glm::vec2 corner(
            kPitch * (float(bx) - 0.5f * kBlocks) + 0.5f * kStreet + (kHouse + kYard) * float(h & 1),
            kPitch * (float(by) - 0.5f * kBlocks) + 0.5f * kStreet + (kHouse + kYard) * float(h >> 1));
        const float storeys = 8 * kFloor + kFloor * float((bx * 5 + by * 3 + h * 2) % 4);
        gallery::addBox(houses[(bx + 2 * by + h) % 4], {corner, 0}, {corner + kHouse, storeys});
        const glm::vec3 middle(corner + 0.5f * kHouse, 0);
        for (const glm::vec3& out :
             {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
          const glm::vec3 along(-out.y, out.x, 0);
          for (int f = 0; f < detail.floors; ++f)
            for (int c = 0; c < detail.columns; ++c)
              windows.placements.push_back(
                  gallery::onWall(middle + 0.5f * kHouse * out +
                                      along * (front * ((float(c) + 0.5f) / float(detail.columns) - 0.5f)) +
                                      glm::vec3(0, 0, 8 * kFloor * (float(f) + 0.5f) / float(detail.floors)),
                                  out));
        }
      }
  for (int i = 0; i < 4; ++i) model.add("houses", walls[i], std::move(houses[i]));
  model.things.push_back(std::move(windows));
  model.lights.push_back(sunlight());
  return model;
}

gallery::Material matt(const char* name, const glm::vec3& colour) {
  gallery::Material material;
  material.name = name;
  material.baseColour = glm::vec4(colour, 1);
  return material;
}

gallery::Light sunlight() {
  gallery::Light sun;
  sun.name = "sun";
  sun.directional = true;
  sun.intensity = 3;
  sun.direction = glm::normalize(glm::vec3(0.5f, 0.35f, -0.8f));
  return sun;
}

}  // namespace acentric::city
