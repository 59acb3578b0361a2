#pragma once
/// Random views, single captures and canvases for the tests of the warp.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/view/captured_background.h"
#include "engine/view/column_order.h"
#include "engine/view/render.h"
#include "engine/view/warp.h"
#include "tests/view/analytic_scene.h"

namespace acentric::test {

struct RandomViews {
  std::mt19937 random;
  double rise = 0.8, pitch = 0.5;  ///< at most, metres from the layout's eye height and radians
  int width = 320, height = 200;
  explicit RandomViews(unsigned seed) : random(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  PerspectiveView next(const Layout& layout, int region, double fovDegrees) {
    const ConvexPolygon& polygon = layout.regions[static_cast<std::size_t>(region)].polygon;
    PerspectiveView view;
    view.eye = glm::dvec3(randomPointIn(polygon, random), layout.eyeZ() + between(-rise, rise));
    view.yawRadians = between(0, kTwoPi);
    view.pitchRadians = between(-pitch, pitch);
    view.fovRadians = radians(fovDegrees);
    view.width = width;
    view.height = height;
    return view;
  }
};

/// Of which a pixel has the colour of one sample.
inline ViewSettings splatSettings() {
  ViewSettings settings;
  settings.reconstruction = Reconstruction::splat;
  return settings;
}

inline ViewSettings plainSettings(Renderer renderer = Renderer::list) {
  ViewSettings settings = splatSettings();
  settings.renderer = renderer;
  settings.secondaryCover = false;
  settings.fillHoles = false;
  return settings;
}

inline Frame frameOf(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                     int workers = 0) {
  TaskRunner runner(workers);
  auto frame = renderFrame(scene, view, settings, runner);
  if (!frame) {
    ADD_FAILURE() << frame.error().describe();
    return {};
  }
  return std::move(*frame);
}

/// One camera over a square region around the origin, for views that need no cover.
struct OneCapture {
  WalkScene scene;
  ViewPlan plan;
};

inline Canvas paint(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                    const ViewPlan& plan, bool depthTest = false, int strips = 4) {
  WarpOptions options;
  options.depthTest = depthTest;
  const CapturedBackground background(scene, plan);
  Canvas canvas, part;
  clearCanvas(scene, view, plan, 0, view.width, canvas);
  for (int strip = 0; strip < strips; ++strip) {
    const int x0 = strip * view.width / strips, x1 = (strip + 1) * view.width / strips;
    const int beside = pixelsReadBeside(plan);
    clearCanvas(scene, view, plan, std::max(x0 - beside, 0), std::min(x1 + beside, view.width), part);
    background.paint(view, part);
    warpPieces(scene, view, settings, plan, options, x0, x1, part);
    const auto copy = [&](const auto& from, auto& to) {
      if (!from.empty())
        std::copy(from.begin() + std::ptrdiff_t(part.indexOf(x0)),
                  from.begin() + std::ptrdiff_t(part.indexOf(x1)),
                  to.begin() + std::ptrdiff_t(canvas.indexOf(x0)));
    };
    copy(part.pixels, canvas.pixels);
    copy(part.stamps, canvas.stamps);
    copy(part.blended, canvas.blended);
    copy(part.mirrors, canvas.mirrors);
  }
  return canvas;
}

/// A plan that draws one capture whole, in list priority order, without culling.
inline OneCapture oneCapture(const AnalyticScene& analytic, const ColumnCamera& camera,
                             const PerspectiveView& view, int layers = 1) {
  OneCapture one;
  one.scene.captures.push_back(std::make_shared<const DisplayCapture>(
      prepareForDisplay(capture(analytic, camera, nullptr, layers), 1)));
  PieceDraw piece;
  piece.baseline = glm::vec3(camera.centreOfProjection - view.eye);
  piece.maxInverseDistance.assign(static_cast<std::size_t>(camera.columns),
                                  std::numeric_limits<float>::infinity());
  piece.runs = columnOrder(camera, glm::dvec2(view.eye) - glm::dvec2(camera.centreOfProjection)).runs;
  one.plan.pieces.push_back(piece);
  if (one.scene.captures[0]->background.runs.runCount() > 0) one.plan.backgrounds.push_back(piece);
  return one;
}

inline ColumnCamera cameraAt(const glm::dvec3& centre, double middleDegrees, int columns = 240,
                             int rows = 480) {
  ColumnCamera camera;
  camera.centreOfProjection = centre;
  camera.fovRadians = radians(60);
  camera.lowAzimuth = radians(middleDegrees - 30);
  camera.topElevation = radians(60);
  camera.bottomElevation = -radians(60);
  camera.columns = columns;
  camera.rows = rows;
  return camera;
}

inline double shareOfDifferentPixels(const Canvas& a, const Canvas& b) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    differing += (a.pixels[i] & 0xffffffff) != (b.pixels[i] & 0xffffffff);
  return static_cast<double>(differing) / static_cast<double>(a.pixels.size());
}

}  // namespace acentric::test
