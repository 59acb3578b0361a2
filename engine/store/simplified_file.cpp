#include <array>
#include <cmath>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

constexpr std::uint64_t kMost = std::uint64_t(1) << 31;

template <class Vertices>
auto vertexLanes(Vertices& vertices) {
  return std::array{laneOf(vertices, 0, 4), laneOf(vertices, 4, 4), laneOf(vertices, 8, 4),
                    laneOf(vertices, 12, 4), laneOf(vertices, 16, 4)};
}
static_assert(sizeof(LocalVertex) == 20 && sizeof(LocalTriangle) == 20 && sizeof(SurfacePlace) == 12);

template <class Triangles>
auto triangleLanes(Triangles& triangles) {
  return std::array{laneOf(triangles, 0, 4), laneOf(triangles, 4, 4), laneOf(triangles, 8, 4),
                    laneOf(triangles, 12, 4), laneOf(triangles, 16, 4)};
}

template <class Corners>
auto cornerLanes(Corners& corners) {
  return std::array{laneOf(corners, 0, 4), laneOf(corners, 4, 4), laneOf(corners, 8, 4)};
}

template <class AnySimplified>
auto lightLanes(AnySimplified& simplified) {
  return std::array{laneOf(simplified.lightFrom), laneOf(simplified.lightResolution)};
}

template <class Places>
auto placeLanes(Places& places) {
  return std::array{laneOf(places, 0, 4), laneOf(places, 4, 4), laneOf(places, 8, 4)};
}

template <class AnyMesh>
auto meshVertexLane(AnyMesh& mesh) {
  return std::array{laneOf(mesh.sceneVertices)};
}

void describe(BlockFileWriter& file, const SimplifyReport& report) {
  for (const std::size_t count : {report.before, report.after, report.rim, report.split, report.errorSamples})
    file.describe(static_cast<std::uint64_t>(count));
  for (const double value :
       {report.maxError, report.meanError, report.seconds, report.psnr, report.meanDifference})
    file.describe(value);
  file.describe(static_cast<std::uint32_t>(report.comparedFrames));
  file.describe(static_cast<std::uint8_t>(report.withinError ? 1 : 0));
  file.describe(static_cast<std::uint8_t>(report.withinBudget ? 1 : 0));
}

SimplifyReport describedReport(BlockFileReader& file) {
  SimplifyReport report;
  for (std::size_t* count : {&report.before, &report.after, &report.rim, &report.split, &report.errorSamples})
    *count = file.described<std::uint64_t>();
  for (double* value :
       {&report.maxError, &report.meanError, &report.seconds, &report.psnr, &report.meanDifference})
    *value = file.described<double>();
  report.comparedFrames = static_cast<int>(file.described<std::uint32_t>());
  report.withinError = file.described<std::uint8_t>() != 0;
  report.withinBudget = file.described<std::uint8_t>() != 0;
  return report;
}

Status write(const SimplifiedLocal& s, const ContentKey& key, const std::filesystem::path& path) {
  BlockFileWriter file(BlockFileKind::simplifiedLocal, key);
  describe(file, s.report);
  for (const std::size_t count :
       {s.vertices.size(), s.triangles.size(), s.lightFrom.size(), s.lightPlaces.size(), s.meshes.size()})
    file.describe(static_cast<std::uint64_t>(count));
  for (const SimplifiedMesh& mesh : s.meshes) {
    file.describe(mesh.sceneMesh);
    file.describe(static_cast<std::uint64_t>(mesh.sceneVertices.size()));
    file.describe(static_cast<std::uint64_t>(mesh.triangles.size()));
  }
  if (s.report.loosenedFrom > 0)
    for (const std::size_t count : {s.report.loosenedFrom, s.report.piecesLeftOut, s.report.trianglesLeftOut})
      file.describe(static_cast<std::uint64_t>(count));
  Status added = file.addRecords(vertexLanes(s.vertices), s.vertices.size());
  const auto add = [&](const auto& lanes, std::size_t count) {
    if (added) added = file.addRecords(lanes, count);
  };
  add(triangleLanes(s.triangles), s.triangles.size());
  add(lightLanes(s), s.lightFrom.size());
  add(placeLanes(s.lightPlaces), s.lightPlaces.size());
  for (const SimplifiedMesh& mesh : s.meshes) {
    add(meshVertexLane(mesh), mesh.sceneVertices.size());
    add(cornerLanes(mesh.triangles), mesh.triangles.size());
  }
  return added ? file.write(path) : added;
}

Result<Keyed<SimplifiedLocal>> read(const std::filesystem::path& path) {
  auto file = BlockFileReader::open(path, BlockFileKind::simplifiedLocal);
  if (!file) return tl::unexpected(file.error());
  SimplifiedLocal s;
  s.report = describedReport(*file);
  const auto vertices = file->described<std::uint64_t>(), triangles = file->described<std::uint64_t>(),
             lights = file->described<std::uint64_t>(), places = file->described<std::uint64_t>(),
             meshes = file->described<std::uint64_t>();
  // Nothing is believed before the sizes add up to what the file holds.
  std::uint64_t bytes = 0;
  for (const auto& [count, each] :
       {std::pair{vertices, 20u}, {triangles, 20u}, {lights, 6u}, {places, 12u}}) {
    if (count > kMost) return file->malformed("its number of triangles makes no sense");
    bytes += count * each;
  }
  struct Counts {
    std::uint64_t vertices, triangles;
  };
  std::vector<Counts> counts;
  for (std::uint64_t m = 0; m < meshes; ++m) {
    SimplifiedMesh mesh;
    mesh.sceneMesh = file->described<std::uint32_t>();
    counts.push_back({file->described<std::uint64_t>(), file->described<std::uint64_t>()});
    // A description that ends too early gives zeros; no file has room for many meshes of nothing.
    if (counts.back().triangles == 0 || counts.back().vertices > kMost || counts.back().triangles > kMost)
      return file->malformed("its description makes no sense");
    bytes += 4 * counts.back().vertices + 12 * counts.back().triangles;
    s.meshes.push_back(std::move(mesh));
  }
  if (file->describesMore())
    for (std::size_t* count : {&s.report.loosenedFrom, &s.report.piecesLeftOut, &s.report.trianglesLeftOut})
      *count = file->described<std::uint64_t>();
  if (!file->describedAll() || bytes != file->rawBytes())
    return file->malformed("its number of triangles contradicts its size");
  s.vertices.resize(vertices);
  s.triangles.resize(triangles);
  s.lightFrom.resize(lights);
  s.lightResolution.resize(lights);
  s.lightPlaces.resize(places);
  Status done = file->nextRecords(vertexLanes(s.vertices), vertices);
  const auto next = [&](const auto& lanes, std::uint64_t count) {
    if (done) done = file->nextRecords(lanes, count);
  };
  next(triangleLanes(s.triangles), triangles);
  next(lightLanes(s), lights);
  next(placeLanes(s.lightPlaces), places);
  for (std::size_t m = 0; m < s.meshes.size() && done; ++m) {
    s.meshes[m].sceneVertices.resize(counts[m].vertices);
    s.meshes[m].triangles.resize(counts[m].triangles);
    next(meshVertexLane(s.meshes[m]), counts[m].vertices);
    next(cornerLanes(s.meshes[m].triangles), counts[m].triangles);
  }
  if (!done) return tl::unexpected(done.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  return Keyed<SimplifiedLocal>{file->key(), std::move(s)};
}

}  // namespace

Status writeSimplified(const SimplifiedLocal& simplified, const ContentKey& key,
                       const std::filesystem::path& path) {
  return withinMemory(path, [&] { return write(simplified, key, path); });
}

Result<Keyed<SimplifiedLocal>> readKeyedSimplified(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return read(path); });
}

Result<SimplifiedLocal> readSimplified(const std::filesystem::path& path) {
  return withoutKey(readKeyedSimplified(path));
}

}  // namespace acentric
