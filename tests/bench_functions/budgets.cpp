/// Counting triangles per region: the whole of a layout, after one cell was moved, and by clipping every one.

#include <algorithm>
#include <cmath>

#include "engine/inspect/budgets.h"
#include "engine/scene/import.h"
#include "engine/scene/local_geometry.h"
#include "tests/bench_functions/benches.h"

namespace acentric::bench {
namespace {

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

Status benchBudgets(const Subject& subject, Figures& figures) {
  const auto parsed = parseScene(subject.model, {});
  if (!parsed) return tl::unexpected(parsed.error());
  const auto scene = std::make_shared<const Scene>(*parsed);
  const Layout layout = layoutOver(*scene, subject.regions, subject.nearBand);
  TaskRunner runner(subject.threads - 1);
  figures.fact("triangles", scene->triangleCount());
  figures.fact("regions", layout.regions.size());
  figures.fact("metres of a cell", layout.spec.cellSize);
  const auto once = [&](const char* what, const std::function<void()>& work) {
    figures.add(what, "ms", scaled(secondsOf(1, work), 1e3));
  };
  std::optional<BudgetCounter> counter;
  RegionBudgets all;
  once("prepare the scene", [&] { counter.emplace(scene); });
  once("count every region", [&] { all = counter->count(layout, runner).value(); });
  once("count again, nothing changed", [&] { (void)counter->count(layout, runner).value(); });
  figures.fact("least of a region", *std::ranges::min_element(all.triangles));
  figures.fact("median", all.median());
  figures.fact("most", all.worst());

  // The cell goes from the middle of the scene, where most triangles are, to beyond its border.
  LayoutSpec moved = layout.spec;
  moved.removed.insert(cellAt(moved, glm::dvec2(scene->bounds.centre())).id);
  moved.added.insert(cellAt(moved, glm::dvec2(scene->bounds.max) + glm::dvec2(moved.cellSize)).id);
  Layout after;
  once("lay the regions out again", [&] { after = buildLayout(moved).value(); });
  once("count after one cell moved", [&] {
    figures.fact("regions counted after one cell moved", counter->count(after, runner).value().counted);
  });
  // And a place of its own in the densest part, never counted before.
  LayoutSpec inside = layout.spec;
  inside.latticeOrigin += glm::dvec2(0.013, 0.007);
  const ConvexPolygon polygon =
      cellPolygon(inside, layout.regions[std::size_t(all.over(0).front())].id).grown(subject.nearBand);
  const TriangleTree tree(scene);
  std::size_t counted = 0, clipped = 0;
  const Turns turns = secondsByTurns(
      5, [&] { counted = tree.countClipped(polygon); },
      [&] { clipped = clipToPolygon(*scene, polygon).triangles.size(); });
  figures.add("count the densest cell", "ms", scaled(turns.one, 1e3), "clip every triangle",
              scaled(turns.other, 1e3));
  if (counted != clipped) return fail(ErrorKind::internal, "the counts of the densest cell differ");
  return {};
}

}  // namespace acentric::bench
