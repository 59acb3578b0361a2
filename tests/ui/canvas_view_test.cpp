#include "ui/canvas_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace acentric::ui {
namespace {

CanvasView makeView() {
  CanvasView view;
  view.setArea({100, 50}, {800, 600});
  return view;
}

TEST(CanvasView, PutsItsCentreInTheMiddleOfTheAreaAndYUp) {
  CanvasView view = makeView();
  view.fit({-4, -3}, {4, 3}, 0);
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), 100);
  EXPECT_EQ(view.screenFromWorld({0, 0}), glm::dvec2(500, 350));
  EXPECT_EQ(view.screenFromWorld({4, 3}), glm::dvec2(900, 50));
}

TEST(CanvasView, ScreenAndWorldAreInverse) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> real(-1000, 1000);
  CanvasView view = makeView();
  for (int i = 0; i < 200; ++i) {
    view.zoomAt({real(random), real(random)}, std::exp(real(random) / 2000));
    view.panPixels({real(random), real(random)});
    const glm::dvec2 world(real(random), real(random));
    const glm::dvec2 back = view.worldFromScreen(view.screenFromWorld(world));
    EXPECT_NEAR(back.x, world.x, 1e-6);
    EXPECT_NEAR(back.y, world.y, 1e-6);
  }
}

TEST(CanvasView, ZoomKeepsThePointUnderThePointer) {
  CanvasView view = makeView();
  const glm::dvec2 pointer(217, 433);
  const glm::dvec2 before = view.worldFromScreen(pointer);
  view.zoomAt(pointer, 1.7);
  EXPECT_NEAR(glm::length(view.worldFromScreen(pointer) - before), 0, 1e-12);
}

TEST(CanvasView, ZoomStaysWithinItsLimitsAndIgnoresNonsense) {
  CanvasView view = makeView();
  for (int i = 0; i < 200; ++i) view.zoomAt({300, 300}, 2);
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), CanvasView::kMaxPixelsPerMetre);
  view.zoomAt({300, 300}, -1);
  view.zoomAt({300, 300}, std::nan(""));
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), CanvasView::kMaxPixelsPerMetre);
}

TEST(CanvasView, PanMovesTheWorldWithThePointer) {
  CanvasView view = makeView();
  const glm::dvec2 held = view.worldFromScreen({300, 200});
  view.panPixels({40, -25});
  EXPECT_NEAR(glm::length(view.screenFromWorld(held) - glm::dvec2(340, 175)), 0, 1e-9);
}

TEST(CanvasView, KeepsWhatWasFittedFittedUntilItIsMoved) {
  CanvasView view = makeView();
  view.fit({-2, -1}, {2, 1}, 0);
  view.setArea({0, 0}, {400, 600});
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), 100);
  view.panPixels({5, 0});
  view.setArea({0, 0}, {200, 600});
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), 100);
}

TEST(CanvasView, FitsAPointWithoutDividingByZero) {
  CanvasView view = makeView();
  view.fit({2, 3}, {2, 3});
  EXPECT_TRUE(std::isfinite(view.pixelsPerMetre()));
  EXPECT_EQ(view.centre(), glm::dvec2(2, 3));
}

TEST(NiceStep, IsTheSmallestOneTwoFiveStepThatIsWideEnough) {
  EXPECT_DOUBLE_EQ(niceStep(100, 64), 1.0);
  EXPECT_DOUBLE_EQ(niceStep(100, 50), 0.5);
  EXPECT_DOUBLE_EQ(niceStep(10, 64), 10.0);
  EXPECT_NEAR(niceStep(1000, 64), 0.1, 1e-12);
  for (double scale = 0.01; scale < 1e4; scale *= 1.37) {
    const double pixels = niceStep(scale, 60) * scale;
    EXPECT_GE(pixels, 60 * (1 - 1e-6));
    EXPECT_LE(pixels, 60 * 2.5 + 1e-6);
  }
}

}  // namespace
}  // namespace acentric::ui
