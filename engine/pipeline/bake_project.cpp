#include <algorithm>
#include <mutex>
#include <numeric>

#include "engine/bake/surface_light_bake.h"
#include "engine/base/stopwatch.h"
#include "engine/pipeline/local_triangles.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {
namespace {

class StoreSink final : public CaptureSink {
 public:
  explicit StoreSink(const CaptureStore& store) : store_(store) {}
  bool has(const ContentKey& key) const override { return store_.has(key); }
  Status put(const ContentKey& key, const Capture& capture) override { return store_.put(key, capture); }

 private:
  const CaptureStore& store_;
};

/// Sets aside what is damaged of `keys`.
Result<std::vector<std::string>> verified(const CaptureStore& store, const std::vector<ContentKey>& keys,
                                          TaskRunner& runner, const Progress& progress,
                                          const std::stop_token& stop) {
  std::vector<std::string> damaged;
  std::optional<Error> trouble;
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(keys.size(), [&](std::size_t k) {
    if (stop.stop_requested()) return;
    const std::vector<Error> problems = store.setDamagedAside(keys[k]);
    const std::lock_guard lock(mutex);
    for (const Error& problem : problems) {
      if (problem.kind == ErrorKind::unreadable || problem.kind == ErrorKind::outOfSpace) trouble = problem;
      damaged.push_back(problem.describe());
    }
    if (progress) progress({++done, double(keys.size()), "reading what is baked"});
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the bake was stopped");
  if (trouble) return tl::unexpected(*trouble);
  std::ranges::sort(damaged);
  return damaged;
}

}  // namespace

void ProjectBakeReport::add(const ProjectBakeReport& other) {
  damaged.insert(damaged.end(), other.damaged.begin(), other.damaged.end());
  captures.cameras.clear();
  captures.baked += other.captures.baked;
  captures.reused += other.captures.reused;
  captures.seconds += other.captures.seconds;
  captures.samples += other.captures.samples;
  captures.rays += other.captures.rays;
  captures.eyeViews += other.captures.eyeViews;
  captures.eyeViewSeconds += other.captures.eyeViewSeconds;
  surfaceLightBaked = surfaceLightBaked || other.surfaceLightBaked;
  surfaceLightReused = surfaceLightReused || other.surfaceLightReused;
  surfaceLightSeconds += other.surfaceLightSeconds;
  bytes += other.bytes;
}

std::vector<int> bakingOrder(const OpenProject& open) {
  std::vector<int> order(open.layout->cameras.size());
  std::iota(order.begin(), order.end(), 0);
  const auto distance = [&](int camera) {
    return glm::distance(open.layout->cameras[std::size_t(camera)].position, open.project.spawn().position);
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return distance(a) < distance(b); });
  return order;
}

std::vector<bool> bakedCameras(const OpenProject& open) {
  std::vector<bool> baked(open.keys.size(), false);
  std::error_code error;
  if (!std::filesystem::is_directory(captureFolderFor(open.file), error)) return baked;
  const auto store = CaptureStore::open(captureFolderFor(open.file));
  if (store)
    for (std::size_t i = 0; i < open.keys.size(); ++i) baked[i] = store->has(open.keys[i]);
  return baked;
}

bool surfaceLightBaked(const OpenProject& open) {
  std::error_code error;
  if (!std::filesystem::is_directory(captureFolderFor(open.file), error)) return false;
  const auto store = CaptureStore::open(captureFolderFor(open.file));
  return store && store->hasSurfaceLight(open.surfaceLightKey);
}

Result<ProjectBakeReport> bakeProject(const OpenProject& open, const BakeRequest& request, TaskRunner& runner,
                                      const Progress& progress, std::stop_token stop) {
  const auto store = CaptureStore::open(captureFolderFor(open.file));
  if (!store) return tl::unexpected(store.error());
  const std::vector<int> cameras = request.cameras ? *request.cameras : bakingOrder(open);
  for (int camera : cameras)
    if (camera < 0 || camera >= int(open.keys.size()))
      return fail(ErrorKind::invalidArgument, "there is no camera " + std::to_string(camera) +
                                                  "; the layout has " + std::to_string(open.keys.size()));

  ProjectBakeReport report;
  if (request.verify) {
    std::vector<ContentKey> keys;
    for (const int camera : cameras) keys.push_back(open.keys[std::size_t(camera)]);
    if (request.surfaceLight) keys.push_back(open.surfaceLightKey);
    auto damaged = verified(*store, keys, runner, progress, stop);
    if (!damaged) return tl::unexpected(damaged.error());
    report.damaged = std::move(*damaged);
  }
  StoreSink sink(*store);
  auto captures = bake(*open.rays, *open.layout, cameras, open.project.bake, sink, runner, progress, stop);
  if (!captures) return tl::unexpected(captures.error());
  report.captures = std::move(*captures);

  if (request.surfaceLight && store->hasSurfaceLight(open.surfaceLightKey)) {
    report.surfaceLightReused = true;
  } else if (request.surfaceLight) {
    const Stopwatch watch;
    const LocalTriangles local = localTrianglesOf(*open.scene, *open.layout);
    const auto light =
        bakeSurfaceLight(*open.rays, local.wanted, local.viewer, open.project.bake, runner, progress, stop);
    if (!light) return tl::unexpected(light.error());
    if (Status put = store->putSurfaceLight(open.surfaceLightKey, *light); !put)
      return tl::unexpected(put.error());
    report.surfaceLightBaked = true;
    report.surfaceLightSeconds = watch.seconds();
  }
  for (const ContentKey& key : open.keys) report.bytes += store->bytesOf(key);
  return report;
}

}  // namespace acentric
