#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/bench/packed_walk.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/simplified_regions.h"
#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

Status needEmpty(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorKind::unreadable, error.message(), folder.string());
  if (!std::filesystem::is_empty(folder, error))
    return fail(ErrorKind::invalidArgument, "the folder holds something already: name a new one",
                folder.string());
  return {};
}

std::uint64_t bytesIn(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) bytes += entry.file_size();
  return bytes;
}

/// All but captures.
Status writeSurroundings(const OpenProject& open, const CaptureStore& store, const CameraPath& path,
                         const std::filesystem::path& folder) {
  if (Status s = saveProject(open.project, packed_walk::projectFile(folder)); !s) return s;
  if (Status s = writeSceneFile(open.drawn->scene(), packed_walk::sceneFile(folder)); !s) return s;
  if (store.hasSurfaceLight(open.surfaceLightKey)) {
    const auto light = store.getSurfaceLight(open.surfaceLightKey);
    if (!light) return tl::unexpected(light.error());
    if (Status s = writeSurfaceLight(*light, open.surfaceLightKey, packed_walk::lightFile(folder)); !s)
      return s;
  }
  if (!open.project.budget.simplifies()) return {};
  std::set<int> crossed;
  for (const PathPose& pose : path.poses)
    if (const auto region = open.layout->regionAt(glm::dvec2(pose.eye))) crossed.insert(*region);
  for (const int region : crossed) {
    const ContentKey key = simplifiedKey(open, open.layout->regions[std::size_t(region)]);
    if (!store.hasSimplified(key)) continue;
    const auto simplified = store.getSimplified(key);
    if (!simplified) return tl::unexpected(simplified.error());
    if (Status s =
            writeSimplified(*simplified, key, packed_walk::simplifiedFile(folder, std::size_t(region)));
        !s)
      return s;
  }
  return {};
}

}  // namespace

CameraPath roundIn(const Layout& layout, int region, int frames) {
  const ConvexPolygon& polygon = layout.regions[std::size_t(region)].polygon;
  const glm::dvec2 middle = polygon.centroid();
  double nearest = glm::distance(middle, polygon.corners.front());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon.corners[i], b = polygon.corners[(i + 1) % polygon.size()];
    const glm::dvec2 along = glm::normalize(b - a), from = middle - a;
    nearest = std::min(nearest, std::abs(along.x * from.y - along.y * from.x));
  }
  CameraPath path;
  for (int i = 0; i < frames; ++i) {
    const double azimuth = kTwoPi * i / frames;
    path.poses.push_back(
        {glm::dvec3(middle + 0.5 * nearest * directionOf(azimuth), layout.eyeZ()), azimuth, 0});
  }
  return path;
}

Result<PackReport> packWalk(const OpenProject& open, const CameraPath& path, glm::ivec2 pixels,
                            std::uint64_t mostBytes, const std::filesystem::path& folder) {
  if (Status empty = needEmpty(folder); !empty) return tl::unexpected(empty.error());
  const auto store = openCaptures(open.file);
  if (!store) return tl::unexpected(store.error());
  if (Status written = writeSurroundings(open, *store, path, folder); !written)
    return tl::unexpected(written.error());

  PackReport report;
  report.bytes = bytesIn(folder);
  const std::vector<std::optional<ContentKey>> keys = bestKeys(open, *store);
  if (std::ranges::none_of(keys, [](const auto& key) { return key.has_value(); }))
    return fail(ErrorKind::notFound, "nothing is baked yet; run `acentric bake` on it first",
                open.file.string());
  std::map<int, std::uint64_t> written;  // bytes by camera
  std::set<int> packed;
  for (const PathPose& pose : path.poses) {
    const ViewCameras seen =
        camerasOf(*open.layout, viewAt(pose, open.project.fovDegrees, pixels), open.project.view);
    const auto there = [&](int camera) { return keys[std::size_t(camera)].has_value(); };
    if (seen.region < 0 || !std::ranges::all_of(seen.cameras, there)) continue;
    std::uint64_t more = 0;
    for (const int camera : seen.cameras) {
      if (packed.contains(camera)) continue;
      if (!written.contains(camera)) {
        const ContentKey& key = *keys[std::size_t(camera)];
        const auto capture = store->get(key);
        if (!capture) return tl::unexpected(capture.error());
        const auto file = packed_walk::captureFile(folder, std::size_t(camera));
        if (Status w = writeCodedPack(*capture, key, file, kLosslessColours); !w)
          return tl::unexpected(w.error());
        written[camera] = std::filesystem::file_size(file);
      }
      more += written[camera];
    }
    if (report.bytes + more > mostBytes) continue;
    report.bytes += more;
    packed.insert(seen.cameras.begin(), seen.cameras.end());
    report.path.poses.push_back(pose);
  }
  std::error_code error;
  for (const auto& [camera, bytes] : written)
    if (!packed.contains(camera))
      std::filesystem::remove(packed_walk::captureFile(folder, std::size_t(camera)), error);
  if (report.path.poses.empty())
    return fail(ErrorKind::tooLarge,
                fmt::format("the scene and its light take {:.1f} MB: no picture's captures are there and fit "
                            "beside them in {:.1f} MB. Allow more, or bake fewer samples per degree",
                            1e-6 * double(report.bytes), 1e-6 * double(mostBytes)),
                folder.string());
  if (Status saved = savePath(report.path, packed_walk::pathFile(folder)); !saved)
    return tl::unexpected(saved.error());
  report.cameras = int(packed.size());
  report.bytes = bytesIn(folder);
  return report;
}

}  // namespace acentric
