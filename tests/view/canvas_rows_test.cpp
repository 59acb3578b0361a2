#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/frame.h"
#include "engine/view/kernels.h"

namespace acentric {
namespace {

/// A block within a larger canvas and a larger picture.
struct Block {
  static constexpr std::ptrdiff_t kColumnPitch = 37, kRowPitch = 53, kSize = kBlockSide * kRowPitch;
  std::vector<CanvasPixel> pixels = std::vector<CanvasPixel>(kBlockSide * kColumnPitch);
  std::vector<std::uint32_t> sources = std::vector<std::uint32_t>(256);

  explicit Block(std::mt19937& random) {
    for (CanvasPixel& pixel : pixels) {
      pixel = (CanvasPixel(random()) << 32) | random();
      if (random() % 3 == 0) pixel = kEmptyPixel;
    }
    for (std::uint32_t& source : sources) source = random() & 0xffffu;
    sources[0] = kSourceHole;
  }

  struct Rows {
    std::vector<std::uint32_t> colour = std::vector<std::uint32_t>(kSize, 0xdeadbeefu);
    std::vector<std::uint16_t> source = std::vector<std::uint16_t>(kSize, 0xdead);
    std::vector<std::uint32_t> depth = std::vector<std::uint32_t>(kSize, 0xdeadbeefu);  ///< float bits
    bool operator==(const Rows&) const = default;
  };

  template <class Write>
  Rows rows(const Write& write) const {
    Rows rows;
    std::vector<float> depth(kSize, std::bit_cast<float>(0xdeadbeefu));
    write(CanvasBlock{pixels.data(), kColumnPitch, sources.data(), rows.colour.data(), rows.source.data(),
                      depth.data(), kRowPitch});
    for (std::size_t i = 0; i < depth.size(); ++i) rows.depth[i] = std::bit_cast<std::uint32_t>(depth[i]);
    return rows;
  }
};

TEST(CanvasRows, AreThePixelsOfTheColumns) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    const Block block(random);
    const Block::Rows rows = block.rows(writeRowsScalar);
    for (std::ptrdiff_t y = 0; y < kBlockSide; ++y)
      for (std::ptrdiff_t x = 0; x < Block::kRowPitch; ++x) {
        const std::size_t at = std::size_t(y * Block::kRowPitch + x);
        if (x >= kBlockSide) {  // what is beside the block stays as it was
          ASSERT_EQ(rows.colour[at], 0xdeadbeefu);
          ASSERT_EQ(rows.source[at], 0xdead);
          ASSERT_EQ(rows.depth[at], 0xdeadbeefu);
          continue;
        }
        const CanvasPixel pixel = block.pixels[std::size_t(x * Block::kColumnPitch + y)];
        const std::uint32_t slot = slotOf(pixel);
        const std::uint32_t colour = static_cast<std::uint32_t>(pixel);
        ASSERT_EQ(rows.colour[at], slot == 0 ? colour : colour | 0xff000000u);
        ASSERT_EQ(rows.source[at], block.sources[slot]);
        ASSERT_EQ(rows.depth[at], slot == 0 ? 0u : static_cast<std::uint32_t>(pixel >> 32));
      }
  }
}

TEST(CanvasRows, AreTheSameWhateverTheProcessor) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const Block block(random);
    for (const Kernels& kernels : supportedKernels())
      ASSERT_TRUE(block.rows(kernels.writeRows) == block.rows(writeRowsScalar)) << kernels.name;
  }
}

TEST(CanvasRows, OfAPartLeaveTheRestAlone) {
  std::mt19937 random(3);
  const Block block(random);
  const Block::Rows whole = block.rows(writeRowsScalar), untouched;
  const Block::Rows part = block.rows([](const CanvasBlock& b) { writeRowsOfPart(b, 5, 3); });
  for (std::ptrdiff_t y = 0; y < kBlockSide; ++y)
    for (std::ptrdiff_t x = 0; x < Block::kRowPitch; ++x) {
      const std::size_t at = std::size_t(y * Block::kRowPitch + x);
      const Block::Rows& expected = x < 5 && y < 3 ? whole : untouched;
      ASSERT_EQ(part.colour[at], expected.colour[at]);
      ASSERT_EQ(part.source[at], expected.source[at]);
      ASSERT_EQ(part.depth[at], expected.depth[at]);
    }
}

}  // namespace
}  // namespace acentric
