#include "engine/bake/alpha_cells.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "engine/image/colour.h"

namespace acentric {
namespace {

/// Leaves: whole, gone, and what lies between along edges that run anywhere.
ColourImage leaves(int width, int height, std::mt19937& random) {
  ColourImage image(width, height);
  std::uniform_int_distribution<int> any(0, 255), kind(0, 5);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int k = ((x / 5) * 7 + (y / 4) * 3 + kind(random) / 5) % 3;
      image.at(x, y) = {9, 9, 9, k == 0 ? 0 : k == 1 ? 255 : any(random)};
    }
  return image;
}

struct Case {
  Wrap wrapU, wrapV;
  bool nearest;
  float factor, cutoff;
};

TEST(AlphaCells, CutOutWhatTheTextureCutsOut) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-3, 4);
  int told = 0, asked = 0;
  for (const Case& c :
       {Case{Wrap::repeat, Wrap::repeat, false, 1, 0.5f}, Case{Wrap::clamp, Wrap::mirror, false, 1, 0.5f},
        Case{Wrap::mirror, Wrap::clamp, false, 0.8f, 0.8f}, Case{Wrap::repeat, Wrap::clamp, true, 1, 0.5f},
        Case{Wrap::mirror, Wrap::repeat, true, 0.6f, 0.25f}, Case{Wrap::repeat, Wrap::repeat, false, 1, 1},
        Case{Wrap::repeat, Wrap::repeat, false, 0, 0},
        Case{Wrap::repeat, Wrap::repeat, false, 1, std::numeric_limits<float>::quiet_NaN()},
        Case{Wrap::repeat, Wrap::repeat, false, std::numeric_limits<float>::infinity(), 0.5f}})
    for (const glm::ivec2 size : {glm::ivec2(37, 23), glm::ivec2(1, 9), glm::ivec2(64, 1)}) {
      Scene scene;
      scene.images.push_back(std::make_shared<const ColourImage>(leaves(size.x, size.y, random)));
      scene.textures.push_back({"leaves", 0, c.wrapU, c.wrapV, c.nearest});
      TextureUse use;
      use.texture = 0;
      const TextureSampler texture(scene, use);
      const AlphaCells cells(texture, c.factor, c.cutoff);
      const auto expectAt = [&](const glm::vec2& at) {
        const AlphaCells::Cut cut = cells.at(at);
        const bool isCut = c.factor * texture.colour(at, linearFromSrgbTable()).a < c.cutoff;
        ++asked;
        if (cut == AlphaCells::Cut::readTexture) return;
        ++told;
        ASSERT_EQ(cut == AlphaCells::Cut::everywhere, isCut)
            << at.x << ", " << at.y << " of " << size.x << " x " << size.y << ", cutoff " << c.cutoff;
      };
      for (int n = 0; n < 4000; ++n) expectAt({anywhere(random), anywhere(random)});
      // Where cells meet, and what no number tells.
      for (int x = -2 * size.x; x <= 3 * size.x; ++x)
        for (const float half : {0.0f, 0.5f})
          expectAt((glm::vec2(float(x), float(x % 7)) + half) / glm::vec2(size));
      const float nan = std::numeric_limits<float>::quiet_NaN();
      for (const glm::vec2 odd : {glm::vec2(nan, 0), glm::vec2(1e30f, -1e30f), glm::vec2(-1e-10f, 1)})
        expectAt(odd);
    }
  EXPECT_GT(told, asked / 2) << "most cells are whole, or gone";
  EXPECT_LT(told, asked);
}

}  // namespace
}  // namespace acentric
