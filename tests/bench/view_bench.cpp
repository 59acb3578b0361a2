/// Samples per second of the renderers on a load like a walk's: a hexagon ring, dense captures of 480
/// columns.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/render.h"
#include "engine/view/splats.h"
#include "engine/view/view_plan.h"
#include "engine/view/warp.h"
#include "tests/view/analytic_scene.h"

using namespace acentric;

namespace {

double best(int repeats, const std::function<void()>& work) {
  double seconds = 1e9;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds =
        std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds;
}

/// Bytes a second that two threads read from memory one after the other.
double readRate(TaskRunner& two, const LargeVector<PackedSample>& samples) {
  std::uint64_t sums[2] = {};
  const std::size_t half = samples.size() / 2;
  const double seconds = best(5, [&] {
    two.parallelFor(2, [&](std::size_t thread) {
      std::uint64_t sum = 0;
      for (std::size_t i = thread * half; i < (thread + 1) * half; ++i)
        sum += samples[i].inverseDistanceAndRoles;
      sums[thread] += sum;
    });
  });
  if (sums[0] + sums[1] == 0) fmt::print("no samples\n");  // so that the sums are wanted
  return static_cast<double>(samples.size() * sizeof(PackedSample)) / seconds;
}

/// Projects columns of a wall some metres away, four of five samples on the picture: data that stay in the
/// processor's caches, and data that come from memory.
void timeProjecting() {
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
                             static_cast<std::uint16_t>(300 + i % kPerColumn * 840 / kPerColumn), {3, -4});
    const double read = readRate(two, packed);
    ProjectColumn column{};
    column.a[0] = 640, column.a[1] = 360, column.a[2] = 1;
    column.z[1] = -1108;
    column.b[0] = 100, column.b[1] = 50, column.b[2] = 0.2f;
    column.maxInverseDistance = 10, column.footprint = 1.21f, column.maxSide = 16, column.roles = 4;
    column.across[0] = 0.5f, column.acrossStep = column.downStep = 0.0005f, column.perSpread = 4.4f;
    column.centreX = 640, column.centreY = 360, column.inverseFocal = 1 / 1108.0f;
    column.x1 = 1280, column.y1 = 720, column.slot = 1;
    SplatMemory memory[2];
    for (const Kernels& kernels : supportedKernels())
      for (const bool slanted : {false, true})
        for (const std::size_t threads : {std::size_t(1), std::size_t(2)}) {
          column.slanted = slanted;
          std::size_t kept[2] = {};
          const SampleRun run{0, kPerColumn};
          const auto project = [&](std::size_t thread) {
            kept[thread] = 0;
            for (std::size_t c = thread * columns / threads; c < (thread + 1) * columns / threads; ++c) {
              const std::size_t first = c * kPerColumn;
              const SampleColumn from = sampleColumn(tangents.data(), &packed[first], &colour[first]);
              kept[thread] += static_cast<std::size_t>(
                  kernels.project(column, from, &run, 1, memory[thread].room(kPerColumn)));
            }
          };
          const int repeats = static_cast<int>(40000 / columns);
          const double seconds =
              best(repeats, [&] { threads == 1 ? project(0) : two.parallelFor(2, project); });
          const double rate = static_cast<double>(samples) / seconds;
          fmt::print(
              "projecting {:>10} samples, {:8} {:10} {} thread{}: {:5.0f} M samples/s, {:5.1f} GB/s, {:3.0f} "
              "% "
              "of what two threads read, {:.0f} % on the picture\n",
              samples, kernels.name, slanted ? "rectangles" : "squares", threads, threads > 1 ? "s" : " ",
              rate * 1e-6, rate * kBytes * 1e-9, 100 * rate * kBytes / read,
              100.0 * static_cast<double>(kept[0] + kept[1]) / static_cast<double>(samples));
        }
  }
}

/// Frames of an empty room and boxes, at so many samples per degree.
void timeFrames(double perDegree, int layers, int width, int height) {
  fmt::print("{}x{}, {} samples per degree, {} layer{}\n", width, height, perDegree, layers,
             layers > 1 ? "s" : "");
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
    if (!plan) return;
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
      options.findBlocks = c.kernels.findBlocks;
      options.depthTest = c.depthTest;
      Canvas canvas;
      clearCanvas(scene, view, settings, *plan, 0, view.width, canvas);
      WarpCounts counts;
      const double seconds = best(
          20, [&] { counts = warpPieces(scene, view, settings, *plan, options, 0, view.width, canvas); });
      fmt::print(
          "{} pieces, {:12} one thread: {:6.2f} ms, {} read, {} drawn, {:.0f} M drawn/s, {:.0f} M read/s\n",
          plan->pieces.size(), c.name, seconds * 1e3, counts.samplesRead, counts.samplesDrawn,
          static_cast<double>(counts.samplesDrawn) / seconds * 1e-6,
          static_cast<double>(counts.samplesRead) / seconds * 1e-6);
    }
    TaskRunner two(1);
    FrameMemory memory;
    for (const auto& [renderer, reconstruction] : {std::pair(Renderer::scalar, Reconstruction::splat),
                                                   std::pair(Renderer::list, Reconstruction::splat),
                                                   std::pair(Renderer::zbuffer, Reconstruction::splat),
                                                   std::pair(Renderer::list, Reconstruction::point),
                                                   std::pair(Renderer::scalar, Reconstruction::filtered),
                                                   std::pair(Renderer::list, Reconstruction::filtered)}) {
      settings.renderer = renderer;
      settings.reconstruction = reconstruction;
      settings.fillHoles = true;
      FrameStats stats;
      std::size_t holes = 0;
      const double seconds = best(10, [&] {
        auto frame = renderFrame(scene, view, settings, two, memory);
        stats = frame->stats;
        holes = frame->holeCount();
        memory.frame = std::move(*frame);
      });
      fmt::print("frame {} {} 2 threads {:.2f} ms (warp {:.2f}, fill {:.2f}), {} holes\n", nameOf(renderer),
                 nameOf(reconstruction), seconds * 1e3, stats.warpSeconds * 1e3, stats.fillSeconds * 1e3,
                 holes);
    }
  }
}

}  // namespace

int main() {
  timeProjecting();
  timeFrames(8, 1, 960, 540);
  timeFrames(20, 3, 1280, 720);
}
