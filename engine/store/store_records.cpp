// The store's records: which files are still as they were written, and what was baked before.
#include <algorithm>
#include <chrono>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "engine/store/store_names.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostRecordBytes = 64 << 10;

/// What a capture or a surface light is in: one file. Nothing under the key: none.
std::vector<fs::path> filesUnder(const fs::path& folder, const ContentKey& key) {
  std::vector<fs::path> files;
  for (const fs::path& path : {packOf(folder, key), lightOf(folder, key)})
    if (isFile(path)) files.push_back(path);
  return files;
}

fs::file_time_type writtenAt(const fs::path& path) {
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  return error ? fs::file_time_type::max() : time;
}

}  // namespace

Status CaptureStore::putRecord(const ContentKey& key, std::string subject, KeyParts parts,
                               const std::optional<SampleCounts>& samples) const {
  CaptureRecord record{std::move(subject), std::move(parts), {}, samples};
  for (const fs::path& path : filesUnder(folder_, key)) {
    const auto content = hashFile(path);
    if (!content) return tl::unexpected(content.error());
    record.files.push_back({path.extension().string(), sizeOf(path), *content});
  }
  return writeTextAtomically(recordOf(folder_, key), formatRecord(record));
}

Result<CaptureRecord> CaptureStore::record(const ContentKey& key) const {
  const fs::path path = recordOf(folder_, key);
  const auto text = readText(path, kMostRecordBytes);
  if (!text) return tl::unexpected(text.error());
  return parseRecord(*text, path.string());
}

void CaptureStore::forgetRecord(const ContentKey& key) const {
  std::error_code ignored;  // if it is not there, so much the better
  fs::remove(recordOf(folder_, key), ignored);
}

std::map<std::string, CaptureRecord> CaptureStore::formerRecords(const std::vector<ContentKey>& known) const {
  struct Dated {
    fs::file_time_type written;
    ContentKey key;
    CaptureRecord record;
  };
  std::vector<ContentKey> sorted = known;
  std::ranges::sort(sorted);
  std::map<std::string, Dated> newest;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != kRecordExtension) continue;
    const auto key = ContentKey::fromHex(entry->path().stem().string());
    if (!key || std::ranges::binary_search(sorted, *key)) continue;
    auto found = record(*key);
    if (!found) continue;
    Dated dated{writtenAt(entry->path()), *key, std::move(*found)};
    const auto [at, isNew] = newest.try_emplace(dated.record.subject, dated);
    if (!isNew && std::pair(at->second.written, at->second.key) < std::pair(dated.written, dated.key))
      at->second = std::move(dated);
  }
  std::map<std::string, CaptureRecord> records;
  for (auto& [subject, dated] : newest) records.emplace(subject, std::move(dated.record));
  return records;
}

Result<CaptureStore::Inspected> CaptureStore::inspect(const ContentKey& key, bool toTheEnd,
                                                      const std::stop_token& stop) const {
  const std::vector<fs::path> files = filesUnder(folder_, key);
  Inspected found;
  if (files.empty()) {
    for (const fs::path& path : {packOf(folder_, key), lightOf(folder_, key)})
      if (isFile(path.string() + kDamagedExtension))
        found.damage.push_back({ErrorKind::malformed, "was damaged and is set aside", path.string()});
    if (!found.damage.empty()) found.condition = Condition::damaged;
    return found;
  }
  const auto noted = record(key);
  found.recorded = noted.has_value() && noted->files.size() == files.size();
  if (!noted && noted.error().kind != ErrorKind::notFound) found.recordDamage = noted.error();
  if (noted && !found.recorded)
    found.recordDamage =
        Error{ErrorKind::malformed, "is of other files than there are", recordOf(folder_, key).string()};
  found.condition = Condition::sound;
  const auto damaged = [&](Error error) {
    found.condition = Condition::damaged;
    found.damage.push_back(std::move(error));
  };
  if (toTheEnd || !found.recorded)
    for (Error& error : check(key, stop)) {
      if (!isDamage(error)) return tl::unexpected(std::move(error));
      damaged(std::move(error));
    }
  if (!found.recorded || !found.damage.empty()) return found;
  const fs::path recordPath = recordOf(folder_, key);
  const auto recorded = writtenAt(recordPath);
  bool hashed = false;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const FileRecord& was = noted->files[f];
    const fs::path& path = files[f];
    if (was.extension != path.extension() || was.bytes != sizeOf(path)) {
      damaged(
          {ErrorKind::malformed, "is damaged: it has another size than when it was written", path.string()});
    } else if (toTheEnd || writtenAt(path) > recorded) {
      hashed = true;
      const auto content = hashFile(path);
      if (!content) return tl::unexpected(content.error());
      if (*content != was.content)
        damaged({ErrorKind::malformed, "is damaged: its content is not what was written", path.string()});
    }
  }
  // Files that are as they were need not be hashed the next time. Who asked for all to be read changes
  // nothing.
  std::error_code ignored;
  if (hashed && !toTheEnd && found.damage.empty())
    fs::last_write_time(recordPath, std::max(recorded, fs::file_time_type::clock::now()), ignored);
  return found;
}

}  // namespace acentric
