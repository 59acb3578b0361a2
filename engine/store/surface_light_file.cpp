#include <fmt/format.h>

#include <array>
#include <new>
#include <optional>
#include <stdexcept>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"
#include "engine/store/light_coder.h"

namespace acentric {
namespace {

constexpr std::uint64_t kMaxTriangles = std::uint64_t(1) << 31;
constexpr std::uint64_t kMaxSamples = std::uint64_t(1) << 31;

/// Resolution and sidedness of each triangle.
constexpr std::uint64_t kTriangleBytes = 3;
template <class AnyLight>
auto resolutionLanes(AnyLight& light) {
  return std::array{laneOf(light.resolution), laneOf(light.hasBack)};
}

/// What a reader makes of a file besides: offsets of triangles, and samples.
std::uint64_t claimOf(std::uint64_t triangles, std::uint64_t samples) {
  return sizeof(std::uint32_t) * triangles + sizeof(HalfColour) * samples;
}

/// Nothing where the side flag is neither 0 nor 1.
std::optional<std::uint64_t> samplesOf(const SurfaceLight& light, std::size_t triangle) {
  const std::uint64_t resolution = light.resolution[triangle];
  if (light.hasBack[triangle] > 1) return std::nullopt;
  return resolution == 0 ? 0 : (resolution + 1) * (resolution + 2) / 2 << light.hasBack[triangle];
}
std::string badSide(std::size_t triangle) {
  return fmt::format("triangle {} has a side flag that is neither 0 nor 1", triangle);
}

}  // namespace

Status checkSurfaceLight(const SurfaceLight& light) {
  const auto malformed = [](std::string message) {
    return fail(ErrorKind::malformed, std::move(message), "surface light");
  };
  const std::size_t triangles = light.resolution.size();
  if (light.hasBack.size() != triangles || light.firstSample.size() != triangles + 1)
    return malformed("its tables have different lengths");
  if (triangles > kMaxTriangles || light.light.size() > kMaxSamples)
    return fail(ErrorKind::tooLarge, "more than 2^31 triangles or samples", "surface light");
  std::uint64_t next = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto samples = samplesOf(light, t);
    if (!samples) return malformed(badSide(t));
    if (light.firstSample[t] != next)
      return malformed(fmt::format("the samples of triangle {} do not follow those before", t));
    next += *samples;
  }
  if (light.firstSample.back() != next || next != light.light.size())
    return malformed("its triangles do not have as many samples as there are");
  for (const HalfColour& colour : light.light)
    if (colour.r >= 0x7c00 || colour.g >= 0x7c00 || colour.b >= 0x7c00)
      return malformed("light must be finite and >= 0");
  return {};
}

namespace {

Status writeLight(const SurfaceLight& light, const ContentKey& key, const std::filesystem::path& path,
                  const std::stop_token& stop) {
  if (Status sound = checkSurfaceLight(light); !sound) return sound;
  BlockFileWriter file(BlockFileKind::surfaceLight, key, stop);
  file.describe(static_cast<std::uint64_t>(light.resolution.size()));
  file.describe(static_cast<std::uint64_t>(light.light.size()));
  const int unused = unusedBits(light);
  const std::vector<std::byte> stream = codeLight(light, unused);
  file.describe(static_cast<std::uint64_t>(stream.size()));
  file.describe(static_cast<std::uint8_t>(unused));
  file.claim(claimOf(light.resolution.size(), light.light.size()));
  if (Status added = file.addRecords(resolutionLanes(light), light.resolution.size()); !added) return added;
  if (Status added = file.addStream(stream); !added) return added;
  return file.write(path);
}

Result<Keyed<SurfaceLight>> readLight(const std::filesystem::path& path) {
  auto file = BlockFileReader::open(path, BlockFileKind::surfaceLight);
  if (!file) return tl::unexpected(file.error());
  const auto triangles = file->described<std::uint64_t>();
  const auto samples = file->described<std::uint64_t>();
  const auto streamBytes = file->described<std::uint64_t>();
  const auto unused = file->described<std::uint8_t>();
  if (!file->describedAll()) return file->malformed("its description makes no sense");
  if (triangles > kMaxTriangles || samples > kMaxSamples || streamBytes > file->rawBytes() ||
      file->rawBytes() != kTriangleBytes * triangles + streamBytes ||
      !file->mayHold(claimOf(triangles, samples)))
    return file->malformed("its number of samples contradicts its size");
  SurfaceLight light;
  light.resolution.resize(triangles);
  light.hasBack.resize(triangles);
  if (Status read = file->nextRecords(resolutionLanes(light), triangles); !read)
    return tl::unexpected(read.error());
  light.firstSample.push_back(0);
  std::uint64_t next = 0;
  for (std::size_t t = 0; t < triangles && next <= samples; ++t) {
    const auto own = samplesOf(light, t);
    if (!own) return file->malformed(badSide(t));
    next += *own;
    light.firstSample.push_back(static_cast<std::uint32_t>(next));
  }
  if (next != samples) return file->malformed("its triangles do not have as many samples as it says");
  const auto stream = file->nextStream(streamBytes);
  if (!stream) return tl::unexpected(stream.error());
  light.light.resize(samples);
  if (Status decoded = decodeLight(*stream, unused, light); !decoded)
    return file->malformed(decoded.error().message);
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
