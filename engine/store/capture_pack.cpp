#include <array>
#include <new>
#include <stdexcept>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

/// Row, inverse distance, the four halves of the colour, roles.
template <class AnyCapture>
auto sampleLanes(AnyCapture& capture) {
  static_assert(sizeof(HalfColour) == 8);
  return std::array{laneOf(capture.row),          laneOf(capture.inverseDistance),
                    laneOf(capture.colour, 0, 2), laneOf(capture.colour, 2, 2),
                    laneOf(capture.colour, 4, 2), laneOf(capture.colour, 6, 2),
                    laneOf(capture.roles)};
}

/// Samples of each column: small numbers, unlike the offsets.
std::vector<std::uint32_t> columnCounts(const Capture& capture) {
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(capture.camera.columns));
  for (std::size_t k = 0; k < counts.size(); ++k)
    counts[k] = capture.columnStart[k + 1] - capture.columnStart[k];
  return counts;
}

Status writePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path) {
  if (Status sound = capture.check(); !sound) return sound;
  const ColumnCamera& camera = capture.camera;
  BlockFileWriter file(BlockFileKind::capture, key);
  for (double value : {camera.centreOfProjection.x, camera.centreOfProjection.y, camera.centreOfProjection.z,
                       camera.lowAzimuth, camera.fovRadians, camera.topElevation, camera.bottomElevation,
                       capture.distanceStep})
    file.describe(value);
  file.describe(static_cast<std::uint32_t>(camera.columns));
  file.describe(static_cast<std::uint32_t>(camera.rows));
  file.describe(static_cast<std::uint64_t>(capture.sampleCount()));

  const std::vector<std::uint32_t> counts = columnCounts(capture);
  if (Status added = file.addRecords(std::array{laneOf(counts)}, counts.size()); !added) return added;
  if (Status added = file.addRecords(sampleLanes(capture), capture.sampleCount()); !added) return added;
  return file.write(path);
}

Result<Keyed<Capture>> readPack(const std::filesystem::path& path) {
  auto file = BlockFileReader::open(path, BlockFileKind::capture);
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
  if (!file->describedAll() || columns > 65535 || rows > 65535)
    return file->malformed("its description makes no sense");
  camera.columns = static_cast<int>(columns);
  camera.rows = static_cast<int>(rows);
  if (samples > kMaxCaptureSamples || file->rawBytes() != 4 * std::uint64_t(columns) + 15 * samples)
    return file->malformed("its number of samples contradicts its size");

  std::vector<std::uint32_t> counts(columns);
  if (Status read = file->nextRecords(std::array{laneOf(counts)}, columns); !read)
    return tl::unexpected(read.error());
  capture.columnStart.reserve(columns + 1);
  std::uint64_t start = 0;
  capture.columnStart.push_back(0);
  for (std::uint32_t count : counts) {
    start += count;
    if (start > samples) return file->malformed("its columns hold more samples than it has");
    capture.columnStart.push_back(static_cast<std::uint32_t>(start));
  }
  capture.row.resize(samples);
  capture.inverseDistance.resize(samples);
  capture.colour.resize(samples);
  capture.roles.resize(samples);
  if (Status read = file->nextRecords(sampleLanes(capture), samples); !read)
    return tl::unexpected(read.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  if (Status sound = capture.check(); !sound) return file->malformed(sound.error().describe());
  return Keyed<Capture>{file->key(), std::move(capture)};
}

}  // namespace

Status writeCapturePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path) {
  return withinMemory(path, [&] { return writePack(capture, key, path); });
}

Result<Keyed<Capture>> readKeyedCapturePack(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return readPack(path); });
}

Result<Capture> readCapturePack(const std::filesystem::path& path) {
  return withoutKey(readKeyedCapturePack(path));
}

}  // namespace acentric
