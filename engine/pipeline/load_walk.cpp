#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/pipeline.h"
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

/// Clips the scene to each region that `former` did not clip alike.
std::vector<LocalPtr> localGeometryFor(const OpenProject& open, const LoadedWalk* former, TaskRunner& runner,
                                       std::stop_token stop) {
  const auto& regions = open.layout->regions;
  std::vector<LocalPtr> local(regions.size());
  runner.parallelFor(regions.size(), [&](std::size_t r) {
    if (stop.stop_requested()) return;
    if (former && former->walk.scene == open.scene && former->walk.layout)
      if (const auto old = former->walk.layout->findRegion(regions[r].id);
          old && former->walk.layout->regions[std::size_t(*old)].grown.corners == regions[r].grown.corners)
        local[r] = former->walk.local[std::size_t(*old)];
    if (!local[r])
      local[r] = std::make_shared<const LocalGeometry>(clipToPolygon(*open.scene, regions[r].grown));
  });
  return local;
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
    std::mutex mutex;
    double done = 0;
    runner.parallelFor(open.keys.size(), [&](std::size_t i) {
      if (stop.stop_requested()) return;
      if (const auto found = known.find(open.keys[i]); found != known.end()) {
        walk.captures[i] = found->second;
      } else if (store->has(open.keys[i])) {
        const auto capture = store->get(open.keys[i]);
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
  walk.local = localGeometryFor(open, former, runner, stop);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "loading was cancelled", open.file.string());
  loaded.missing = int(std::count(walk.captures.begin(), walk.captures.end(), nullptr));
  return loaded;
}

glm::dvec3 clampToLayout(const Layout& layout, const glm::dvec3& eye) {
  return {clampToPlan(layout, glm::dvec2(eye)), eye.z};
}

}  // namespace acentric
