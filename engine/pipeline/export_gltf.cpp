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

class GltfWriter {
 public:
  GltfWriter(std::span<const OpenProject> storeys, const ExportGltfOptions& options, fs::path folder,
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
    const glm::dvec3& origin = first.scene->origin;
    Json index{
        {"units", "metre"},
        {"axes", options_.tiles ? "Z up, right-handed" : "glTF: Y up, right-handed; polygons are x and z"},
        {"origin", options_.tiles ? Json{origin.x, origin.y, origin.z} : Json{origin.x, origin.z, -origin.y}},
        {"storey", first.project.storey},
        {"storeys", Json::array()}};
    for (const OpenProject& storey : storeys_) {
      auto written = writeStorey(storey);
      if (!written) return tl::unexpected(written.error());
      index["storeys"].push_back(std::move(*written));
    }
    if (report_.regions.empty())
      return fail(ErrorKind::notFound,
                  options_.onlyRegion ? fmt::format("there is no region {}", *options_.onlyRegion)
                                      : "the walk has no region",
                  first.file.string());
    const Status done = options_.tiles
                            ? writeTileset(std::move(tiles_), options_.region.generator, index, folder_)
                            : writeIndex(index);
    if (!done) return tl::unexpected(done.error());
    return report_;
  }

 private:
  Status writeIndex(const Json& facts) const {
    Json index{{"format", kGltfFormat}, {"version", 1}, {"generator", options_.region.generator}};
    index.update(facts);
    return writeTextAtomically(folder_ / kGltfIndex, layOut(index));
  }

  Json onPlan(const glm::dvec2& p) const { return options_.tiles ? Json{p.x, p.y} : Json{p.x, -p.y}; }

  /// A file that was written becomes a tile, or one of the storey's `regions`.
  void add(const OpenProject& open, std::size_t storey, std::size_t number, const std::string& file,
           const GltfRegionReport& report, Json& regions) {
    const Region& region = open.layout->regions[number];
    Json polygon = Json::array();
    for (const glm::dvec2& corner : region.polygon.corners) polygon.push_back(onPlan(corner));
    const Json facts{{"bytes", report.bytes},
                     {"kind", bundle_words::kKinds[std::size_t(region.kind)]},
                     {"polygon", std::move(polygon)},
                     {"triangles", report.triangles + report.localTriangles},
                     {"cameras", report.cameras - report.missing}};
    report_.regions.push_back(report);
    if (options_.tiles) {
      Json extras{{"storey", storey}, {"region", number}};
      extras.update(facts);
      const double eye = open.layout->eyeZ();
      tiles_.push_back(
          {file, region.polygon, eye, eye - open.layout->spec.floorHeight, report.bounds, extras});
    } else {
      Json entry{{"file", file}};
      entry.update(facts);
      regions.push_back(std::move(entry));
    }
  }

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
             {"start", {{"position", onPlan(spawn.position)}, {"yaw", spawn.yawRadians}}}};
    Json regions = Json::array();
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
      add(open, number, r, file, *written, regions);
    }
    if (!options_.tiles) out["regions"] = std::move(regions);  // a tileset's are its tiles
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
  std::vector<RegionTile> tiles_;
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

Status checkGltfTarget(const fs::path& folder, bool tiles) {
  return tiles ? checkExportTarget(folder, kTilesetIndex, kTilesetFormat, "3D Tiles walk")
               : checkExportTarget(folder, kGltfIndex, kGltfFormat, "glTF walk");
}

Result<ExportGltfReport> exportGltf(std::span<const OpenProject> storeys, const fs::path& folder,
                                    const ExportGltfOptions& options, TaskRunner& runner,
                                    const Progress& progress, const std::stop_token& stop) {
  require(!storeys.empty(), "a project has a storey");
  if (Status sound = options.region.check(); !sound) return tl::unexpected(sound.error());
  if (Status free = checkGltfTarget(folder, options.tiles); !free) return tl::unexpected(free.error());
  return writeFolderAtomically(folder, [&](const fs::path& temporary) {
    std::error_code error;
    fs::create_directories(temporary / "regions", error);
    return GltfWriter(storeys, options, temporary, runner, progress, stop).write();
  });
}

}  // namespace acentric
