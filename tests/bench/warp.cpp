/// Samples per second of the renderers on a load like a walk's: a hexagon ring, dense captures of 480
/// columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/render.h"
#include "engine/view/splats.h"
#include "engine/view/view_plan.h"
#include "engine/view/warp.h"
#include "tests/bench/benches.h"
#include "tests/view/analytic_scene.h"

namespace acentric::bench {
namespace {

/// Bytes a second that two threads read from memory one after the other.
double readRate(TaskRunner& two, const LargeVector<PackedSample>& samples) {
  std::uint64_t sums[2] = {};
  const std::size_t half = samples.size() / 2;
  const auto seconds = secondsOf(5, [&] {
    two.parallelFor(2, [&](std::size_t thread) {
      std::uint64_t sum = 0;
      for (std::size_t i = thread * half; i < (thread + 1) * half; ++i)
        sum += samples[i].inverseDistanceAndRoles;
      sums[thread] += sum;
    });
  });
  used(static_cast<double>(sums[0] + sums[1]));
  return static_cast<double>(samples.size() * sizeof(PackedSample)) / *std::ranges::min_element(seconds);
}

/// Projects columns of a wall some metres away, four of five samples on the picture: data that stay in the
/// processor's caches, and data that come from memory.
void timeProjecting(Figures& figures) {
  constexpr int kRows = 1400;
  constexpr std::size_t kPerColumn = 1000, kRoom = 64, kBytes = sizeof(PackedSample) + sizeof(Rgba8);
  TaskRunner two(1);
  std::vector<float> tangents;
  for (int row = 0; row < kRows; ++row)
    tangents.push_back(static_cast<float>(std::tan(radians(30 - row / 20.0))));
  for (const std::size_t columns : {20u, 20000u}) {
    const std::size_t samples = columns * kPerColumn;
    LargeVector<PackedSample> packed(samples + kRoom);
    const LargeVector<Rgba8> colour(samples + kRoom, Rgba8{10, 20, 30, 255});
    for (std::size_t i = 0; i < samples; ++i)
      packed[i] = packSample(0.2f + 0.001f * static_cast<float>(i * 7 % 10), 0xff,
                             static_cast<std::uint16_t>(300 + i % kPerColumn * 840 / kPerColumn));
    const double read = readRate(two, packed);
    ProjectColumn column{};
    column.a[0] = 640, column.a[1] = 360, column.a[2] = 1;
    column.z[1] = -1108;
    column.b[0] = 100, column.b[1] = 50, column.b[2] = 0.2f;
    column.maxInverseDistance = 10, column.footprint = 1.21f, column.maxSide = 16, column.roles = 4;
    column.centreX = 640, column.centreY = 360, column.inverseFocal = 1 / 1108.0f;
    column.x1 = 1280, column.y1 = 720, column.slot = 1;
    SplatMemory memory[2];
    for (const Kernels& kernels : supportedKernels())
      for (const std::size_t threads : {std::size_t(1), std::size_t(2)}) {
        if (threads > 1 && columns < 100) continue;  // over before a second thread has woken
        std::size_t kept[2] = {};
        const auto project = [&](std::size_t thread) {
          kept[thread] = 0;
          for (std::size_t c = thread * columns / threads; c < (thread + 1) * columns / threads; ++c) {
            const std::size_t first = c * kPerColumn;
            const SampleColumn from = sampleColumn(tangents.data(), &packed[first], &colour[first]);
            kept[thread] += static_cast<std::size_t>(
                kernels.project(column, from, kPerColumn, memory[thread].room(kPerColumn)));
          }
        };
        const int repeats = static_cast<int>(std::min<std::size_t>(200, 40000 / columns));
        std::vector<double> rates;
        for (const double seconds :
             secondsOf(repeats, [&] { threads == 1 ? project(0) : two.parallelFor(2, project); }))
          rates.push_back(1e-6 * static_cast<double>(samples) / seconds);
        const std::string what = fmt::format("project {} samples, {}, {} thread{}", samples, kernels.name,
                                             threads, threads > 1 ? "s" : "");
        figures.add(what, "M/s", rates);
        figures.fact(what + ": share of what two threads read",
                     *std::ranges::max_element(rates) * 1e6 * kBytes / read);
      }
  }
}

/// Frames of an empty room and boxes, at so many samples per degree.
Status timeFrames(double perDegree, int layers, int width, int height, Figures& figures) {
  const std::string size =
      fmt::format("{}x{}, {}/degree, {} layer{}", width, height, perDegree, layers, layers > 1 ? "s" : "");
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const auto region = layout->regionAt({0, 0});
  const WalkScene scene = test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *region, perDegree, layers);
  PerspectiveView view;
  view.width = width, view.height = height;
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;

  for (bool secondary : {false, true}) {
    ViewSettings settings;
    settings.secondaryCover = secondary;
    const auto plan = planView(scene, view, settings);
    if (!plan) return tl::unexpected(plan.error());
    const std::string work = fmt::format("{}, {} pieces: ", size, plan->pieces.size());
    struct Case {
      std::string name;
      Kernels kernels;
      bool depthTest;
    };
    std::vector<Case> cases;
    for (const Kernels& kernels : supportedKernels()) cases.push_back({kernels.name, kernels, false});
    cases.push_back({"depth buffer", supportedKernels().back(), true});
    for (const Case& c : cases) {
      WarpOptions options;
      options.project = c.kernels.project;
      options.depthTest = c.depthTest;
      Canvas canvas;
      clearCanvas(scene, view, *plan, 0, view.width, canvas);
      WarpCounts counts;
      figures.add(work + "warp by " + c.name + ", 1 thread", "ms",
                  scaled(secondsOf(20,
                                   [&] {
                                     counts = warpPieces(scene, view, settings, *plan, options, 0, view.width,
                                                         canvas);
                                   }),
                         1e3));
      figures.fact(work + "samples read", counts.samplesRead);
      figures.fact(work + "samples drawn", counts.samplesDrawn);
    }
    TaskRunner two(1);
    FrameMemory memory;
    const auto draw = [&](Renderer renderer, Reconstruction reconstruction) {
      settings.renderer = renderer;
      settings.reconstruction = reconstruction;
      settings.fillHoles = true;
      auto frame = renderFrame(scene, view, settings, two, memory);
      memory.frame = std::move(*frame);
    };
    for (const Renderer other : {Renderer::scalar, Renderer::zbuffer}) {
      const Turns turns = secondsByTurns(
          10, [&] { draw(Renderer::list, Reconstruction::splat); },
          [&] { draw(other, Reconstruction::splat); });
      figures.add(fmt::format("{}frame, list splat, against {}", work, nameOf(other)), "ms",
                  scaled(turns.one, 1e3), nameOf(other), scaled(turns.other, 1e3));
    }
    figures.add(work + "frame, list point", "ms",
                scaled(secondsOf(10, [&] { draw(Renderer::list, Reconstruction::point); }), 1e3));
  }
  return {};
}

}  // namespace

Status benchWarp(const Subject&, Figures& figures) {
  timeProjecting(figures);
  if (Status timed = timeFrames(8, 1, 960, 540, figures); !timed) return timed;
  return timeFrames(20, 3, 1280, 720, figures);
}

}  // namespace acentric::bench
