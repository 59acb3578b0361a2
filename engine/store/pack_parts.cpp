#include "engine/store/pack_parts.h"

#include <array>
#include <utility>

#include "engine/store/keyed.h"

namespace acentric {
namespace {

/// First row, one below the last, roles.
template <class AnyBackground>
auto runLanes(AnyBackground& background) {
  return std::array{laneOf(background.firstRow), laneOf(background.endRow), laneOf(background.roles)};
}

constexpr std::uint32_t kMostSide = 65535;

}  // namespace

void describeHead(BlockFileWriter& file, const Capture& capture) {
  const ColumnCamera& camera = capture.camera;
  for (double value : {camera.centreOfProjection.x, camera.centreOfProjection.y, camera.centreOfProjection.z,
                       camera.lowAzimuth, camera.fovRadians, camera.topElevation, camera.bottomElevation,
                       capture.distanceStep})
    file.describe(value);
  file.describe(static_cast<std::uint32_t>(camera.columns));
  file.describe(static_cast<std::uint32_t>(camera.rows));
  file.describe(static_cast<std::uint64_t>(capture.sampleCount()));
  file.describe(static_cast<std::uint64_t>(capture.background.runCount()));
  const Sky& sky = capture.background.sky;
  for (const glm::vec3& radiance : {sky.zenith, sky.horizon, sky.ground})
    for (int i = 0; i < 3; ++i) file.describe(radiance[i]);
}

void movePack(std::span<std::byte> pack, const glm::dvec2& place) {
  const double values[] = {place.x, place.y};
  describeAnew(pack, 0, std::as_bytes(std::span(values)));
}

PackCounts describedHead(BlockFileReader& file, Capture& capture) {
  ColumnCamera& camera = capture.camera;
  for (double* value : {&camera.centreOfProjection.x, &camera.centreOfProjection.y,
                        &camera.centreOfProjection.z, &camera.lowAzimuth, &camera.fovRadians,
                        &camera.topElevation, &camera.bottomElevation, &capture.distanceStep})
    *value = file.described<double>();
  const auto columns = file.described<std::uint32_t>();
  const auto rows = file.described<std::uint32_t>();
  PackCounts counts;
  counts.samples = file.described<std::uint64_t>();
  counts.runs = file.described<std::uint64_t>();
  Sky& sky = capture.background.sky;
  for (glm::vec3* radiance : {&sky.zenith, &sky.horizon, &sky.ground})
    for (int i = 0; i < 3; ++i) (*radiance)[i] = file.described<float>();
  counts.sized = columns <= kMostSide && rows <= kMostSide;
  camera.columns = counts.sized ? static_cast<int>(columns) : 0;
  camera.rows = counts.sized ? static_cast<int>(rows) : 0;
  return counts;
}

Status addColumns(BlockFileWriter& file, const std::vector<std::uint32_t>& columnStart) {
  std::vector<std::uint32_t> counts(columnStart.size() - 1);
  for (std::size_t k = 0; k < counts.size(); ++k) counts[k] = columnStart[k + 1] - columnStart[k];
  return file.addRecords(std::array{laneOf(std::as_const(counts))}, counts.size());
}

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

Status addBackground(BlockFileWriter& file, const CaptureBackground& background) {
  if (Status added = addColumns(file, background.columnStart); !added) return added;
  return file.addRecords(runLanes(background), background.runCount());
}

Status takeBackground(BlockFileReader& file, std::size_t columns, std::uint64_t runs,
                      CaptureBackground& out) {
  if (Status read = takeColumns(file, columns, runs, out.columnStart); !read) return read;
  out.firstRow.resize(runs);
  out.endRow.resize(runs);
  out.roles.resize(runs);
  return file.nextRecords(runLanes(out), runs);
}

}  // namespace acentric
