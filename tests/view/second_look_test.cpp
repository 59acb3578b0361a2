#include "engine/view/second_look.h"

#include <gtest/gtest.h>

#include "capture_fixtures.h"
#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/patch_painter.h"

namespace acentric {
namespace {

/// Rays through pixels, one metre along the view axis.
struct Rays {
  glm::dvec3 ahead{0}, across{0}, down{0};

  explicit Rays(const PerspectiveView& view) {
    const glm::dmat3 axes = glm::transpose(view.viewFromWorld());
    ahead = axes[2], across = axes[0] / view.focalPixels(), down = axes[1] / view.focalPixels();
  }
  glm::dvec3 at(double x, double y) const { return ahead + x * across + y * down; }
};

TEST(SecondLook, TellsHowDenselyACameraSamplesAPlane) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int trial = 0; trial < 200; ++trial) {
    PerspectiveView view;
    view.yawRadians = between(0, kTwoPi), view.pitchRadians = between(-0.5, 0.5);
    const Rays rays(view);
    const double x = between(-400, 400), y = between(-200, 200);
    const glm::dvec3 ray = rays.at(x, y), place = between(1, 20) * ray;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)));
    const glm::dvec3 baseline(between(-0.5, 0.5), between(-0.5, 0.5), between(-0.5, 0.5));
    const double columns = between(100, 1000), rows = between(100, 1000);
    if (std::abs(glm::dot(normal, glm::normalize(ray))) < 0.05) continue;  // seen edge on
    const double zDepth = glm::dot(place, rays.ahead);
    // Where the camera samples what pixels beside this one show.
    const auto texelAt = [&](double right, double below) {
      const glm::dvec3 other = rays.at(x + right, y + below);
      const glm::dvec3 d = other * (glm::dot(normal, place) / glm::dot(normal, other)) - baseline;
      return glm::dvec2(columns * std::atan2(d.y, d.x), rows * std::atan2(d.z, std::hypot(d.x, d.y)));
    };
    const double h = 1e-3;
    const auto moved = [&](double right, double below) {
      const glm::dvec2 step = texelAt(right, below) - texelAt(-right, -below);
      return glm::dvec2(std::remainder(step.x, columns * kTwoPi), step.y) / (2 * h);
    };
    const glm::dvec2 across = moved(h, 0), down = moved(0, h);
    const double expected = std::abs(across.x * down.y - across.y * down.x) /
                            std::sqrt(glm::dot(across, across) + glm::dot(down, down));
    const auto pixel = SurfacePixel::onPlane(normal, zDepth, ray, rays.across, rays.down);
    EXPECT_NEAR(glm::distance(pixel.place, place), 0, 1e-9);
    EXPECT_NEAR(densityAt(pixel, baseline, columns, rows), expected, 1e-4 * expected + 1e-7) << trial;
  }
}

/// Frames of the captures' patches alone, and how much of them the second cover shows.
struct Painted {
  Canvas canvas;
  std::size_t second = 0;
};
Painted paintedBy(const PatchPlan& plan, const PerspectiveView& view) {
  Painted painted;
  painted.canvas.width = view.width, painted.canvas.height = view.height;
  painted.canvas.pixels.assign(std::size_t(view.width) * std::size_t(view.height), kEmptyPixel);
  PatchCanvas memory;
  paintPatches(plan, *supportedKernels().back().patches, nullptr, {}, 0, view.width, memory, painted.canvas);
  for (const CanvasPixel pixel : painted.canvas.pixels)
    painted.second += slotOf(pixel) != 0 && slotOf(pixel) < plan.frontSlot;
  return painted;
}

TEST(SecondLook, LeavesOutWhatTheSecondCoverHardlyShows) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(11, 60, 4), layout, region, 2);
  test::RandomViews views(5);
  TaskRunner runner;
  std::size_t patches = 0, settled = 0, second = 0, lost = 0;
  for (int round = 0; round < 12; ++round) {
    const PerspectiveView view = views.next(*layout, region, 60);
    const auto plan = planView(scene, view, {});
    ASSERT_TRUE(plan);
    const PatchPlan ours = planPatches(scene, view, *plan, runner);
    PatchPlan all = ours;  // looks again wherever the first cover is thin
    for (StripDraw& strip : all.surfaces)
      for (PatchDraw& draw : strip.patches) {
        ++patches, settled += draw.column.settled;
        draw.column.settled = false;
      }
    for (const std::vector<StripDraw>* strips : {&ours.behind, &ours.reflections, &ours.mirrors})
      for (const StripDraw& strip : *strips)
        for (const PatchDraw& draw : strip.patches) EXPECT_FALSE(draw.column.settled);
    const Painted with = paintedBy(ours, view), reference = paintedBy(all, view);
    second += reference.second;
    for (std::size_t i = 0; i < reference.canvas.pixels.size(); ++i)
      lost += reference.canvas.pixels[i] != with.canvas.pixels[i];
  }
  EXPECT_GT(settled, patches / 2);
  EXPECT_LT(settled, patches) << "the second cover is worth a look somewhere";
  EXPECT_GT(second, 10000u);
  EXPECT_LT(lost, second / 50);
}

TEST(SecondLook, IsWorthItWhereAnotherCameraSamplesMoreDensely) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(11, 60, 4), layout, region, 2);
  test::RandomViews views(5);
  const PerspectiveView view = views.next(*layout, region, 60);
  const auto plan = planView(scene, view, {});
  ASSERT_TRUE(plan);
  const SecondLook look(scene, plan->pieces), none(scene, {});
  const Rays rays(view);
  const auto pixel = SurfacePixel::onPlane(rays.ahead, 5, rays.ahead, rays.across, rays.down);
  EXPECT_TRUE(look.isWorth(pixel, 1e-3)) << "hardly sampled by the first";
  EXPECT_FALSE(look.isWorth(pixel, 1)) << "as densely as the picture's pixels";
  EXPECT_FALSE(none.isWorth(pixel, 1e-3));
}

}  // namespace
}  // namespace acentric
