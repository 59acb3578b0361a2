#include "engine/pipeline/check_store.h"

#include <mutex>
#include <optional>

#include "engine/inspect/budgets.h"
#include "engine/pipeline/simplified_regions.h"

namespace acentric {
namespace {

/// The store, unless nothing was ever kept: checking makes no folder.
Result<std::optional<CaptureStore>> storeOf(const OpenProject& open) {
  const auto folder = captureFolderFor(open.file);
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return std::nullopt;
  auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  return std::optional(std::move(*store));
}

/// One region's simplified geometry: readable to the end, made for this region, fit for the scene, and as
/// many triangles as it says.
std::optional<Error> problemOf(const SimplifiedLocal& simplified, const OpenProject& open) {
  if (Status fits = simplified.check(*open.scene); !fits) return fits.error();
  if (simplified.report.after != simplified.triangles.size())
    return Error{ErrorKind::malformed,
                 "says that it has " + std::to_string(simplified.report.after) + " triangles, and has " +
                     std::to_string(simplified.triangles.size()),
                 {}};
  return std::nullopt;
}

}  // namespace

Result<StoreCheck> checkStore(const OpenProject& open, TaskRunner& runner, const Progress& progress,
                              std::stop_token stop) {
  const auto store = storeOf(open);
  if (!store) return tl::unexpected(store.error());
  StoreCheck check;
  const auto& regions = open.layout->regions;
  RegionBudgets budgets;
  std::size_t limit = 0;
  if (open.project.budget.simplifies()) {
    limit = std::size_t(open.project.budget.trianglesPerRegion);
    auto counted = countRegions(TriangleTree(open.scene), *open.layout, runner, progress, stop);
    if (!counted) return tl::unexpected(counted.error());
    budgets = std::move(*counted);
  }
  const std::size_t captures = open.keys.size(), total = captures + 1 + budgets.triangles.size();
  std::vector<std::vector<std::string>> problems(total);
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(total, [&](std::size_t n) {
    if (stop.stop_requested()) return;
    const bool isCapture = n<captures, isRegion = n> captures;
    const ContentKey key = isCapture  ? open.keys[n]
                           : isRegion ? simplifiedKey(open, regions[n - captures - 1])
                                      : open.surfaceLightKey;
    const bool there = *store && (isCapture ? (*store)->has(key) : !isRegion || (*store)->hasSimplified(key));
    if (there) {
      for (const Error& error : (*store)->check(key)) problems[n].push_back(error.describe());
      if (isRegion && problems[n].empty()) {
        const auto simplified = (*store)->getSimplified(key);
        const auto problem = simplified ? problemOf(*simplified, open) : simplified.error();
        if (problem) problems[n].push_back("simplified-" + key.toHex() + ".local: " + problem->describe());
      }
    }
    const std::lock_guard lock(mutex);
    if (isCapture) ++(there ? check.captures : check.capturesMissing);
    if (isRegion && there) ++check.simplified;
    if (isRegion && !there && budgets.triangles[n - captures - 1] > limit) ++check.simplifiedMissing;
    if (progress) progress({++done, double(total), "checking what is baked"});
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "checking was cancelled", open.file.string());
  for (auto& each : problems) check.problems.insert(check.problems.end(), each.begin(), each.end());
  return check;
}

}  // namespace acentric
