#include <fmt/format.h>

#include <array>
#include <new>
#include <stdexcept>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

constexpr std::uint64_t kMaxTriangles = std::uint64_t(1) << 31;
constexpr std::uint64_t kMaxSamples = std::uint64_t(1) << 31;

/// First sample, resolution and sidedness of each triangle.
template <class AnyLight>
auto triangleLanes(AnyLight& light) {
  return std::array{laneOf(light.firstSample), laneOf(light.resolution), laneOf(light.hasBack)};
}

/// The four halves of each sample.
template <class AnyLight>
auto lightLanes(AnyLight& light) {
  return std::array{laneOf(light.light, 0, 2), laneOf(light.light, 2, 2), laneOf(light.light, 4, 2),
                    laneOf(light.light, 6, 2)};
}

Status checkSurfaceLight(const SurfaceLight& light) {
  const auto malformed = [](std::string message) {
    return fail(ErrorKind::malformed, std::move(message), "surface light");
  };
  const std::size_t triangles = light.resolution.size();
  if (light.hasBack.size() != triangles || light.firstSample.size() != triangles + 1)
    return malformed("its tables have different lengths");
  if (triangles > kMaxTriangles || light.light.size() > kMaxSamples)
    return fail(ErrorKind::tooLarge, "more than 2^31 triangles or samples", "surface light");
  if (light.firstSample.back() != light.light.size()) return malformed("its offsets do not span the samples");
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::uint64_t resolution = light.resolution[t];
    if (light.hasBack[t] > 1)
      return malformed(fmt::format("triangle {} has a side flag that is neither 0 nor 1", t));
    const std::uint64_t oneSide = (resolution + 1) * (resolution + 2) / 2;
    const std::uint64_t needed = resolution == 0 ? 0 : oneSide << light.hasBack[t];
    if (light.firstSample[t] + needed > light.firstSample[t + 1])
      return malformed(fmt::format("triangle {} has fewer samples than its resolution needs", t));
  }
  for (const HalfColour& colour : light.light)
    if (colour.r >= 0x7c00 || colour.g >= 0x7c00 || colour.b >= 0x7c00)
      return malformed("light must be finite and >= 0");
  return {};
}

Status writeLight(const SurfaceLight& light, const ContentKey& key, const std::filesystem::path& path,
                  const std::stop_token& stop) {
  if (Status sound = checkSurfaceLight(light); !sound) return sound;
  BlockFileWriter file(BlockFileKind::surfaceLight, key, stop);
  file.describe(static_cast<std::uint64_t>(light.resolution.size()));
  file.describe(static_cast<std::uint64_t>(light.light.size()));
  if (Status added = file.addRecords(triangleLanes(light), light.resolution.size()); !added) return added;
  if (Status added = file.addRecords(lightLanes(light), light.light.size()); !added) return added;
  return file.write(path);
}

Result<Keyed<SurfaceLight>> readLight(const std::filesystem::path& path) {
  auto file = BlockFileReader::open(path, BlockFileKind::surfaceLight);
  if (!file) return tl::unexpected(file.error());
  const auto triangles = file->described<std::uint64_t>();
  const auto samples = file->described<std::uint64_t>();
  if (!file->describedAll()) return file->malformed("its description makes no sense");
  if (triangles > kMaxTriangles || samples > kMaxSamples || file->rawBytes() != 7 * triangles + 8 * samples)
    return file->malformed("its number of samples contradicts its size");
  SurfaceLight light;
  light.firstSample.resize(triangles + 1);
  light.resolution.resize(triangles);
  light.hasBack.resize(triangles);
  light.light.resize(samples);
  light.firstSample.back() = static_cast<std::uint32_t>(samples);
  if (Status read = file->nextRecords(triangleLanes(light), triangles); !read)
    return tl::unexpected(read.error());
  if (Status read = file->nextRecords(lightLanes(light), samples); !read) return tl::unexpected(read.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  if (Status sound = checkSurfaceLight(light); !sound) return file->malformed(sound.error().describe());
  return Keyed<SurfaceLight>{file->key(), std::move(light)};
}

}  // namespace

Status writeSurfaceLight(const SurfaceLight& light, const ContentKey& key, const std::filesystem::path& path,
                         const std::stop_token& stop) {
  return withinMemory(path, [&] { return writeLight(light, key, path, stop); });
}

Result<Keyed<SurfaceLight>> readKeyedSurfaceLight(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return readLight(path); });
}

Result<SurfaceLight> readSurfaceLight(const std::filesystem::path& path) {
  return withoutKey(readKeyedSurfaceLight(path));
}

}  // namespace acentric
