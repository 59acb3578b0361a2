/// Whether the graphics card draws the walk.

#include "editor/session/graphics_trial.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

constexpr std::string_view kSoftware = "OpenGL 4.5, llvmpipe (LLVM 15.0.6, 256 bits)";
constexpr std::string_view kCard = "OpenGL 4.6, NVIDIA GeForce RTX 3060/PCIe/SSE2";

Frame frame(std::uint8_t grey, double seconds) {
  Frame result;
  result.colour = ColourImage(32, 16);
  for (Rgba8& pixel : result.colour.pixels) pixel = Rgba8(grey, grey, grey, 255);
  result.stats.totalSeconds = seconds;
  return result;
}

TEST(GraphicsTrial, IsForCardsAndForWhoeverAsks) {
  const GraphicsTrial trial;
  EXPECT_TRUE(trial.wanted(Graphics::automatic, kCard));
  EXPECT_FALSE(trial.wanted(Graphics::automatic, kSoftware));
  EXPECT_TRUE(trial.wanted(Graphics::card, kSoftware));
  EXPECT_FALSE(trial.wanted(Graphics::processor, kCard));
  EXPECT_FALSE(trial.passed(Graphics::card)) << "before it is tried";
}

TEST(GraphicsTrial, TheCardTakesOverWhereItDrawsTheSameSooner) {
  GraphicsTrial trial;
  EXPECT_EQ(trial.judge(frame(100, 0.02), frame(101, 0.01), Graphics::automatic), "");
  EXPECT_TRUE(trial.passed(Graphics::automatic));
  EXPECT_FALSE(trial.passed(Graphics::processor)) << "the preference was changed";
  EXPECT_FALSE(trial.wanted(Graphics::automatic, kCard));
}

TEST(GraphicsTrial, ASlowCardIsLeftWithoutAWordUnlessItIsAskedFor) {
  GraphicsTrial trial;
  EXPECT_EQ(trial.judge(frame(100, 0.02), frame(100, 0.03), Graphics::automatic), "");
  EXPECT_FALSE(trial.passed(Graphics::automatic));
  EXPECT_FALSE(trial.wanted(Graphics::automatic, kCard)) << "once is enough";
  ASSERT_TRUE(trial.wanted(Graphics::card, kCard));
  EXPECT_EQ(trial.judge(frame(100, 0.02), frame(100, 0.03), Graphics::card), "");
  EXPECT_TRUE(trial.passed(Graphics::card));
}

TEST(GraphicsTrial, ADifferentPictureIsRefusedWithAWord) {
  for (const Graphics graphics : {Graphics::automatic, Graphics::card}) {
    GraphicsTrial trial;
    EXPECT_NE(trial.judge(frame(100, 0.02), frame(110, 0.01), graphics).find("28.1 dB"), std::string::npos);
    EXPECT_FALSE(trial.passed(graphics));
    EXPECT_FALSE(trial.wanted(graphics, kCard));
  }
  GraphicsTrial trial;
  EXPECT_NE(trial.judge(frame(100, 0.02), Frame(), Graphics::automatic), "") << "nothing was drawn";
  EXPECT_FALSE(trial.passed(Graphics::automatic));
}

}  // namespace
}  // namespace acentric::editor
