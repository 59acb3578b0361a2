#include <array>
#include <new>
#include <stdexcept>
#include <utility>

#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"
#include "engine/store/pack_parts.h"

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
template <class AnyPlanes>
auto planeLanes(AnyPlanes& planes) {
  static_assert(sizeof(SurfacePlane) == 16);
  return std::array{laneOf(planes, 0, 4), laneOf(planes, 4, 4), laneOf(planes, 8, 4), laneOf(planes, 12, 1)};
}
constexpr std::uint64_t kSampleBytes = 15, kMirrorBytes = 1, kSilhouetteBytes = 6, kPlaneBytes = 13;

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

Status writePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                 const std::stop_token& stop) {
  if (Status sound = capture.check(); !sound) return sound;
  BlockFileWriter file(BlockFileKind::capture, key, stop);
  describeHead(file, capture);
  const bool silhouettes = capture.hasSilhouettes() || capture.reflections.hasSilhouettes();
  if (capture.hasReflections() || silhouettes)
    file.describe(static_cast<std::uint64_t>(capture.reflections.sampleCount()));
  if (silhouettes) {
    file.describe(static_cast<std::uint64_t>(capture.planes.size()));
    file.describe(static_cast<std::uint64_t>(capture.reflections.planes.size()));
    file.describe(capture.planeTolerance);
  }

  if (Status added = add(file, static_cast<const CaptureSamples&>(capture)); !added) return added;
  if (capture.background.runCount() > 0)
    if (Status added = addBackground(file, capture.background); !added) return added;
  if (capture.hasReflections())
    if (Status added = add(file, capture.reflections); !added) return added;
  return file.write(path);
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
  if (Status read = file.nextRecords(std::array{laneOf(out.coverage), laneOf(out.plane)}, samples); !read)
    return read;
  out.planes.resize(planes);
  return file.nextRecords(planeLanes(out.planes), planes);
}

}  // namespace

Result<Capture> readPlain(BlockFileReader& file, const AcceptPack& accept) {
  Capture capture;
  const PackCounts counts = describedHead(file, capture);
  const std::uint64_t samples = counts.samples, runs = counts.runs;
  const auto columns = std::uint64_t(capture.camera.columns);
  const bool more = file.describesMore();
  const auto reflections = more ? file.described<std::uint64_t>() : 0;
  const bool silhouettes = file.describesMore(), mirrors = reflections > 0;
  const auto planes = silhouettes ? file.described<std::uint64_t>() : 0;
  const auto reflectionPlanes = silhouettes ? file.described<std::uint64_t>() : 0;
  if (silhouettes) capture.planeTolerance = file.described<double>();
  if (!file.describedAll() || !counts.sized || (more && !silhouettes && !mirrors) ||
      (silhouettes && planes == 0 && reflectionPlanes == 0))
    return file.malformed("its description makes no sense");
  const auto bytesOf = [&](std::uint64_t count, std::uint64_t planesOfThem) {
    return kColumnBytes * columns + kPlaneBytes * planesOfThem +
           (kSampleBytes + (mirrors ? kMirrorBytes : 0) + (planesOfThem > 0 ? kSilhouetteBytes : 0)) * count;
  };
  const std::uint64_t backgroundBytes = runs > 0 ? kColumnBytes * columns + kRunBytes * runs : 0;
  if (samples > kMaxCaptureSamples || runs > kMaxCaptureSamples || reflections > kMaxCaptureSamples ||
      planes > kMaxCaptureSamples || reflectionPlanes > kMaxCaptureSamples ||
      file.rawBytes() !=
          bytesOf(samples, planes) + backgroundBytes + (mirrors ? bytesOf(reflections, reflectionPlanes) : 0))
    return file.malformed("its number of samples contradicts its size");
  if (accept)
    if (Status accepted = accept({capture.camera, samples, reflections}); !accepted)
      return tl::unexpected(accepted.error());

  if (Status read = take(file, columns, samples, mirrors, planes, capture); !read)
    return tl::unexpected(read.error());
  if (runs > 0)
    if (Status read = takeBackground(file, columns, runs, capture.background); !read)
      return tl::unexpected(read.error());
  if (mirrors)
    if (Status read = take(file, columns, reflections, true, reflectionPlanes, capture.reflections); !read)
      return tl::unexpected(read.error());
  return capture;
}

Result<Keyed<Capture>> wholePack(const BlockFileReader& file, Result<Capture> capture) {
  if (!capture) return tl::unexpected(capture.error());
  if (!file.atEnd()) return file.malformed("has more blocks than its description needs");
  if (Status sound = capture->check(); !sound) return file.malformed(sound.error().describe());
  return Keyed<Capture>{file.key(), std::move(*capture)};
}

Status writeCapturePack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                        const std::stop_token& stop) {
  return withinMemory(path, [&] { return writePack(capture, key, path, stop); });
}

}  // namespace acentric
