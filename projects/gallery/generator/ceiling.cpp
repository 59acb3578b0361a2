// Coffers, skylights, beams and cornices.

#include <array>
#include <vector>

#include "projects/gallery/generator/gallery.h"
#include "projects/gallery/generator/wall.h"

namespace acentric::gallery {
namespace {

constexpr int kCofferColumns = 9;
constexpr int kCofferRows = 3;
constexpr float kRecess = 4.8f;  // z of a coffer's ground

bool isSkylight(int column, int row) { return row == 1 && column >= 3 && column <= 5; }

Shape rosette() {
  const std::array<glm::vec2, 6> bud{
      {{0, -0.075f}, {0.03f, -0.07f}, {0.05f, -0.045f}, {0.055f, -0.03f}, {0.1f, -0.02f}, {0.12f, 0}}};
  Shape out = lathe(bud, 12);
  // Petals around it.
  for (int i = 0; i < 8; ++i) {
    Shape petal = blob(
        6, 4, [](const glm::vec3& d) { return 0.05f / glm::length(glm::vec3(d.x * 0.5f, d.y, d.z * 2.2f)); });
    out.append(petal, turned(45.0f * static_cast<float>(i)) * moved(0.14f, 0, -0.005f));
  }
  return out;
}

void addCoffers(Model& model, const Materials& materials) {
  const glm::vec2 cell(2 * kHalfLength / kCofferColumns, 2 * (kColumnRow - kBeamHalf) / kCofferRows);
  const std::array<glm::vec2, 8> steps{{{0, kHeight},
                                        {0.12f, kHeight},
                                        {0.12f, 4.58f},
                                        {0.14f, 4.61f},
                                        {0.2f, 4.62f},
                                        {0.22f, 4.66f},
                                        {0.27f, 4.7f},
                                        {0.27f, kRecess}}};
  const std::array<glm::vec2, 7> shaft{{{0, kHeight},
                                        {0.12f, kHeight},
                                        {0.12f, 4.58f},
                                        {0.14f, 4.61f},
                                        {0.17f, 4.62f},
                                        {0.17f, 4.9f},
                                        {0.1f, kParapet}}};
  Shape ribs, grounds, bars;
  Thing rosettes{"Rosette", {{materials.gilt, rosette()}}, {}};
  for (int row = 0; row < kCofferRows; ++row)
    for (int column = 0; column < kCofferColumns; ++column) {
      const float x = -kHalfLength + cell.x * (static_cast<float>(column) + 0.5f);
      const float y = cell.y * (static_cast<float>(row) + 0.5f - 0.5f * kCofferRows);
      const glm::vec2 half = 0.5f * cell;
      if (isSkylight(column, row)) {
        ribs.append(moulding(half, shaft), moved(x, y, 0));
        for (const float t : {-1.0f / 3, 1.0f / 3}) {
          addBox(bars, {x + 2 * t * (half.x - 0.17f) - 0.02f, y - half.y + 0.1f, 4.92f},
                 {x + 2 * t * (half.x - 0.17f) + 0.02f, y + half.y - 0.1f, 4.98f});
          addBox(bars, {x - half.x + 0.1f, y + 2 * t * (half.y - 0.17f) - 0.02f, 4.92f},
                 {x + half.x - 0.1f, y + 2 * t * (half.y - 0.17f) + 0.02f, 4.98f});
        }
        continue;
      }
      ribs.append(moulding(half, steps), moved(x, y, 0));
      const glm::vec2 inner = half - 0.27f;
      addQuadFacing(grounds, {x - inner.x, y - inner.y, kRecess}, {x + inner.x, y - inner.y, kRecess},
                    {x + inner.x, y + inner.y, kRecess}, {x - inner.x, y + inner.y, kRecess}, {0, 0, -1});
      rosettes.placements.push_back(moved(x, y, kRecess));
    }
  model.add("Coffers", materials.trim, std::move(ribs));
  model.add("Coffer grounds", materials.coffer, std::move(grounds));
  model.add("Skylight bars", materials.trim, std::move(bars));
  model.things.push_back(std::move(rosettes));
}

/// Beams on the columns with their mouldings, cross beams over the aisles, pilasters where beams meet walls.
void addBeams(Model& model, const Materials& materials) {
  Shape out;
  const std::array<glm::vec2, 4> lower{{{0, 3.9f}, {0.02f, 3.91f}, {0.02f, 3.94f}, {0, 3.95f}}};
  const std::array<glm::vec2, 5> upper{
      {{0, 4.26f}, {0.03f, 4.29f}, {0.045f, 4.34f}, {0.09f, 4.39f}, {0.1f, kHeight}}};
  for (const float row : {-kColumnRow, kColumnRow}) {
    const float low = row - kBeamHalf, high = row + kBeamHalf;
    addQuadFacing(out, {-kHalfLength, low, kBeamBottom}, {kHalfLength, low, kBeamBottom},
                  {kHalfLength, high, kBeamBottom}, {-kHalfLength, high, kBeamBottom}, {0, 0, -1});
    for (const float side : {-1.0f, 1.0f}) {
      const WallSide face{{0, row + side * kBeamHalf, 0}, {0, side, 0}};
      addWall(out, face, -kHalfLength, kHalfLength, kBeamBottom, kHeight);
      addRail(out, face, -kHalfLength, kHalfLength, lower);
      addRail(out, face, -kHalfLength, kHalfLength, upper);
      const float end = side * kHalfLength;
      const auto pilaster = [&](float out0, float halfWidth, float z0, float z1, float bevel) {
        const float inner = end - side * out0;
        addBox(out, {std::min(end, inner), row - halfWidth, z0}, {std::max(end, inner), row + halfWidth, z1},
               bevel);
      };
      pilaster(0.16f, 0.33f, 0, 0.12f, 0);
      pilaster(0.14f, 0.29f, 0.12f, 0.34f, 0.02f);
      pilaster(0.11f, 0.24f, 0.34f, 3.42f, 0.008f);
      pilaster(0.14f, 0.28f, 3.42f, 3.62f, 0.02f);
      pilaster(0.17f, 0.33f, 3.62f, kBeamBottom, 0);
    }
  }
  model.add("Beams", materials.columnStone, std::move(out));
}

void addAisleCeilings(Model& model, const Materials& materials) {
  Shape out;
  const float inner = kColumnRow + kBeamHalf, half = 0.5f * (kHalfWidth - inner), middle = inner + half;
  const std::array<glm::vec2, 8> cornice{{{0, 4.2f},
                                          {0.025f, 4.22f},
                                          {0.03f, 4.27f},
                                          {0.06f, 4.29f},
                                          {0.08f, 4.36f},
                                          {0.13f, 4.41f},
                                          {0.17f, 4.43f},
                                          {0.18f, kHeight}}};
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * middle;
    addQuadFacing(out, {-kHalfLength, y - half, kHeight}, {kHalfLength, y - half, kHeight},
                  {kHalfLength, y + half, kHeight}, {-kHalfLength, y + half, kHeight}, {0, 0, -1});
    out.append(moulding({kHalfLength, half}, cornice), moved(0, y, 0));
    for (int i = 0; i < kColumnsPerRow; ++i) {
      const float x = kBay * (static_cast<float>(i) - 0.5f * (kColumnsPerRow - 1));
      addBox(out, {x - 0.16f, y - half, 4.3f}, {x + 0.16f, y + half, kHeight}, 0.02f);
    }
  }
  model.add("Aisle ceilings", materials.trim, std::move(out));
}

}  // namespace

void addCeiling(Model& model, const Materials& materials) {
  addCoffers(model, materials);
  addBeams(model, materials);
  addAisleCeilings(model, materials);
}

}  // namespace acentric::gallery
