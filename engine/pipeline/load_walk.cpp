#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>

#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/simplified_regions.h"
#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

using CapturePtr = std::shared_ptr<const DisplayCapture>;
using LocalPtr = std::shared_ptr<const LocalGeometry>;

std::map<ContentKey, CapturePtr> capturesOf(const LoadedWalk* former, float exposure) {
  std::map<ContentKey, CapturePtr> known;
  if (former && former->walk.exposure == exposure)
    for (std::size_t i = 0; i < former->keys.size(); ++i)
      if (former->walk.captures[i]) known[former->keys[i]] = former->walk.captures[i];
  return known;
}

/// What `former` has for a region of the same polygon.
LocalPtr formerLocal(const OpenProject& open, const LoadedWalk* former, const Region& region) {
  if (!former || former->walk.scene != open.scene || !former->walk.layout) return nullptr;
  const auto old = former->walk.layout->findRegion(region.id);
  if (!old || former->walk.layout->regions[std::size_t(*old)].grown.corners != region.grown.corners)
    return nullptr;
  const LocalPtr& local = former->walk.local[std::size_t(*old)];
  // Simplified geometry carries the light it was made with.
  const bool sameBudget = former->budget == open.project.budget;
  const bool sameLight =
      former->surfaceLightKey == open.surfaceLightKey && former->walk.surfaceLight != nullptr;
  return local && (local->surfaces ? sameBudget && sameLight : sameBudget) ? local : nullptr;
}

/// Clips the scene to each region that `former` did not clip alike. Regions whose simplified geometry is in
/// the store stay null.
std::vector<LocalPtr> localGeometryFor(const OpenProject& open, const LoadedWalk* former,
                                       const std::optional<CaptureStore>& store, TaskRunner& runner,
                                       std::stop_token stop) {
  const auto& regions = open.layout->regions;
  std::vector<LocalPtr> local(regions.size());
  runner.parallelFor(regions.size(), [&](std::size_t r) {
    if (stop.stop_requested()) return;
    local[r] = formerLocal(open, former, regions[r]);
    if (!local[r] && !(store && store->hasSimplified(simplifiedKey(open, regions[r]))))
      local[r] = std::make_shared<const LocalGeometry>(clipToPolygon(*open.scene, regions[r].grown));
  });
  return local;
}

/// Simplifies the regions above the budget, or takes them from the store. Says so in `loaded`; a region that
/// cannot be simplified stays whole.
void simplifyOverBudget(const OpenProject& open, const LoadedWalk* former, const CaptureStore& store,
                        LoadedWalk& loaded, TaskRunner& runner, const Progress& progress,
                        const std::stop_token& stop) {
  std::vector<std::size_t> over;
  for (std::size_t r = 0; r < loaded.walk.local.size(); ++r) {
    const LocalPtr& local = loaded.walk.local[r];
    if (local && local->surfaces) {
      const int old = *former->walk.layout->findRegion(open.layout->regions[r].id);
      const auto known = std::ranges::find(former->simplified, old, &LoadedWalk::Simplified::region);
      if (known != former->simplified.end())
        loaded.simplified.push_back({int(r), known->report, known->fromStore});
    } else if (!local || local->triangles.size() > std::size_t(open.project.budget.trianglesPerRegion)) {
      over.push_back(r);
    }
  }
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(over.size(), [&](std::size_t n) {
    if (stop.stop_requested()) return;
    LocalPtr& local = loaded.walk.local[over[n]];
    auto made = simplifiedRegion(open, int(over[n]), local, loaded.walk.surfaceLight, store, stop);
    if (!made && !local)
      local = std::make_shared<const LocalGeometry>(
          clipToPolygon(*open.scene, open.layout->regions[over[n]].grown));
    const std::lock_guard lock(mutex);
    if (made) {
      local = made->geometry;
      loaded.simplified.push_back({int(over[n]), made->report, made->fromStore});
      if (made->notKept) loaded.warnings.push_back(made->notKept->describe());
    } else if (made.error().kind != ErrorKind::cancelled) {
      loaded.warnings.push_back("a region above the budget was not simplified: " + made.error().describe());
    }
    if (progress) progress({++done, double(over.size()), "simplifying regions above the triangle budget"});
  });
  std::ranges::sort(loaded.simplified, {}, &LoadedWalk::Simplified::region);
}

/// One line: never a walk through simplified geometry without a word.
void reportSimplified(LoadedWalk& loaded) {
  std::size_t before = 0, after = 0, above = 0, beyond = 0;
  double error = 0;
  for (const LoadedWalk::Simplified& s : loaded.simplified) {
    before += s.report.before, after += s.report.after;
    above += s.report.withinBudget ? 0 : 1, beyond += s.report.withinError ? 0 : 1;
    error = std::max(error, s.report.maxError);
  }
  if (loaded.simplified.empty()) return;
  std::string line = fmt::format(
      "the local geometry of {} regions is simplified: {} triangles became {}, the surfaces lie at most "
      "{:.2g} mm "
      "apart",
      loaded.simplified.size(), before, after, 1e3 * error);
  if (above > 0)
    line += fmt::format("; {} of them are still above the budget, because the error allows no more", above);
  if (beyond > 0) line += fmt::format("; {} of them exceed the error", beyond);
  loaded.warnings.push_back(std::move(line));
}

}  // namespace

Result<LoadedWalk> loadWalk(const OpenProject& open, const LoadedWalk* former, TaskRunner& runner,
                            const Progress& progress, std::stop_token stop) {
  LoadedWalk loaded;
  loaded.keys = open.keys;
  loaded.surfaceLightKey = open.surfaceLightKey;
  WalkScene& walk = loaded.walk;
  walk.scene = open.scene;
  walk.layout = open.layout;
  walk.plan = open.plan;
  walk.exposure = open.project.exposure;
  walk.captures.resize(open.keys.size());

  const std::filesystem::path folder = captureFolderFor(open.file);
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) {
    const auto store = CaptureStore::open(folder);
    if (!store) return tl::unexpected(store.error());
    const auto known = capturesOf(former, walk.exposure);
    const auto best = bestKeys(open, *store);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (best[i]) loaded.keys[i] = *best[i];
    std::mutex mutex;
    double done = 0;
    runner.parallelFor(open.keys.size(), [&](std::size_t i) {
      if (stop.stop_requested()) return;
      if (const auto found = known.find(loaded.keys[i]); found != known.end()) {
        walk.captures[i] = found->second;
      } else if (best[i]) {
        const auto capture = store->get(*best[i]);
        if (capture)
          walk.captures[i] =
              std::make_shared<const DisplayCapture>(prepareForDisplay(*capture, walk.exposure));
        const std::lock_guard lock(mutex);
        if (!capture) loaded.warnings.push_back(capture.error().describe());
        if (progress) progress({++done, double(open.keys.size()), "loading captures"});
      }
    });
    if (former && former->surfaceLightKey == open.surfaceLightKey && former->walk.surfaceLight) {
      walk.surfaceLight = former->walk.surfaceLight;
    } else if (store->hasSurfaceLight(open.surfaceLightKey)) {
      auto light = store->getSurfaceLight(open.surfaceLightKey);
      if (light)
        walk.surfaceLight = std::make_shared<const SurfaceLight>(std::move(*light));
      else
        loaded.warnings.push_back(light.error().describe());
    }
  }
  loaded.budget = open.project.budget;
  std::optional<CaptureStore> simplifiedStore;
  if (open.project.budget.simplifies()) {
    auto store = CaptureStore::open(folder);
    if (!store) return tl::unexpected(store.error());
    simplifiedStore = std::move(*store);
  }
  walk.local = localGeometryFor(open, former, simplifiedStore, runner, stop);
  if (simplifiedStore && !stop.stop_requested())
    simplifyOverBudget(open, former, *simplifiedStore, loaded, runner, progress, stop);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "loading was cancelled", open.file.string());
  reportSimplified(loaded);
  loaded.missing = int(std::count(walk.captures.begin(), walk.captures.end(), nullptr));
  for (std::size_t i = 0; i < walk.captures.size(); ++i)
    loaded.coarse += walk.captures[i] && loaded.keys[i] != open.keys[i] ? 1 : 0;
  return loaded;
}

std::string coarseText(const LoadedWalk& loaded) {
  if (loaded.coarse == 0) return {};
  return fmt::format("{} of {} cameras {} so far", loaded.coarse, loaded.keys.size(),
                     loaded.coarse == 1 ? "is a preview or a draft" : "are previews or drafts");
}

glm::dvec3 clampToLayout(const Layout& layout, const glm::dvec3& eye) {
  return {clampToPlan(layout, glm::dvec2(eye)), eye.z};
}

}  // namespace acentric
