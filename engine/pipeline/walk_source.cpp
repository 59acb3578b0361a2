#include "engine/pipeline/walk_source.h"

#include <algorithm>
#include <map>
#include <utility>

#include "engine/pipeline/simplified_regions.h"
#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

using CapturePtr = std::shared_ptr<const DisplayCapture>;
using LocalPtr = std::shared_ptr<const LocalGeometry>;

class StoreSource final : public WalkSource {
 public:
  StoreSource(OpenProject open, std::optional<CaptureStore> store,
              std::vector<std::optional<ContentKey>> best, std::shared_ptr<const SurfaceLight> light)
      : open_(std::move(open)), store_(std::move(store)), light_(std::move(light)) {
    const auto previews = atQuality(open_, Quality::preview).keys;
    for (std::size_t c = 0; c < best.size(); ++c) {
      full_.push_back(find(best[c]));
      coarse_.push_back(best[c] == previews[c] ? File{} : find(previews[c]));
    }
  }

  std::uint64_t storedBytes(int camera, Detail detail) const override { return fileOf(camera, detail).bytes; }

  Result<Capture> capture(int camera, Detail detail) const override {
    return store_->get(fileOf(camera, detail).key);
  }

  LocalPart local(int region, const std::stop_token& stop) const override {
    LocalPart part;
    const Region& shape = open_.layout->regions[std::size_t(region)];
    const TriangleBudget& budget = open_.project.budget;
    const bool simplifies = budget.simplifies() && store_;
    const auto clip = [&] {
      part.geometry = std::make_shared<const LocalGeometry>(clipToPolygon(*open_.drawn, shape.grown));
    };
    if (!simplifies || !store_->hasSimplified(simplifiedKey(open_, shape))) clip();
    if (!simplifies ||
        (part.geometry && part.geometry->triangles.size() <= std::size_t(budget.trianglesPerRegion)))
      return part;
    auto made = simplifiedRegion(open_, region, part.geometry, light_, *store_, stop);
    if (made) {
      part.geometry = made->geometry;
      part.simplified = {region, made->report, made->fromStore};
      if (made->notKept) part.warnings.push_back(made->notKept->describe());
    } else if (made.error().kind != ErrorKind::cancelled) {
      part.warnings.push_back("a region above the budget was not simplified: " + made.error().describe());
      if (!part.geometry) clip();
    }
    return part;
  }

 private:
  struct File {
    ContentKey key;
    std::uint64_t bytes = 0;
  };
  File find(const std::optional<ContentKey>& key) const {
    return key && store_ && store_->has(*key) ? File{*key, store_->bytesOf(*key)} : File{};
  }
  const File& fileOf(int camera, Detail detail) const {
    return (detail == Detail::full ? full_ : coarse_)[std::size_t(camera)];
  }

  OpenProject open_;
  std::optional<CaptureStore> store_;
  std::shared_ptr<const SurfaceLight> light_;
  std::vector<File> full_, coarse_;  ///< by camera
};

/// What `former` has for a region of the same polygon.
LocalPtr formerLocal(const OpenProject& open, const LoadedWalk& former, const Region& region,
                     LoadedWalk& walk) {
  const auto old = former.walk.layout->findRegion(region.id);
  if (!old || former.walk.layout->regions[std::size_t(*old)].grown.corners != region.grown.corners)
    return nullptr;
  const LocalPtr& local = former.walk.local[std::size_t(*old)];
  // Simplified geometry carries the light it was made with.
  const bool sameLight =
      former.surfaceLightKey == open.surfaceLightKey && former.walk.surfaceLight != nullptr;
  if (!local || former.budget != open.project.budget || (local->surfaces && !sameLight)) return nullptr;
  const auto known = std::ranges::find(former.simplified, *old, &LoadedWalk::Simplified::region);
  if (known != former.simplified.end())
    walk.simplified.push_back({int(&region - open.layout->regions.data()), known->report, known->fromStore});
  return local;
}

/// Captures and local geometry of `former` that are still what they would be.
void takeFormer(const OpenProject& open, const LoadedWalk& former, LoadedWalk& walk) {
  std::map<ContentKey, CapturePtr> known;
  if (former.walk.exposure == walk.walk.exposure)
    for (std::size_t i = 0; i < former.keys.size(); ++i)
      if (former.walk.captures[i] && !former.standsIn[i]) known[former.keys[i]] = former.walk.captures[i];
  for (std::size_t i = 0; i < walk.keys.size(); ++i)
    if (const auto found = known.find(walk.keys[i]); found != known.end())
      walk.walk.captures[i] = found->second;
  if (former.walk.scene != open.drawn->sharedScene() || !former.walk.layout) return;
  for (std::size_t r = 0; r < open.layout->regions.size(); ++r)
    walk.walk.local[r] = formerLocal(open, former, open.layout->regions[r], walk);
}

}  // namespace

Result<WalkStart> startWalk(const OpenProject& open, const LoadedWalk* former) {
  if (Status near = checkNear(open.near); !near) return tl::unexpected(near.error());
  WalkStart start;
  LoadedWalk& loaded = start.walk;
  loaded.keys = open.keys;
  loaded.surfaceLightKey = open.surfaceLightKey;
  loaded.budget = open.project.budget;
  WalkScene& walk = loaded.walk;
  walk.scene = open.drawn->sharedScene();
  walk.layout = open.layout;
  walk.plan = open.plan;
  walk.mirrors = open.mirrors;
  walk.exposure = open.project.exposure;
  walk.captures.resize(open.keys.size());
  walk.local.resize(open.layout->regions.size());
  loaded.standsIn.assign(open.keys.size(), false);

  // A project that simplifies keeps the result; nothing else makes a folder where nothing was ever baked.
  std::optional<CaptureStore> store;
  std::error_code error;
  const std::filesystem::path folder = captureFolderFor(open.file);
  if (open.project.budget.simplifies() || std::filesystem::is_directory(folder, error)) {
    auto opened = CaptureStore::open(folder);
    if (!opened) return tl::unexpected(opened.error());
    store = std::move(*opened);
  }
  std::vector<std::optional<ContentKey>> best(open.keys.size());
  if (store) best = bestKeys(open, *store);
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (!best[i]) ++loaded.missing;
    if (best[i] && *best[i] != open.keys[i]) ++loaded.coarse;
    loaded.keys[i] = best[i].value_or(open.keys[i]);
  }
  if (const ContentKey first = firstLightKey(open.surfaceLightKey);
      store && !store->hasSurfaceLight(open.surfaceLightKey) && store->hasSurfaceLight(first))
    loaded.surfaceLightKey = first;
  if (former && former->surfaceLightKey == loaded.surfaceLightKey && former->walk.surfaceLight) {
    walk.surfaceLight = former->walk.surfaceLight;
  } else if (store && store->hasSurfaceLight(loaded.surfaceLightKey)) {
    auto light = store->getSurfaceLight(loaded.surfaceLightKey);
    if (light)
      walk.surfaceLight = std::make_shared<const SurfaceLight>(std::move(*light));
    else
      loaded.warnings.push_back(light.error().describe());
  }
  if (former) {
    loaded.captureMemory = former->captureMemory;
    takeFormer(open, *former, loaded);
  }
  // What is simplified is kept on disk: only with light that is whole.
  const bool whole = loaded.surfaceLightKey == open.surfaceLightKey;
  start.source = std::make_shared<const StoreSource>(open, std::move(store), std::move(best),
                                                     whole ? walk.surfaceLight : nullptr);
  return start;
}

}  // namespace acentric
