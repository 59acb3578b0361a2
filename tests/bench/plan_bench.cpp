/// Prints what it costs to send a plan of many regions to the graphics card, and to draw a frame of it.
///   plan_bench [REGIONS]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/stopwatch.h"
#include "engine/layout/layout.h"
#include "tests/ui/offscreen.h"
#include "ui/mark_mesh.h"
#include "ui/polygon_mesh.h"

namespace acentric::ui {
namespace {

constexpr int kWidth = 670, kHeight = 590;

LayoutSpec specWith(int regions) {
  LayoutSpec spec;
  const double half = 0.5 * std::sqrt(regions * spec.cellSize * spec.cellSize * 3.464 / 3);
  spec.outline.loops = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  return spec;
}

void run(int wanted) {
  test::Offscreen screen(kWidth, kHeight);
  if (!screen.works()) return fmt::print("no OpenGL here\n");
  const auto layout = buildLayout(specWith(wanted));
  if (!layout) return fmt::print("{}\n", layout.error().describe());
  fmt::print("{} regions, {} cameras, {} x {} pixels\n", layout->regions.size(), layout->cameras.size(),
             kWidth, kHeight);

  const Stopwatch sending;
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
  regions.setShapes(corners, ends);
  cameras.setPlaces(marks);
  glFinish();
  fmt::print("shapes sent in {:.1f} ms\n", 1e3 * sending.seconds());
  const Stopwatch colouring;
  regions.setStyles(std::vector<PolygonStyle>(ends.size(), {0x30ffffff, 0xc0ffffff, 1.2F}));
  cameras.setColours(std::vector<ImU32>(marks.size(), 0xffffffff));
  glFinish();
  fmt::print("colours sent in {:.1f} ms\n", 1e3 * colouring.seconds());

  for (const double cellPixels : {1.2, 3.0, 6.0, 12.0, 25.0, 80.0}) {
    CanvasView view;
    view.setArea({0, 0}, {kWidth, kHeight});
    const glm::dvec2 half = glm::dvec2(kWidth, kHeight) * (0.5 * layout->spec.cellSize / cellPixels);
    view.fit(-half, half, 0);
    double best = 1e9, sum = 0;
    constexpr int kFrames = 12;
    for (int frame = 0; frame < kFrames; ++frame) {
      view.panPixels({3, 2});
      screen.clear();
      glFinish();
      const Stopwatch watch;
      regions.render(view, screen.target(), float(std::clamp((cellPixels - 3) / 6, 0.0, 1.0)));
      cameras.render(view, screen.target(),
                     {2, {0, 0, 0, 1}, 0, float(std::clamp((cellPixels - 6) / 10, 0.0, 1.0))});
      const double called = watch.seconds();
      glFinish();
      best = std::min(best, watch.seconds());
      sum += called;
    }
    fmt::print("cells of {:4.1f} pixels: {:6.2f} ms a frame, of which calls {:.2f} ms\n", cellPixels,
               1e3 * best, 1e3 * sum / kFrames);
  }
}

}  // namespace
}  // namespace acentric::ui

int main(int argc, char** argv) { acentric::ui::run(argc > 1 ? std::atoi(argv[1]) : 100'000); }
