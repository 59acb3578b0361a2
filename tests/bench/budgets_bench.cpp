/// Seconds of counting triangles per region: the whole of a layout, and after one cell was moved.
///   budgets_bench MODEL [REGIONS] [NEAR_BAND]
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "engine/inspect/budgets.h"
#include "engine/scene/import.h"
#include "engine/scene/local_geometry.h"

using namespace acentric;

namespace {

template <class Work>
auto timed(const char* what, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  fmt::print("{:<44} {:9.2f} ms\n", what, spent.count());
  return result;
}

/// The scene's whole plan, with cells small enough for so many regions.
Layout layoutOver(const Scene& scene, std::size_t regions, double nearBand) {
  const glm::dvec2 low(scene.bounds.min), high(scene.bounds.max);
  LayoutSpec spec;
  spec.nearBand = nearBand;
  spec.outline.loops = {{low, {high.x, low.y}, high, {low.x, high.y}}};
  Layout layout;
  for (double cell = std::sqrt(2 * spec.outline.area() / double(regions)); layout.regions.size() < regions;
       cell *= 0.97) {
    spec.cellSize = cell;
    layout = buildLayout(spec).value();
  }
  return layout;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print("budgets_bench MODEL [REGIONS] [NEAR_BAND]\n");
    return 2;
  }
  const auto parsed = parseScene(argv[1], {});
  if (!parsed) {
    fmt::print("{}\n", parsed.error().describe());
    return 1;
  }
  const auto scene = std::make_shared<const Scene>(*parsed);
  const std::size_t regions = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000;
  const double nearBand = argc > 3 ? std::strtod(argv[3], nullptr) : 1.0;
  const Layout layout = layoutOver(*scene, regions, nearBand);
  TaskRunner runner(static_cast<int>(std::thread::hardware_concurrency()) - 1);
  fmt::print("{} triangles, {} regions of {:.3f} m, near band {} m, {} threads\n", scene->triangleCount(),
             layout.regions.size(), layout.spec.cellSize, nearBand, runner.threads());

  BudgetCounter counter = timed("prepare the scene", [&] { return BudgetCounter(scene); });
  const RegionBudgets all =
      timed("count every region", [&] { return counter.count(layout, runner).value(); });
  fmt::print("  least {}, median {}, most {}\n",
             *std::min_element(all.triangles.begin(), all.triangles.end()), all.median(), all.worst());
  timed("count again, nothing changed", [&] { return counter.count(layout, runner).value(); });

  // The cell goes from the middle of the scene, where most triangles are, to beyond its border.
  LayoutSpec moved = layout.spec;
  const glm::dvec2 middle(scene->bounds.centre());
  moved.removed.insert(cellAt(moved, middle).id);
  moved.added.insert(cellAt(moved, glm::dvec2(scene->bounds.max) + glm::dvec2(moved.cellSize)).id);
  const Layout after = timed("lay the regions out again", [&] { return buildLayout(moved).value(); });
  const RegionBudgets changed =
      timed("count after one cell moved outside", [&] { return counter.count(after, runner).value(); });
  fmt::print("  {} regions counted\n", changed.counted);
  // And back to a place of its own in the densest part, never counted before.
  LayoutSpec inside = layout.spec;
  inside.latticeOrigin += glm::dvec2(0.013, 0.007);
  const auto dense = all.over(0).front();
  const ConvexPolygon polygon = cellPolygon(inside, layout.regions[std::size_t(dense)].id).grown(nearBand);
  const TriangleTree tree(scene);
  const std::size_t counted =
      timed("count the densest cell anew", [&] { return tree.countClipped(polygon); });
  const std::size_t clipped = timed("the same by clipping every triangle",
                                    [&] { return clipToPolygon(*scene, polygon).triangles.size(); });
  fmt::print("  {} and {} triangles\n", counted, clipped);
  return counted == clipped ? 0 : 1;
}
