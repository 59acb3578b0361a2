#pragma once
/// A headless OpenGL context and a renderer for each test; the test is skipped where there is no driver.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "engine/view/render.h"
#include "engine/view/view_cameras.h"
#include "engine/view_gl/gl_renderer.h"
#include "tests/view/analytic_scene.h"

namespace acentric::test {

inline Frame drawnBy(GlRenderer& renderer, const WalkScene& scene, const PerspectiveView& view,
                     const ViewSettings& settings) {
  const auto stats = renderer.draw(scene, view, settings);
  if (!stats) {
    ADD_FAILURE() << stats.error().describe();
    return {};
  }
  return renderer.readBack();
}

class WithGl : public testing::Test {
 protected:
  void SetUp() override {
    // Mesa's software driver: no threads of its own, which on a busy machine mostly wait for each other.
    setenv("LP_NUM_THREADS", "0", 0);
    auto context = HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().describe();
    context_ = std::move(*context);
    auto renderer = GlRenderer::create();
    ASSERT_TRUE(renderer) << renderer.error().describe();
    renderer_ = std::move(*renderer);
  }
  void TearDown() override {
    renderer_.reset();
    context_.reset();
  }

  Frame onGl(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings) {
    return drawnBy(*renderer_, scene, view, settings);
  }

  std::unique_ptr<HeadlessContext> context_;
  std::unique_ptr<GlRenderer> renderer_;
};

/// The walk without the cameras that this view is not painted from.
inline WalkScene onlyInView(WalkScene scene, const PerspectiveView& view, const ViewSettings& settings) {
  const std::vector<int> cameras = camerasOf(*scene.layout, view, settings).cameras;
  for (std::size_t i = 0; i < scene.captures.size(); ++i)
    if (!std::ranges::binary_search(cameras, int(i))) scene.captures[i] = nullptr;
  return scene;
}

/// As the scalar reference paints it.
inline Frame onCpu(const WalkScene& scene, const PerspectiveView& view, ViewSettings settings) {
  settings.renderer = Renderer::scalar;
  TaskRunner runner(0);
  auto frame = renderFrame(scene, view, settings, runner);
  if (!frame) {
    ADD_FAILURE() << frame.error().describe();
    return {};
  }
  return std::move(*frame);
}

/// Share of pixels whose sources differ.
inline double differingSources(const Frame& a, const Frame& b) {
  if (a.source.pixels.size() != b.source.pixels.size() || a.source.empty()) return 1;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.source.pixels.size(); ++i)
    differing += a.source.pixels[i] != b.source.pixels[i];
  return double(differing) / double(a.source.pixels.size());
}

/// The CPU and the graphics card compute places in floats of their own rounding.
inline constexpr double kMostDifferingShare = 0.002;

}  // namespace acentric::test
