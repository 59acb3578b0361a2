// Apart from writing: the program that times OpenGL links this, and must not draw in what opens and bakes
// projects.
#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "engine/bench/packed_walk.h"
#include "engine/scene/local_geometry.h"
#include "engine/scene/simplify.h"
#include "engine/store/capture_store.h"

namespace acentric {
namespace packed_walk {

std::filesystem::path projectFile(const std::filesystem::path& folder) {
  return folder / "project.acentric.json";
}
std::filesystem::path sceneFile(const std::filesystem::path& folder) { return folder / "scene.acscene"; }
std::filesystem::path pathFile(const std::filesystem::path& folder) { return folder / "path.json"; }
std::filesystem::path lightFile(const std::filesystem::path& folder) { return folder / "surface.light"; }
std::filesystem::path captureFile(const std::filesystem::path& folder, std::size_t camera) {
  return folder / fmt::format("camera-{}.pack", camera);
}
std::filesystem::path simplifiedFile(const std::filesystem::path& folder, std::size_t region) {
  return folder / fmt::format("region-{}.simplified", region);
}

}  // namespace packed_walk

namespace {

Result<std::shared_ptr<const LocalGeometry>> localOf(const std::filesystem::path& folder, std::size_t region,
                                                     const WalkScene& walk) {
  const ConvexPolygon& grown = walk.layout->regions[region].grown;
  const std::filesystem::path file = packed_walk::simplifiedFile(folder, region);
  if (!std::filesystem::exists(file))
    return std::make_shared<const LocalGeometry>(clipToPolygon(*walk.scene, grown));
  const auto simplified = readSimplified(file);
  if (!simplified) return tl::unexpected(simplified.error());
  if (Status fits = simplified->check(*walk.scene); !fits) return tl::unexpected(fits.error());
  return std::make_shared<const LocalGeometry>(
      localGeometryOf(*simplified, *walk.scene, grown, walk.surfaceLight.get()));
}

}  // namespace

Result<PackedWalk> readPackedWalk(const std::filesystem::path& folder, TaskRunner& runner) {
  PackedWalk packed;
  auto project = loadProject(packed_walk::projectFile(folder));
  if (!project) return tl::unexpected(project.error());
  packed.project = std::move(*project);
  auto path = loadPath(packed_walk::pathFile(folder));
  if (!path) return tl::unexpected(path.error());
  packed.path = std::move(*path);
  auto scene = readSceneFile(packed_walk::sceneFile(folder));
  if (!scene) return tl::unexpected(scene.error());
  auto layout = buildLayout(packed.project.layout());
  if (!layout) return tl::unexpected(layout.error());

  WalkScene& walk = packed.walk;
  walk.scene = std::make_shared<const Scene>(std::move(*scene));
  walk.plan = planEffects(*walk.scene, packed.project.effects);
  walk.mirrors = flatMirrorsOf(*walk.scene, walk.plan);
  walk.layout = std::make_shared<const Layout>(std::move(*layout));
  walk.exposure = packed.project.exposure;
  if (const auto file = packed_walk::lightFile(folder); std::filesystem::exists(file)) {
    auto light = readSurfaceLight(file);
    if (!light) return tl::unexpected(light.error());
    walk.surfaceLight = std::make_shared<const SurfaceLight>(std::move(*light));
  }
  walk.captures.resize(walk.layout->cameras.size());
  std::mutex mutex;
  std::optional<Error> wrong;
  runner.parallelFor(walk.captures.size(), [&](std::size_t camera) {
    const std::filesystem::path file = packed_walk::captureFile(folder, camera);
    if (!std::filesystem::exists(file)) return;
    const auto capture = readCapturePack(file);
    if (capture) {
      walk.captures[camera] =
          std::make_shared<const DisplayCapture>(prepareForDisplay(*capture, walk.exposure));
    } else {
      const std::lock_guard lock(mutex);
      wrong = capture.error();
    }
  });
  if (wrong) return tl::unexpected(*wrong);
  walk.local.resize(walk.layout->regions.size());
  for (const PathPose& pose : packed.path.poses) {
    const auto region = walk.layout->regionAt(glm::dvec2(pose.eye));
    if (!region)
      return fail(ErrorKind::malformed, "the path leaves the regions",
                  packed_walk::pathFile(folder).string());
    auto& local = walk.local[std::size_t(*region)];
    if (local) continue;
    auto made = localOf(folder, std::size_t(*region), walk);
    if (!made) return tl::unexpected(made.error());
    local = std::move(*made);
  }
  return packed;
}

}  // namespace acentric
