// A small round temple where the garden path ends.

#include <array>
#include <cmath>
#include <numbers>

#include "projects/gallery/generator/gallery.h"

namespace acentric::gallery {

void addFolly(Model& model, const Materials& materials, const glm::vec3& foot) {
  constexpr int kColumns = 8;
  constexpr float kRing = 1.9f;
  Shape stone;
  // Three steps, and the floor.
  const std::array<glm::vec2, 7> steps{
      {{2.75f, 0}, {2.75f, 0.17f}, {2.5f, 0.17f}, {2.5f, 0.34f}, {2.25f, 0.34f}, {2.25f, 0.5f}, {0, 0.5f}}};
  stone.append(lathe(steps, 40));
  const std::array<glm::vec2, 11> column{{{0.22f, 0.5f},
                                          {0.22f, 0.56f},
                                          {0.19f, 0.6f},
                                          {0.2f, 0.66f},
                                          {0.165f, 0.7f},
                                          {0.16f, 1.6f},
                                          {0.135f, 3.0f},
                                          {0.15f, 3.03f},
                                          {0.14f, 3.08f},
                                          {0.21f, 3.2f},
                                          {0.21f, 3.28f}}};
  const Shape one = lathe(column, 14);
  for (int i = 0; i < kColumns; ++i) {
    // Half a turn between two columns: one looks in between them along the path.
    const float angle = 2 * std::numbers::pi_v<float> * (static_cast<float>(i) + 0.5f) / kColumns;
    stone.append(one, moved(kRing * std::cos(angle), kRing * std::sin(angle), 0));
  }
  const std::array<glm::vec2, 12> roof{{{1.68f, 3.75f},
                                        {1.68f, 3.28f},
                                        {2.12f, 3.28f},
                                        {2.12f, 3.5f},
                                        {2.16f, 3.52f},
                                        {2.16f, 3.62f},
                                        {2.34f, 3.72f},
                                        {2.34f, 3.8f},
                                        {2.05f, 3.84f},
                                        {2.02f, 3.98f},
                                        {1.92f, 4.02f},
                                        {1.9f, 4.05f}}};
  stone.append(lathe(roof, 40));
  Shape dome;
  std::array<glm::vec2, 13> shell{};
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const float angle = 0.5f * std::numbers::pi_v<float> * static_cast<float>(i) / (shell.size() - 1);
    shell[i] = {i + 1 == shell.size() ? 0.0f : 1.9f * std::cos(angle), 4.05f + 1.45f * std::sin(angle)};
  }
  dome.append(lathe(shell, 40));
  const std::array<glm::vec2, 8> finial{{{0.16f, 5.44f},
                                         {0.1f, 5.56f},
                                         {0.06f, 5.62f},
                                         {0.12f, 5.7f},
                                         {0.14f, 5.78f},
                                         {0.1f, 5.86f},
                                         {0.03f, 5.92f},
                                         {0, 6.15f}}};
  dome.append(lathe(finial, 14));
  model.things.push_back({"Folly",
                          {{materials.stucco, std::move(stone)}, {materials.pot, std::move(dome)}},
                          {moved(foot.x, foot.y, foot.z)}});
}

}  // namespace acentric::gallery
