#include "engine/pipeline/export_gltf.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/folder.h"
#include "engine/export/bundle_json.h"
#include "engine/export/export_target.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json onPlan(const glm::dvec2& p) { return {p.x, -p.y}; }  // x and z of glTF

Json indexOf(const Region& region, const std::string& file, const GltfRegionReport& report) {
  Json polygon = Json::array();
  for (const glm::dvec2& corner : region.polygon.corners) polygon.push_back(onPlan(corner));
  return {{"file", file},
          {"bytes", report.bytes},
          {"kind", bundle_words::kKinds[std::size_t(region.kind)]},
          {"polygon", std::move(polygon)},
          {"triangles", report.triangles + report.localTriangles},
          {"cameras", report.cameras - report.missing}};
}

class Writer {
 public:
  Writer(std::span<const OpenProject> storeys, const ExportGltfOptions& options, fs::path folder,
         TaskRunner& runner, const Progress& progress, const std::stop_token& stop)
      : storeys_(storeys),
        options_(options),
        folder_(std::move(folder)),
        runner_(runner),
        progress_(progress),
        stop_(stop) {
    for (const OpenProject& storey : storeys) all_ += storey.layout->regions.size();
  }

  Result<ExportGltfReport> write() {
    const OpenProject& first = storeys_.front();
    Json index{{"format", kGltfFormat},
               {"version", 1},
               {"generator", options_.region.generator},
               {"units", "metre"},
               {"axes", "glTF: Y up, right-handed; polygons are x and z"},
               {"origin", {first.scene->origin.x, first.scene->origin.z, -first.scene->origin.y}},
               {"storey", first.project.storey},
               {"storeys", Json::array()}};
    for (const OpenProject& storey : storeys_) {
      auto written = writeStorey(storey);
      if (!written) return tl::unexpected(written.error());
      index["storeys"].push_back(std::move(*written));
    }
    if (Status done = writeTextAtomically(folder_ / kGltfIndex, layOut(index)); !done)
      return tl::unexpected(done.error());
    return report_;
  }

 private:
  Result<Json> writeStorey(const OpenProject& open) {
    auto start = startWalk(open, nullptr);
    if (!start) return tl::unexpected(start.error());
    WalkStreamOptions streaming;
    streaming.memoryBytes = options_.memoryBytes;
    streaming.threads = 0;
    WalkStream stream(std::move(*start), streaming);
    const Spawn& spawn = open.project.spawn();
    const double floor = open.layout->spec.floorHeight;
    Json out{{"name", open.project.current().name},
             {"floorHeight", floor},
             {"eyeHeight", open.layout->eyeZ() - floor},
             {"start", {{"position", onPlan(spawn.position)}, {"yaw", spawn.yawRadians}}},
             {"regions", Json::array()}};
    const std::size_t number = std::size_t(&open - storeys_.data());
    for (std::size_t r = 0; r < open.layout->regions.size(); ++r, ++done_) {
      const bool wanted =
          !options_.onlyRegion || (open.project.storey == int(number) && int(r) == *options_.onlyRegion);
      if (!wanted) continue;
      if (progress_) progress_({double(done_), double(all_), "writing regions"});
      const auto cameras = gltfCameras(*open.layout, int(r), options_.region);
      const int region = int(r);
      if (Status loaded = stream.complete(cameras, {&region, 1}, runner_, {}, stop_); !loaded)
        return tl::unexpected(loaded.error());
      const std::string file = fmt::format("regions/{}-{}.glb", number, r);
      auto written = writeGltfRegion(stream.walk()->walk, region, options_.region, folder_ / file, stop_);
      if (!written) return tl::unexpected(written.error());
      if (written->missing > 0 && !options_.allowMissing)
        return fail(
            ErrorKind::notFound,
            fmt::format(
                "{} of the {} captures of region {} are not baked yet: run `acentric bake {}` first, or "
                "export what there is with --allow-missing",
                written->missing, written->cameras, r, open.file.string()),
            open.file.string());
      out["regions"].push_back(indexOf(open.layout->regions[r], file, *written));
      report_.regions.push_back(*written);
    }
    return out;
  }

  const std::span<const OpenProject> storeys_;
  const ExportGltfOptions& options_;
  const fs::path folder_;
  TaskRunner& runner_;
  const Progress& progress_;
  const std::stop_token& stop_;
  std::size_t all_ = 0, done_ = 0;
  ExportGltfReport report_;
};

}  // namespace

GltfRegionReport ExportGltfReport::sum() const {
  GltfRegionReport all;
  for (const GltfRegionReport& each : regions) {
    all.cameras += each.cameras, all.missing += each.missing;
    all.patches += each.patches, all.triangles += each.triangles, all.localTriangles += each.localTriangles;
    all.textures += each.textures, all.samples += each.samples;
    all.bytes += each.bytes;
  }
  return all;
}

Status checkGltfTarget(const fs::path& folder) {
  return checkExportTarget(folder, kGltfIndex, kGltfFormat, "glTF walk");
}

Result<ExportGltfReport> exportGltf(std::span<const OpenProject> storeys, const fs::path& folder,
                                    const ExportGltfOptions& options, TaskRunner& runner,
                                    const Progress& progress, const std::stop_token& stop) {
  require(!storeys.empty(), "a project has a storey");
  if (Status sound = options.region.check(); !sound) return tl::unexpected(sound.error());
  if (Status free = checkGltfTarget(folder); !free) return tl::unexpected(free.error());
  return writeFolderAtomically(folder, [&](const fs::path& temporary) {
    std::error_code error;
    fs::create_directories(temporary / "regions", error);
    return Writer(storeys, options, temporary, runner, progress, stop).write();
  });
}

}  // namespace acentric
