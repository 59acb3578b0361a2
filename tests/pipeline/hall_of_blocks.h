#pragma once
/// A hall whose patches tests draw.

#include <cmath>

#include "tests/bake/mirror_materials.h"

namespace acentric::test {

/// Of one colour, with blocks, slanted ones among them, and a pane of glass. Nothing is lit: colours are
/// exact.
inline SceneBuilder hallOfBlocks() {
  SceneBuilder builder;
  builder.box(builder.material(glowing({0.4f, 0.35f, 0.3f})), {-7, -7, 0}, {7, 7, 3.5f}, true);
  for (int i = 0; i < 9; ++i) {
    const float angle = 0.7f * float(i), far = 3.2f + 0.3f * float(i % 4);
    const float x = far * std::cos(angle), y = far * std::sin(angle);
    builder.box(builder.material(glowing({0.1f * float(i), 0.3f, 0.9f - 0.1f * float(i)})),
                {x - 0.3f, y - 0.2f, 0}, {x + 0.3f, y + 0.25f, 0.6f + 0.25f * float(i)});
  }
  Material glass = glowing({0.2f, 0.5f, 0.3f});
  glass.baseColour.a = 0.4f;
  glass.alphaMode = AlphaMode::blend;
  builder.quad(builder.material(glass), {-4.5f, -1, 0.5f}, {-4.5f, 1.5f, 0.5f}, {-4.5f, 1.5f, 2.2f},
               {-4.5f, -1, 2.2f});
  return builder;
}

}  // namespace acentric::test
