// Fluted columns on moulded bases.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "projects/gallery/generator/gallery.h"

namespace acentric::gallery {
namespace {

constexpr int kFlutes = 20;
constexpr int kSamplesPerFlute = 6;
constexpr float kShaftBottom = 0.38f, kShaftTop = 3.34f;

/// Radius with a slight swelling below the middle.
float shaftRadius(float t) { return glm::mix(0.256f, 0.212f, std::pow(t, 1.6f)); }

Shape shaft() {
  // Rows are dense where the flutes end in round niches.
  constexpr std::array<float, 11> kRows{0,     0.013f, 0.02f, 0.031f, 0.05f, 0.5f,
                                        0.95f, 0.969f, 0.98f, 0.987f, 1};
  Shape out;
  const auto rowAt = [&](float t) {
    const float place = std::clamp(t, 0.0f, 1.0f) * (kRows.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(place), kRows.size() - 2);
    return glm::mix(kRows[low], kRows[low + 1], place - static_cast<float>(low)) + std::min(t, 0.0f) +
           std::max(t - 1, 0.0f);
  };
  addGrid(out, kFlutes * kSamplesPerFlute, static_cast<int>(kRows.size()) - 1,
          [&](float s, float t) {
            const float up = rowAt(t), turn = s - std::floor(s);
            const float across = 2 * (turn * kFlutes - std::floor(turn * kFlutes)) - 1;
            const float radius = shaftRadius(std::clamp(up, 0.0f, 1.0f));
            // A flute is a round hollow between flat fillets; at both ends it closes like a shell.
            const float fromEnd = std::min(up, 1 - up) * (kShaftTop - kShaftBottom);
            const float niche = std::clamp((fromEnd - 0.04f) / 0.07f, 0.0f, 1.0f);
            const float open = niche > 0 ? 1 - (1 - niche) * (1 - niche) : 0.0f;
            const float hollow = std::sqrt(std::max(0.0f, 1 - (across / 0.84f) * (across / 0.84f)));
            const float r = radius - 0.021f * hollow * open;
            const float angle = 2 * std::numbers::pi_v<float> * turn;
            return glm::vec3(r * std::cos(angle), r * std::sin(angle), glm::mix(kShaftBottom, kShaftTop, up));
          },
          {1.5f, 3.0f});
  return out;
}

Shape column() {
  Shape out;
  addBox(out, {-0.35f, -0.35f, 0}, {0.35f, 0.35f, 0.1f}, 0.008f);
  const std::array<glm::vec2, 17> base{{{0.345f, 0.1f},
                                        {0.352f, 0.125f},
                                        {0.352f, 0.15f},
                                        {0.342f, 0.175f},
                                        {0.325f, 0.19f},
                                        {0.31f, 0.19f},
                                        {0.31f, 0.2f},
                                        {0.293f, 0.215f},
                                        {0.285f, 0.24f},
                                        {0.293f, 0.265f},
                                        {0.305f, 0.275f},
                                        {0.305f, 0.285f},
                                        {0.315f, 0.3f},
                                        {0.313f, 0.325f},
                                        {0.297f, 0.342f},
                                        {0.272f, 0.345f},
                                        {0.256f, kShaftBottom}}};
  out.append(lathe(base, 32));
  out.append(shaft());
  const std::array<glm::vec2, 16> capital{{{0.212f, kShaftTop},
                                           {0.226f, 3.345f},
                                           {0.236f, 3.36f},
                                           {0.234f, 3.376f},
                                           {0.222f, 3.385f},
                                           {0.216f, 3.39f},
                                           {0.216f, 3.46f},
                                           {0.232f, 3.465f},
                                           {0.236f, 3.475f},
                                           {0.24f, 3.485f},
                                           {0.27f, 3.51f},
                                           {0.3f, 3.55f},
                                           {0.318f, 3.59f},
                                           {0.322f, 3.615f},
                                           {0.312f, 3.63f},
                                           {0.3f, 3.633f}}};
  out.append(lathe(capital, 32));
  addBox(out, {-0.35f, -0.35f, 3.63f}, {0.35f, 0.35f, kBeamBottom}, 0.012f);
  return out;
}

}  // namespace

void addColonnade(Model& model, const Materials& materials) {
  Thing columns{"Column", {{materials.columnStone, column()}}, {}};
  for (const float y : {-kColumnRow, kColumnRow})
    for (int i = 0; i < kColumnsPerRow; ++i) {
      const float x = kBay * (static_cast<float>(i) - 0.5f * (kColumnsPerRow - 1));
      // Each turned by some flutes, so that the stone's picture does not repeat.
      columns.placements.push_back(moved(x, y, 0) *
                                   turned(static_cast<float>(90 * ((3 * i + (y > 0 ? 2 : 0)) % 4))));
    }
  model.things.push_back(std::move(columns));
}

}  // namespace acentric::gallery
