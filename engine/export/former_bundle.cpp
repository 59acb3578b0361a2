#include "engine/export/former_bundle.h"

#include <algorithm>
#include <array>

#include "engine/base/link_file.h"
#include "engine/export/bundle_read.h"
#include "engine/image/colour_quality.h"

namespace acentric {

namespace fs = std::filesystem;

std::string captureName(const ContentKey& key, std::uint8_t roles, int colourQuality, float exposure) {
  constexpr int kRecipe = 1;  // of how captures are made from those of the store
  Hasher hasher;
  hasher.value(kRecipe).value(kBundleVersion).value(key.high).value(key.low).value(colourQuality);
  if (colourQuality < kLosslessColours) hasher.value(roles).value(exposure);
  return hasher.finish().toHex();
}

FormerBundle::FormerBundle(const fs::path& folder) : folder_(folder) {
  if (folder.empty()) return;
  const auto bundle = readBundle(folder);
  if (!bundle) return;
  features_ = bundle->features;
  for (const BundleStorey& storey : bundle->storeys)
    for (const BundleCamera& camera : storey.cameras)
      if (const auto& best = camera.full ? camera.full : camera.coarse)
        cameras_.emplace(best->file.path, camera);
}

bool FormerBundle::give(const std::string& path, const fs::path& folder, BundleCamera& camera) const {
  const auto found = cameras_.find(path);
  if (found == cameras_.end()) return false;
  const std::array renditions = {&found->second.full, &found->second.coarse};
  if (!std::ranges::all_of(renditions, [&](const auto* one) { return !*one || give((*one)->file, folder); }))
    return false;
  camera = found->second;
  return true;
}

bool FormerBundle::give(const BundleFile& file, const fs::path& folder) const {
  const fs::path to = folder / file.path;
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!linkOrCopyFile(folder_ / file.path, to)) return false;
  const auto hash = hashFile(to);
  if (hash && *hash == file.hash && fs::file_size(to, error) == file.bytes) return true;
  fs::remove(to, error);
  return false;
}

}  // namespace acentric
