#include "engine/pipeline/check_store.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <ranges>

#include "engine/inspect/budgets.h"
#include "engine/pipeline/bake_plan.h"
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
  if (Status fits = simplified.check(open.drawn->scene()); !fits) return fits.error();
  if (simplified.report.after != simplified.triangles.size())
    return Error{ErrorKind::malformed,
                 "says that it has " + std::to_string(simplified.report.after) + " triangles, and has " +
                     std::to_string(simplified.triangles.size()),
                 {}};
  return std::nullopt;
}

/// A capture or the surface light that is looked at.
struct Wanted {
  const PlannedCapture* planned = nullptr;
  bool coarse = false;
};

struct Found {
  bool there = false, recorded = false;
  std::vector<std::string> problems;
};

/// Files that a record names and that are gone.
void addGone(const CaptureStore& store, const ContentKey& key, const CaptureRecord& record, Found& found) {
  for (const FileRecord& file : record.files) {
    const std::filesystem::path path = store.fileOf(key, file.extension);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      found.problems.push_back(path.string() + ": was baked and is gone; bake again");
  }
}

Found look(const CaptureStore& store, const PlannedCapture& planned, const std::stop_token& stop) {
  Found found;
  const auto inspected = store.inspect(planned.key, true, stop);
  if (!inspected) {
    found.problems.push_back(inspected.error().describe());
    return found;
  }
  found.there = inspected->condition != CaptureStore::Condition::missing;
  found.recorded = inspected->recorded;
  for (const Error& error : inspected->damage) found.problems.push_back(error.describe());
  if (inspected->recordDamage) found.problems.push_back(inspected->recordDamage->describe());
  const auto record = store.record(planned.key);
  if (record && !found.there) addGone(store, planned.key, *record, found);
  if (record && (record->parts != planned.parts || record->subject != planned.subject))
    found.problems.push_back(store.fileOf(planned.key, ".record").string() +
                             ": is the record of another key");
  return found;
}

/// The plans of the qualities below the full one.
std::vector<StoreyPlan> lowerPlans(const OpenProject& open) {
  std::vector<StoreyPlan> plans;
  for (const Quality quality : kQualities | std::views::reverse)
    if (quality != Quality::full) plans.push_back(planStorey(atQuality(open, quality)));
  return plans;
}

/// Of each camera its capture and, if that is not there, the best of lower quality; then the light.
std::vector<Wanted> wantedOf(const StoreyPlan& plan, const std::vector<StoreyPlan>& lower,
                             const CaptureStore& store) {
  std::vector<Wanted> wanted;
  for (std::size_t camera = 0; camera < plan.cameras.size(); ++camera) {
    wanted.push_back({&plan.cameras[camera], false});
    if (store.has(plan.cameras[camera].key)) continue;
    for (const StoreyPlan& coarser : lower)
      if (store.has(coarser.cameras[camera].key)) {
        wanted.push_back({&coarser.cameras[camera], true});
        break;
      }
  }
  wanted.push_back({&plan.light, false});
  return wanted;
}

void add(const Wanted& wanted, const Found& found, bool isLight, StoreCheck& check) {
  if (isLight)
    check.surfaceLightMissing = !found.there;
  else if (wanted.coarse)
    check.coarse += found.there;
  else
    ++(found.there ? check.captures : check.capturesMissing);
  if (found.there && !found.recorded) ++check.withoutRecord;
  check.problems.insert(check.problems.end(), found.problems.begin(), found.problems.end());
}

/// Regions' simplified geometry, if there is any under the key.
Found lookAtRegion(const CaptureStore& store, const ContentKey& key, const OpenProject& open,
                   const std::stop_token& stop) {
  Found found;
  found.there = store.hasSimplified(key);
  if (!found.there) return found;
  for (const Error& error : store.check(key, stop)) found.problems.push_back(error.describe());
  if (!found.problems.empty()) return found;
  const auto simplified = store.getSimplified(key);
  const auto problem = simplified ? problemOf(*simplified, open) : simplified.error();
  if (problem) found.problems.push_back("simplified-" + key.toHex() + ".local: " + problem->describe());
  return found;
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
  if (!*store) {
    check.capturesMissing = open.keys.size();
    check.surfaceLightMissing = true;
    check.simplifiedMissing = std::size_t(
        std::ranges::count_if(budgets.triangles, [&](const auto triangles) { return triangles > limit; }));
    return check;
  }
  const StoreyPlan plan = planStorey(open);
  const std::vector<StoreyPlan> lower = lowerPlans(open);
  const std::vector<Wanted> wanted = wantedOf(plan, lower, **store);
  std::vector<Found> found(wanted.size() + budgets.triangles.size());
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(found.size(), [&](std::size_t n) {
    if (stop.stop_requested()) return;
    found[n] = n < wanted.size()
                   ? look(**store, *wanted[n].planned, stop)
                   : lookAtRegion(**store, simplifiedKey(open, regions[n - wanted.size()]), open, stop);
    const std::lock_guard lock(mutex);
    if (progress) progress({++done, double(found.size()), "checking what is baked"});
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "checking was cancelled", open.file.string());
  for (std::size_t n = 0; n < wanted.size(); ++n) add(wanted[n], found[n], n + 1 == wanted.size(), check);
  for (std::size_t region = 0; region < budgets.triangles.size(); ++region) {
    const Found& of = found[wanted.size() + region];
    if (of.there) ++check.simplified;
    if (!of.there && budgets.triangles[region] > limit) ++check.simplifiedMissing;
    check.problems.insert(check.problems.end(), of.problems.begin(), of.problems.end());
  }
  return check;
}

}  // namespace acentric
