#include "engine/inspect/budgets.h"

#include <algorithm>
#include <functional>
#include <mutex>

namespace acentric {
namespace {

/// Polygons of former layouts that are remembered beside the present one's, so that undoing is free.
constexpr std::size_t kRememberedLayouts = 4, kRememberedAtLeast = 4096;

ContentKey keyOf(const ConvexPolygon& polygon) {
  return Hasher().array(std::span<const glm::dvec2>(polygon.corners)).finish();
}

/// Calls `store(n, count)` for each polygon; returns how many were counted before a stop.
std::size_t countEach(const TriangleTree& tree, std::size_t count,
                      const std::function<const ConvexPolygon&(std::size_t)>& polygon,
                      const std::function<void(std::size_t, std::size_t)>& store, TaskRunner& runner,
                      const Progress& progress, const std::stop_token& stop) {
  std::mutex mutex;
  std::size_t done = 0;
  runner.parallelFor(count, [&](std::size_t n) {
    if (stop.stop_requested()) return;
    store(n, tree.countClipped(polygon(n)));
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress({double(done), double(count), "counting triangles per region"});
  });
  return done;
}

tl::unexpected<Error> cancelled() { return fail(ErrorKind::cancelled, "counting triangles was cancelled"); }

}  // namespace

std::size_t RegionBudgets::worst() const {
  return triangles.empty() ? 0 : *std::ranges::max_element(triangles);
}

std::size_t RegionBudgets::median() const {
  if (triangles.empty()) return 0;
  std::vector<std::size_t> sorted = triangles;
  const auto middle = sorted.begin() + std::ptrdiff_t((sorted.size() - 1) / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

std::vector<int> RegionBudgets::over(std::size_t limit) const {
  std::vector<int> found;
  for (std::size_t r = 0; r < triangles.size(); ++r)
    if (triangles[r] > limit) found.push_back(static_cast<int>(r));
  std::ranges::stable_sort(found, std::greater{}, [&](int r) { return triangles[std::size_t(r)]; });
  return found;
}

Result<RegionBudgets> countRegions(const TriangleTree& tree, const Layout& layout, TaskRunner& runner,
                                   const Progress& progress, std::stop_token stop) {
  RegionBudgets budgets;
  const std::size_t regions = layout.regions.size();
  budgets.triangles.resize(regions);
  const auto polygon = [&](std::size_t n) -> const ConvexPolygon& { return layout.regions[n].grown; };
  const auto store = [&](std::size_t n, std::size_t triangles) { budgets.triangles[n] = triangles; };
  budgets.counted = countEach(tree, regions, polygon, store, runner, progress, stop);
  if (budgets.counted < regions) return cancelled();
  return budgets;
}

BudgetCounter::BudgetCounter(ScenePtr scene) : tree_(std::move(scene)) {}

Result<RegionBudgets> BudgetCounter::count(const Layout& layout, TaskRunner& runner, const Progress& progress,
                                           std::stop_token stop) {
  ++counts_;
  struct Open {
    std::size_t region;
    Known* entry;
  };
  RegionBudgets budgets;
  std::vector<const Known*> entries;
  std::vector<Open> open;
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const auto [at, isNew] = known_.try_emplace(keyOf(layout.regions[r].grown));
    if (isNew) open.push_back({r, &at->second});
    at->second.usedIn = counts_;
    entries.push_back(&at->second);
  }
  std::vector<char> finished(open.size(), 0);
  const auto polygon = [&](std::size_t n) -> const ConvexPolygon& {
    return layout.regions[open[n].region].grown;
  };
  const auto store = [&](std::size_t n, std::size_t triangles) {
    open[n].entry->triangles = triangles;
    finished[n] = 1;
  };
  if (countEach(tree_, open.size(), polygon, store, runner, progress, stop) < open.size()) {
    for (std::size_t n = 0; n < open.size(); ++n)
      if (!finished[n]) known_.erase(keyOf(polygon(n)));
    return cancelled();
  }
  for (const Known* entry : entries) budgets.triangles.push_back(entry->triangles);
  budgets.counted = open.size();
  forgetOld(layout.regions.size());
  return budgets;
}

void BudgetCounter::forgetOld(std::size_t regions) {
  const std::size_t most = std::max(kRememberedLayouts * regions, kRememberedAtLeast);
  for (std::uint64_t keep = 2; known_.size() > most && keep-- > 0;)
    std::erase_if(known_, [&](const auto& entry) { return entry.second.usedIn + keep < counts_; });
}

std::vector<std::size_t> countLocalTriangles(const Scene& scene, const Layout& layout) {
  const TriangleTree tree(ScenePtr(ScenePtr{}, &scene));
  std::vector<std::size_t> counts;
  for (const Region& region : layout.regions) counts.push_back(tree.countClipped(region.grown));
  return counts;
}

}  // namespace acentric
