#include "engine/pipeline/export_exr.h"

#include <fmt/format.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/folder.h"
#include "engine/export/bundle_json.h"
#include "engine/export/export_target.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// One camera's file, as the index tells of it.
struct WrittenExr {
  std::string file;
  ColumnCamera camera;
  std::size_t samples = 0, reflections = 0;
  int layers = 0;
  std::uint64_t bytes = 0;
};

struct ExrPlace {
  std::size_t storey, camera;
};

Json toJson(const WrittenExr& written) {
  const ColumnCamera& camera = written.camera;
  const glm::dvec3& centre = camera.centreOfProjection;
  return {{"file", written.file},
          {"bytes", written.bytes},
          {"centreOfProjection", {centre.x, centre.y, centre.z}},
          {"lowAzimuth", camera.lowAzimuth},
          {"fov", camera.fovRadians},
          {"columns", camera.columns},
          {"rows", camera.rows},
          {"layers", written.layers},
          {"samples", written.samples},
          {"reflections", written.reflections}};
}

class ExrWriter {
 public:
  ExrWriter(std::span<const OpenProject> storeys, const CaptureStore& store, const ExportExrOptions& options,
            fs::path folder, TaskRunner& runner, const Progress& progress, const std::stop_token& stop)
      : storeys_(storeys),
        store_(store),
        options_(options),
        folder_(std::move(folder)),
        runner_(runner),
        progress_(progress),
        stop_(stop) {
    for (std::size_t storey = 0; storey < storeys.size(); ++storey)
      for (std::size_t camera = 0; camera < storeys[storey].keys.size(); ++camera) {
        if (store.has(storeys[storey].keys[camera]))
          places_.push_back({storey, camera});
        else
          ++report_.missing;
      }
    written_.resize(places_.size());
  }

  Status refuseMissing() const {
    if (report_.missing == 0 || options_.allowMissing) return {};
    const std::string project = storeys_.front().file.string();
    return fail(
        ErrorKind::notFound,
        fmt::format("{} of {} captures {} not baked yet: run `acentric bake {}` first, or export what there "
                    "is with --allow-missing",
                    report_.missing, report_.missing + places_.size(), report_.missing > 1 ? "are" : "is",
                    project),
        project);
  }

  Result<ExportExrReport> write() {
    std::error_code error;
    fs::create_directories(folder_ / "captures", error);
    std::vector<Status> done(places_.size());
    std::mutex mutex;
    std::size_t finished = 0;
    runner_.parallelFor(places_.size(), [&](std::size_t n) {
      done[n] = writeCamera(n);
      const std::lock_guard lock(mutex);
      if (progress_) progress_({double(++finished), double(places_.size()), "writing OpenEXR files"});
    });
    for (const Status& status : done)
      if (!status) return tl::unexpected(status.error());
    for (const WrittenExr& written : written_) {
      ++report_.files;
      report_.samples += written.samples + written.reflections, report_.bytes += written.bytes;
    }
    if (Status listed = writeIndex(); !listed) return tl::unexpected(listed.error());
    return report_;
  }

 private:
  Status writeCamera(std::size_t n) {
    if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "writing OpenEXR files was stopped");
    const auto [storey, camera] = places_[n];
    const ContentKey& key = storeys_[storey].keys[camera];
    const auto capture = store_.get(key);
    if (!capture) return tl::unexpected(capture.error());
    WrittenExr& written = written_[n];
    written = {fmt::format("captures/{}-{:05}.exr", storey, camera),
               capture->camera,
               capture->sampleCount(),
               capture->reflections.sampleCount(),
               capture->maxLayers(),
               0};
    if (Status done = writeCaptureExr(*capture, key, folder_ / written.file, stop_); !done) return done;
    std::error_code error;
    written.bytes = fs::file_size(folder_ / written.file, error);
    return {};
  }

  Status writeIndex() const {
    Json index{{"format", kExrFormat},
               {"version", 1},
               {"generator", options_.generator},
               {"units", "metre"},
               {"axes", "right-handed, Z up; azimuths from X towards Y, radians"},
               {"storeys", Json::array()}};
    for (const OpenProject& storey : storeys_)
      index["storeys"].push_back({{"name", storey.project.current().name}, {"captures", Json::array()}});
    for (std::size_t n = 0; n < places_.size(); ++n)
      index["storeys"][places_[n].storey]["captures"].push_back(toJson(written_[n]));
    return writeTextAtomically(folder_ / kExrIndex, layOut(index));
  }

  const std::span<const OpenProject> storeys_;
  const CaptureStore& store_;
  const ExportExrOptions& options_;
  const fs::path folder_;
  TaskRunner& runner_;
  const Progress& progress_;
  const std::stop_token& stop_;
  std::vector<ExrPlace> places_;  ///< that are baked
  std::vector<WrittenExr> written_;
  ExportExrReport report_;
};

}  // namespace

Status checkExrTarget(const fs::path& folder) {
  return checkExportTarget(folder, kExrIndex, kExrFormat, "folder of OpenEXR captures");
}

Result<ExportExrReport> exportExr(std::span<const OpenProject> storeys, const fs::path& folder,
                                  const ExportExrOptions& options, TaskRunner& runner,
                                  const Progress& progress, const std::stop_token& stop) {
  require(!storeys.empty(), "a project has a storey");
  if (Status free = checkExrTarget(folder); !free) return tl::unexpected(free.error());
  const auto store = openCaptures(storeys.front().file);
  if (!store) return tl::unexpected(store.error());
  return writeFolderAtomically(folder, [&](const fs::path& temporary) -> Result<ExportExrReport> {
    ExrWriter writer(storeys, *store, options, temporary, runner, progress, stop);
    if (Status whole = writer.refuseMissing(); !whole) return tl::unexpected(whole.error());
    return writer.write();
  });
}

}  // namespace acentric
