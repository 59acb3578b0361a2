#include <array>
#include <new>
#include <stdexcept>
#include <utility>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

/// Row, inverse distance, the four halves of the colour, roles.
template <class AnySamples>
auto sampleLanes(AnySamples& samples) {
  static_assert(sizeof(HalfColour) == 8);
  return std::array{laneOf(samples.row),          laneOf(samples.inverseDistance),
                    laneOf(samples.colour, 0, 2), laneOf(samples.colour, 2, 2),
                    laneOf(samples.colour, 4, 2), laneOf(samples.colour, 6, 2),
                    laneOf(samples.roles)};
}
constexpr std::uint64_t kColumnBytes = 4, kSampleBytes = 15, kMirrorBytes = 1;

template <class AnyPlanes>
auto planeLanes(AnyPlanes& planes) {
  static_assert(sizeof(SurfacePlane) == 16);
  return std::array{laneOf(planes, 0, 4), laneOf(planes, 4, 4), laneOf(planes, 8, 4), laneOf(planes, 12, 1)};
}
constexpr std::uint64_t kSilhouetteBytes = 6, kPlaneBytes = 13;

/// First row, one below the last, roles.
template <class AnyBackground>
auto runLanes(AnyBackground& background) {
  return std::array{laneOf(background.firstRow), laneOf(background.endRow), laneOf(background.roles)};
}
constexpr std::uint64_t kRunBytes = 5;

/// Samples or runs of each column: small numbers, unlike the offsets.
Status addColumns(BlockFileWriter& file, const std::vector<std::uint32_t>& columnStart) {
  std::vector<std::uint32_t> counts(columnStart.size() - 1);
  for (std::size_t k = 0; k < counts.size(); ++k) counts[k] = columnStart[k + 1] - columnStart[k];
  return file.addRecords(std::array{laneOf(std::as_const(counts))}, counts.size());
}

/// Columns, samples, where there are mirrors their numbers, and silhouettes if it knows them.
Status add(BlockFileWriter& file, const CaptureSamples& samples) {
  if (Status added = addColumns(file, samples.columnStart); !added) return added;
  if (Status added = file.addRecords(sampleLanes(samples), samples.sampleCount()); !added) return added;
  if (Status added = file.addRecords(std::array{laneOf(samples.mirror)}, samples.mirror.size()); !added)
    return added;
  if (!samples.hasSilhouettes()) return {};
  if (Status added =
          file.addRecords(std::array{laneOf(samples.coverage), laneOf(samples.plane)}, samples.sampleCount());
      !added)
    return added;
  return file.addRecords(planeLanes(samples.planes), samples.planes.size());
}

Status add(BlockFileWriter& file, const CaptureBackground& background) {
  if (Status added = addColumns(file, background.columnStart); !added) return added;
  return file.addRecords(runLanes(background), background.runCount());
}

Status writePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                 const std::stop_token& stop) {
  if (Status sound = capture.check(); !sound) return sound;
  const ColumnCamera& camera = capture.camera;
  BlockFileWriter file(BlockFileKind::capture, key, stop);
  for (double value : {camera.centreOfProjection.x, camera.centreOfProjection.y, camera.centreOfProjection.z,
                       camera.lowAzimuth, camera.fovRadians, camera.topElevation, camera.bottomElevation,
                       capture.distanceStep})
    file.describe(value);
  file.describe(static_cast<std::uint32_t>(camera.columns));
  file.describe(static_cast<std::uint32_t>(camera.rows));
  file.describe(static_cast<std::uint64_t>(capture.sampleCount()));
  const CaptureBackground& background = capture.background;
  file.describe(static_cast<std::uint64_t>(background.runCount()));
  for (const glm::vec3& radiance : {background.sky.zenith, background.sky.horizon, background.sky.ground})
    for (int i = 0; i < 3; ++i) file.describe(radiance[i]);
  const bool silhouettes = capture.hasSilhouettes() || capture.reflections.hasSilhouettes();
  if (capture.hasReflections() || silhouettes)
    file.describe(static_cast<std::uint64_t>(capture.reflections.sampleCount()));
  if (silhouettes) {
    file.describe(static_cast<std::uint64_t>(capture.planes.size()));
    file.describe(static_cast<std::uint64_t>(capture.reflections.planes.size()));
    file.describe(capture.planeTolerance);
  }

  if (Status added = add(file, static_cast<const CaptureSamples&>(capture)); !added) return added;
  if (background.runCount() > 0)
    if (Status added = add(file, background); !added) return added;
  if (capture.hasReflections())
    if (Status added = add(file, capture.reflections); !added) return added;
  return file.write(path);
}

/// What `addColumns` wrote, of `total` samples or runs.
Status takeColumns(BlockFileReader& file, std::size_t columns, std::uint64_t total,
                   std::vector<std::uint32_t>& columnStart) {
  std::vector<std::uint32_t> counts(columns);
  if (Status read = file.nextRecords(std::array{laneOf(counts)}, columns); !read) return read;
  columnStart.reserve(columns + 1);
  std::uint64_t start = 0;
  columnStart.push_back(0);
  for (std::uint32_t count : counts) {
    start += count;
    if (start > total) return file.malformed("its columns hold more than it has");
    columnStart.push_back(static_cast<std::uint32_t>(start));
  }
  return {};
}

/// What `add` wrote; the number of samples is known to agree with the file's size.
Status take(BlockFileReader& file, std::size_t columns, std::uint64_t samples, bool mirrors,
            std::uint64_t planes, CaptureSamples& out) {
  if (Status read = takeColumns(file, columns, samples, out.columnStart); !read) return read;
  out.row.resize(samples);
  out.inverseDistance.resize(samples);
  out.colour.resize(samples);
  out.roles.resize(samples);
  out.mirror.resize(mirrors ? samples : 0);
  if (Status read = file.nextRecords(sampleLanes(out), samples); !read) return read;
  if (Status read = file.nextRecords(std::array{laneOf(out.mirror)}, out.mirror.size()); !read) return read;
  if (planes == 0) return {};
  out.coverage.resize(samples);
  out.plane.resize(samples);
  out.planes.resize(planes);
  if (Status read = file.nextRecords(std::array{laneOf(out.coverage), laneOf(out.plane)}, samples); !read)
    return read;
  return file.nextRecords(planeLanes(out.planes), planes);
}

Status take(BlockFileReader& file, std::size_t columns, std::uint64_t runs, CaptureBackground& out) {
  if (Status read = takeColumns(file, columns, runs, out.columnStart); !read) return read;
  out.firstRow.resize(runs);
  out.endRow.resize(runs);
  out.roles.resize(runs);
  return file.nextRecords(runLanes(out), runs);
}

Result<Keyed<Capture>> readPack(Result<BlockFileReader> file,
                                const std::function<Status(const PackHead&)>& accept = {}) {
  if (!file) return tl::unexpected(file.error());
  Capture capture;
  ColumnCamera& camera = capture.camera;
  for (double* value : {&camera.centreOfProjection.x, &camera.centreOfProjection.y,
                        &camera.centreOfProjection.z, &camera.lowAzimuth, &camera.fovRadians,
                        &camera.topElevation, &camera.bottomElevation, &capture.distanceStep})
    *value = file->described<double>();
  const auto columns = file->described<std::uint32_t>();
  const auto rows = file->described<std::uint32_t>();
  const auto samples = file->described<std::uint64_t>();
  const auto runs = file->described<std::uint64_t>();
  CaptureBackground& background = capture.background;
  for (glm::vec3* radiance : {&background.sky.zenith, &background.sky.horizon, &background.sky.ground})
    for (int i = 0; i < 3; ++i) (*radiance)[i] = file->described<float>();
  const bool more = file->describesMore();
  const auto reflections = more ? file->described<std::uint64_t>() : 0;
  const bool silhouettes = file->describesMore(), mirrors = reflections > 0;
  const auto planes = silhouettes ? file->described<std::uint64_t>() : 0;
  const auto reflectionPlanes = silhouettes ? file->described<std::uint64_t>() : 0;
  if (silhouettes) capture.planeTolerance = file->described<double>();
  if (!file->describedAll() || columns > 65535 || rows > 65535 || (more && !silhouettes && !mirrors) ||
      (silhouettes && planes == 0 && reflectionPlanes == 0))
    return file->malformed("its description makes no sense");
  camera.columns = static_cast<int>(columns);
  camera.rows = static_cast<int>(rows);
  const auto bytesOf = [&](std::uint64_t count, std::uint64_t planesOfThem) {
    return kColumnBytes * columns + kPlaneBytes * planesOfThem +
           (kSampleBytes + (mirrors ? kMirrorBytes : 0) + (planesOfThem > 0 ? kSilhouetteBytes : 0)) * count;
  };
  const std::uint64_t backgroundBytes = runs > 0 ? kColumnBytes * columns + kRunBytes * runs : 0;
  if (samples > kMaxCaptureSamples || runs > kMaxCaptureSamples || reflections > kMaxCaptureSamples ||
      planes > kMaxCaptureSamples || reflectionPlanes > kMaxCaptureSamples ||
      file->rawBytes() !=
          bytesOf(samples, planes) + backgroundBytes + (mirrors ? bytesOf(reflections, reflectionPlanes) : 0))
    return file->malformed("its number of samples contradicts its size");
  if (accept)
    if (Status accepted = accept({camera, samples, reflections}); !accepted)
      return tl::unexpected(accepted.error());

  if (Status read = take(*file, columns, samples, mirrors, planes, capture); !read)
    return tl::unexpected(read.error());
  if (runs > 0)
    if (Status read = take(*file, columns, runs, background); !read) return tl::unexpected(read.error());
  if (mirrors)
    if (Status read = take(*file, columns, reflections, true, reflectionPlanes, capture.reflections); !read)
      return tl::unexpected(read.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  if (Status sound = capture.check(); !sound) return file->malformed(sound.error().describe());
  return Keyed<Capture>{file->key(), std::move(capture)};
}

}  // namespace

Status writeCapturePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                        const std::stop_token& stop) {
  return withinMemory(path, [&] { return writePack(capture, key, path, stop); });
}

Result<Keyed<Capture>> readKeyedCapturePack(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return readPack(BlockFileReader::open(path, BlockFileKind::capture)); });
}

Result<Keyed<Capture>> keyedCaptureOf(std::vector<std::byte> bytes, const std::string& name,
                                      const std::function<Status(const PackHead&)>& accept) {
  return withinMemory(name, [&] {
    return readPack(BlockFileReader::of(std::move(bytes), name, BlockFileKind::capture), accept);
  });
}

Result<Capture> readCapturePack(const std::filesystem::path& path) {
  return withoutKey(readKeyedCapturePack(path));
}

}  // namespace acentric
