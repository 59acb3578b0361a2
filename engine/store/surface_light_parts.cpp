// Parts of a surface light that is being baked.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <numeric>
#include <stdexcept>

#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/keyed.h"
#include "engine/store/store_names.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostPartSamples = std::uint64_t(1) << 31;

template <class AnyPart>
auto runLanes(AnyPart& part) {
  return std::array{laneOf(part.runs), laneOf(part.sizes)};
}
template <class AnyPart>
auto sampleLanes(AnyPart& part) {
  return std::array{laneOf(part.light, 0, 2), laneOf(part.light, 2, 2), laneOf(part.light, 4, 2),
                    laneOf(part.light, 6, 2)};
}

Status checkPart(const SurfaceLightPart& part) {
  const auto malformed = [](const char* message) {
    return fail(ErrorKind::malformed, message, "part of a surface light");
  };
  if (part.runs.size() != part.sizes.size()) return malformed("its tables have different lengths");
  const auto total = std::accumulate(part.sizes.begin(), part.sizes.end(), std::uint64_t(0));
  if (total != part.light.size()) return malformed("its sizes do not span the samples");
  const bool sound = std::ranges::all_of(
      part.light, [](const HalfColour& c) { return c.r < 0x7c00 && c.g < 0x7c00 && c.b < 0x7c00; });
  return sound ? Status() : malformed("light must be finite and >= 0");
}

Status writePart(const SurfaceLightPart& part, const ContentKey& key, const fs::path& path) {
  if (Status sound = checkPart(part); !sound) return sound;
  BlockFileWriter file(BlockFileKind::surfaceLightPart, key);
  file.describe(static_cast<std::uint64_t>(part.runs.size()));
  file.describe(static_cast<std::uint64_t>(part.light.size()));
  if (Status added = file.addRecords(runLanes(part), part.runs.size()); !added) return added;
  if (Status added = file.addRecords(sampleLanes(part), part.light.size()); !added) return added;
  return file.write(path);
}

Result<Keyed<SurfaceLightPart>> readPart(const fs::path& path) {
  auto file = BlockFileReader::open(path, BlockFileKind::surfaceLightPart);
  if (!file) return tl::unexpected(file.error());
  const auto runs = file->described<std::uint64_t>();
  const auto samples = file->described<std::uint64_t>();
  if (!file->describedAll()) return file->malformed("its description makes no sense");
  if (runs > kMostPartSamples || samples > kMostPartSamples || file->rawBytes() != 8 * runs + 8 * samples)
    return file->malformed("its number of samples contradicts its size");
  SurfaceLightPart part;
  part.runs.resize(runs);
  part.sizes.resize(runs);
  part.light.resize(samples);
  if (Status read = file->nextRecords(runLanes(part), runs); !read) return tl::unexpected(read.error());
  if (Status read = file->nextRecords(sampleLanes(part), samples); !read) return tl::unexpected(read.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  if (Status sound = checkPart(part); !sound) return file->malformed(sound.error().describe());
  return Keyed<SurfaceLightPart>{file->key(), std::move(part)};
}

std::vector<fs::path> partsOf(const fs::path& folder, const ContentKey& key) {
  const std::string start = lightPartOf(folder, key, "").stem().string();
  std::vector<fs::path> parts;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == kLightPartExtension &&
        entry->path().filename().string().starts_with(start))
      parts.push_back(entry->path());
  std::ranges::sort(parts);
  return parts;
}

}  // namespace

Status writeSurfaceLightPart(const SurfaceLightPart& part, const ContentKey& key, const fs::path& path) {
  return withinMemory(path, [&] { return writePart(part, key, path); });
}

Result<Keyed<SurfaceLightPart>> readKeyedSurfaceLightPart(const fs::path& path) {
  return withinMemory(path, [&] { return readPart(path); });
}

Status CaptureStore::putSurfaceLightPart(const ContentKey& key, const SurfaceLightPart& part) const {
  if (part.runs.empty()) return {};
  const std::string name = fmt::format("{}-{}", part.runs.front(), part.runs.size());
  return writeSurfaceLightPart(part, key, lightPartOf(folder_, key, name));
}

std::vector<SurfaceLightPart> CaptureStore::getSurfaceLightParts(const ContentKey& key) const {
  std::vector<SurfaceLightPart> parts;
  for (const fs::path& path : partsOf(folder_, key)) {
    auto part = readKeyedSurfaceLightPart(path);
    std::error_code ignored;
    if (part && part->key == key)
      parts.push_back(std::move(part->value));
    else if (part || isDamage(part.error()))
      fs::remove(path, ignored);
  }
  return parts;
}

void CaptureStore::forgetSurfaceLightParts(const ContentKey& key) const {
  std::error_code ignored;  // what cannot be removed now is when the store is pruned
  for (const fs::path& path : partsOf(folder_, key)) fs::remove(path, ignored);
}

}  // namespace acentric
