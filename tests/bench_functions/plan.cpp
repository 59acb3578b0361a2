/// What it costs to send a plan of many regions to the graphics card, and to draw a frame of it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/layout/layout.h"
#include "tests/bench_functions/benches.h"
#include "tests/ui/offscreen.h"
#include "ui/mark_mesh.h"
#include "ui/polygon_mesh.h"

namespace acentric::bench {
namespace {

using namespace ui;

constexpr int kWidth = 670, kHeight = 590;

LayoutSpec specWith(std::size_t regions) {
  LayoutSpec spec;
  const double half = 0.5 * std::sqrt(double(regions) * spec.cellSize * spec.cellSize * 3.464 / 3);
  spec.outline.loops = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  return spec;
}

}  // namespace

Status benchPlan(const Subject& subject, Figures& figures) {
  ui::test::Offscreen screen(kWidth, kHeight);
  if (!screen.works()) return fail(ErrorKind::unsupported, "no OpenGL here");
  const auto layout = buildLayout(specWith(subject.planRegions));
  if (!layout) return tl::unexpected(layout.error());
  figures.fact("regions", layout->regions.size());
  figures.fact("cameras", layout->cameras.size());

  std::vector<glm::dvec2> corners;
  std::vector<std::uint32_t> ends;
  for (const Region& region : layout->regions) {
    corners.insert(corners.end(), region.polygon.corners.begin(), region.polygon.corners.end());
    ends.push_back(std::uint32_t(corners.size()));
  }
  std::vector<CanvasMark> marks;
  for (const LayoutCamera& camera : layout->cameras)
    marks.push_back({camera.position, float(camera.lowAzimuth), float(camera.fovRadians)});
  PolygonMesh regions;
  MarkMesh cameras;
  figures.add("send the shapes", "ms",
              scaled(secondsOf(5,
                               [&] {
                                 regions.setShapes(corners, ends);
                                 cameras.setPlaces(marks);
                                 glFinish();
                               }),
                     1e3));
  figures.add(
      "send the colours", "ms",
      scaled(secondsOf(
                 5,
                 [&] {
                   regions.setStyles(std::vector<PolygonStyle>(ends.size(), {0x30ffffff, 0xc0ffffff, 1.2F}));
                   cameras.setColours(std::vector<ImU32>(marks.size(), 0xffffffff));
                   glFinish();
                 }),
             1e3));

  for (const double cellPixels : {1.2, 3.0, 6.0, 12.0, 25.0, 80.0}) {
    CanvasView view;
    view.setArea({0, 0}, {kWidth, kHeight});
    const glm::dvec2 half = glm::dvec2(kWidth, kHeight) * (0.5 * layout->spec.cellSize / cellPixels);
    view.fit(-half, half, 0);
    const auto frames = secondsOf(12, [&] {
      view.panPixels({3, 2});
      screen.clear();
      regions.render(view, screen.target(), float(std::clamp((cellPixels - 3) / 6, 0.0, 1.0)));
      cameras.render(view, screen.target(),
                     {2, {0, 0, 0, 1}, 0, float(std::clamp((cellPixels - 6) / 10, 0.0, 1.0))});
      glFinish();
    });
    figures.add(fmt::format("a frame of 670x590, cells of {} pixels", cellPixels), "ms", scaled(frames, 1e3));
  }
  return {};
}

}  // namespace acentric::bench
