#include "engine/view/cracks.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "capture_fixtures.h"

namespace acentric {
namespace {

constexpr std::uint32_t kFirstSlot = 5;  // of the first cover

Canvas canvasOf(int width, int height, const std::function<float(int x, int y)>& inverseZDepth) {
  Canvas canvas;
  canvas.x0 = 10, canvas.width = width, canvas.height = height;
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y)
      canvas.pixels.push_back(
          canvasPixel(kFirstSlot << 24 | std::uint32_t(x * height + y), inverseZDepth(x, y)));
  return canvas;
}

/// What Cracks::open says, pixel by pixel.
bool isCrack(const Canvas& canvas, int x, int y) {
  const auto depth = [&](int i, int j) {
    if (i < 0 || i >= canvas.width || j < 0 || j >= canvas.height) return -1.0f;
    return inverseZDepthOf(canvas.column(canvas.x0 + i)[j]);
  };
  if (slotOf(canvas.column(canvas.x0 + x)[y]) < kFirstSlot) return false;
  const auto nearerOn = [&](int dx, int dy) {
    for (int k = 1; k <= Cracks::kReach; ++k)
      if (depth(x + k * dx, y + k * dy) > Cracks::kBefore * depth(x, y)) return true;
    return false;
  };
  return (nearerOn(-1, 0) && nearerOn(1, 0)) || (nearerOn(0, -1) && nearerOn(0, 1));
}

std::vector<bool> openPixels(const Canvas& canvas) {
  std::vector<bool> open;
  for (const CanvasPixel pixel : canvas.pixels) open.push_back(slotOf(pixel) == 0);
  return open;
}

TEST(Cracks, AreWhereNearerPixelsLieOnBothSides) {
  std::mt19937 random(1);
  std::size_t cracks = 0;
  for (int round = 0; round < 40; ++round) {
    Canvas canvas = canvasOf(1 + int(random() % 30), 1 + int(random() % 40), [&](int, int) {
      const unsigned kind = random() % 8;
      return kind == 0 ? 0.0f : kind < 4 ? 0.2f : 0.2f * (1 + 0.015f * float(random() % 6));
    });
    for (CanvasPixel& pixel : canvas.pixels) {
      if (random() % 9 == 0) pixel = kEmptyPixel;
      if (random() % 9 == 0) pixel = canvasPixel(2u << 24, 0.1f);  // of the background
    }
    std::vector<bool> expected;
    for (int x = 0; x < canvas.width; ++x)
      for (int y = 0; y < canvas.height; ++y)
        expected.push_back(slotOf(canvas.pixels[expected.size()]) == 0 || isCrack(canvas, x, y));
    const Canvas before = canvas;
    Cracks all;
    all.open(canvas, kFirstSlot);
    ASSERT_EQ(openPixels(canvas), expected);
    for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
      EXPECT_EQ(canvas.pixels[i] >> 32, before.pixels[i] >> 32) << "depths stay";
      cracks += canvas.pixels[i] != before.pixels[i];
    }
    all.close(canvas);
    EXPECT_EQ(canvas.pixels, before.pixels) << "nothing was painted";
  }
  EXPECT_GT(cracks, 1000u);
}

TEST(Cracks, KeepWhatIsPaintedInFrontAlone) {
  const auto slit = [](int x, int) { return x == 4 ? 0.1f : 0.5f; };
  Canvas canvas = canvasOf(9, 5, slit);
  const Canvas before = canvas;
  Cracks cracks;
  cracks.open(canvas, kFirstSlot);
  CanvasPixel* const column = canvas.column(canvas.x0 + 4);
  const CanvasPixel behind = canvasPixel(1u << 24 | 7, 0.05f), same = canvasPixel(1u << 24 | 7, 0.102f),
                    before4 = canvasPixel(1u << 24 | 7, 0.49f);
  column[1] = behind, column[2] = same, column[3] = before4;
  cracks.close(canvas);
  std::vector<CanvasPixel> expected = before.pixels;
  expected[4 * 5 + 3] = before4;
  EXPECT_EQ(canvas.pixels, expected);
}

/// Every ninth column of the first cover's cameras lacks what lies near, and shows a red wall far behind.
WalkScene withSlits(const WalkScene& whole, const ViewPlan& plan, const Rgba8& red) {
  WalkScene slit = whole;
  for (const PieceDraw& piece : plan.pieces) {
    if (piece.secondary) continue;
    DisplayCapture capture = *whole.captures[std::size_t(piece.camera)];
    for (std::size_t k = 0; k + 1 < capture.columnStart.size(); k += 9)
      for (std::uint32_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i) {
        PackedSample& sample = capture.samples[i];
        sample = packSample(1 / 40.0f, rolesOf(sample), sample.row);
        capture.colour[i] = red;
      }
    for (glm::vec2& range : capture.columnRange) range.x = std::min(range.x, 1 / 41.0f);
    slit.captures[std::size_t(piece.camera)] = std::make_shared<const DisplayCapture>(std::move(capture));
  }
  return slit;
}

TEST(Cracks, AreFilledByTheOtherHand) {
  const Rgba8 red(255, 0, 0, 255);
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene whole = test::walkScene(test::randomBoxes(11, 60, 4), layout, region, 6);
  test::RandomViews views(5);
  for (const Renderer renderer : {Renderer::list, Renderer::scalar, Renderer::zbuffer}) {
    std::ptrdiff_t without = 0, with = 0;
    for (int round = 0; round < 3; ++round) {
      const PerspectiveView view = views.next(*layout, region, 60);
      ViewSettings settings = test::splatSettings();
      settings.renderer = renderer;
      const auto plan = planView(whole, view, settings);
      ASSERT_TRUE(plan);
      const WalkScene slit = withSlits(whole, *plan, red);
      with += std::ranges::count(test::frameOf(slit, view, settings).colour.pixels, red);
      settings.secondaryCover = false;
      without += std::ranges::count(test::frameOf(slit, view, settings).colour.pixels, red);
    }
    EXPECT_GT(without, 1000) << nameOf(renderer);
    EXPECT_LT(with, 2 * without / 3) << nameOf(renderer) << ": the rest neither hand has";
  }
}

}  // namespace
}  // namespace acentric
