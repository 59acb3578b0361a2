#include "engine/store/capture_store.h"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "engine/base/file.h"
#include "engine/base/link_file.h"
#include "engine/store/keyed.h"
#include "engine/store/store_names.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

void setAside(const fs::path& path) {
  std::error_code ignored;  // if it cannot be renamed, reading it fails the same way next time
  fs::rename(path, path.string() + kDamagedExtension, ignored);
}

/// A file made for another key is as useless as a damaged one.
template <class Value>
Result<Keyed<Value>> expectKey(Result<Keyed<Value>>&& read, const ContentKey& key, const fs::path& path) {
  if (read && read->key != key)
    return fail(ErrorKind::malformed,
                "was made for key " + read->key.toHex() + ", not for the one in its name", path.string());
  return std::move(read);
}

/// What one file holds as a whole; set aside if damaged.
template <class Value>
Result<Value> getWhole(const ContentKey& key, const fs::path& path,
                       Result<Keyed<Value>> (*readKeyed)(const fs::path&)) {
  if (!isFile(path)) return fail(ErrorKind::notFound, "is not baked", path.string());
  auto whole = expectKey(readKeyed(path), key, path);
  if (!whole && isDamage(whole.error())) {
    setAside(path);
    return fail(ErrorKind::malformed,
                "is damaged and was set aside as *.damaged; bake again (" + whole.error().message + ")",
                path.string());
  }
  return withoutKey(std::move(whole));
}

/// The key in the name of one of the store's files (also of one set aside).
std::optional<ContentKey> keyInName(const fs::path& path) {
  fs::path name = path.filename();
  if (name.extension() == kDamagedExtension) name = name.stem();
  std::string stem = name.stem().string();
  if (name.extension() == kLightExtension && stem.starts_with(kLightPrefix))
    stem.erase(0, kLightPrefix.size());
  else if (name.extension() == kLightPartExtension && stem.starts_with(kLightPrefix))
    stem = stem.substr(kLightPrefix.size(), stem.find('.') - kLightPrefix.size());
  else if (name.extension() == kSimplifiedExtension && stem.starts_with(kSimplifiedPrefix))
    stem.erase(0, kSimplifiedPrefix.size());
  else if (name.extension() != kPackExtension && name.extension() != kRecordExtension)
    return std::nullopt;
  const auto key = ContentKey::fromHex(stem);
  return key ? std::optional(*key) : std::nullopt;
}

}  // namespace

Result<CaptureStore> CaptureStore::open(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    return fail(ErrorKind::unreadable, "cannot be used as the folder of captures: " + error.message(),
                folder.string());
  removeStaleTemporaries(folder);
  return CaptureStore(folder);
}

bool CaptureStore::has(const ContentKey& key) const { return isFile(packOf(folder_, key)); }

Status CaptureStore::put(const ContentKey& key, const Capture& capture, const std::stop_token& stop,
                         int colourQuality) const {
  return writeCodedPack(capture, key, packOf(folder_, key), colourQuality, stop);
}

std::filesystem::path CaptureStore::packFile(const ContentKey& key) const { return packOf(folder_, key); }

std::filesystem::path CaptureStore::fileOf(const ContentKey& key, const std::string& extension) const {
  if (extension == kLightExtension) return lightOf(folder_, key);
  if (extension == kSimplifiedExtension) return simplifiedOf(folder_, key);
  return folder_ / (key.toHex() + extension);
}

Result<Capture> CaptureStore::get(const ContentKey& key) const {
  return getWhole(key, packOf(folder_, key), readKeyedCapturePack);
}

Status CaptureStore::adopt(const ContentKey& key, const CaptureStore& from) const {
  // The record last: what has one was taken over to the end.
  for (const auto fileOf : {packOf, lightOf, recordOf}) {
    const fs::path source = fileOf(from.folder_, key), target = fileOf(folder_, key);
    if (!isFile(source) || isFile(target)) continue;
    if (Status there = linkOrCopyFile(source, target); !there) return there;
  }
  return {};
}

bool CaptureStore::hasSurfaceLight(const ContentKey& key) const { return isFile(lightOf(folder_, key)); }

Status CaptureStore::putSurfaceLight(const ContentKey& key, const SurfaceLight& light,
                                     const std::stop_token& stop) const {
  return writeSurfaceLight(light, key, lightOf(folder_, key), stop);
}

Result<SurfaceLight> CaptureStore::getSurfaceLight(const ContentKey& key) const {
  return getWhole(key, lightOf(folder_, key), readKeyedSurfaceLight);
}

bool CaptureStore::hasSimplified(const ContentKey& key) const { return isFile(simplifiedOf(folder_, key)); }

Status CaptureStore::putSimplified(const ContentKey& key, const SimplifiedLocal& simplified) const {
  return writeSimplified(simplified, key, simplifiedOf(folder_, key));
}

Result<SimplifiedLocal> CaptureStore::getSimplified(const ContentKey& key) const {
  return getWhole(key, simplifiedOf(folder_, key), readKeyedSimplified);
}

std::vector<Error> CaptureStore::check(const ContentKey& key, const std::stop_token& stop) const {
  std::vector<Error> problems;
  const auto look = [&](const fs::path& path, const auto& readKeyed) {
    if (!isFile(path)) return;
    if (stop.stop_requested()) {
      problems.push_back({ErrorKind::cancelled, "reading was stopped", path.string()});
      return;
    }
    if (auto read = expectKey(readKeyed(path), key, path); !read) problems.push_back(std::move(read.error()));
  };
  look(packOf(folder_, key), readKeyedCapturePack);
  look(lightOf(folder_, key), readKeyedSurfaceLight);
  look(simplifiedOf(folder_, key), readKeyedSimplified);
  return problems;
}

std::uint64_t CaptureStore::bytesOf(const ContentKey& key) const {
  return sizeOf(packOf(folder_, key)) + sizeOf(lightOf(folder_, key)) + sizeOf(simplifiedOf(folder_, key));
}

std::uint64_t CaptureStore::prune(const std::vector<ContentKey>& keep) const {
  std::uint64_t freed = 0;
  std::error_code error;
  std::vector<fs::path> doomed;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    const auto key = keyInName(entry->path());
    const bool setAsideBefore = entry->path().extension() == kDamagedExtension;
    const bool doneWith = key && entry->path().extension() == kLightPartExtension && hasSurfaceLight(*key);
    if (key && (setAsideBefore || doneWith || std::find(keep.begin(), keep.end(), *key) == keep.end()))
      doomed.push_back(entry->path());
  }
  for (const fs::path& path : doomed) {
    const std::uint64_t size = sizeOf(path);
    if (fs::remove(path, error)) freed += size;
  }
  return freed;
}

}  // namespace acentric
