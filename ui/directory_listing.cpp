#include "ui/directory_listing.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric::ui {

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return text;
}

bool endsWithAny(const std::string& name, const std::vector<std::string>& endings) {
  if (endings.empty()) return true;
  const std::string lower = lowerCase(name);
  return std::any_of(endings.begin(), endings.end(),
                     [&lower](const std::string& ending) { return lower.ends_with(ending); });
}

DirectoryListing listDirectory(const std::filesystem::path& folder, const std::vector<std::string>& endings,
                               bool showHidden) {
  namespace fs = std::filesystem;
  DirectoryListing listing;
  std::error_code error;
  fs::directory_iterator it(folder, fs::directory_options::none, error);
  if (error) {
    listing.problem = fmt::format("{}: {}", folder.string(), error.message());
    return listing;
  }
  for (; it != fs::directory_iterator(); it.increment(error)) {
    if (error) break;
    std::error_code ignored;  // a broken link is simply not a folder
    DirectoryEntry entry{it->path().filename().string(), it->is_directory(ignored), 0};
    if (!showHidden && entry.name.starts_with('.')) continue;
    if (!entry.folder) {
      if (!endsWithAny(entry.name, endings)) continue;
      const auto bytes = it->file_size(ignored);
      entry.bytes = ignored ? 0 : std::uint64_t(bytes);
    }
    listing.entries.push_back(std::move(entry));
  }
  if (error) listing.problem = fmt::format("{}: {}", folder.string(), error.message());
  std::sort(listing.entries.begin(), listing.entries.end(),
            [](const DirectoryEntry& a, const DirectoryEntry& b) {
              if (a.folder != b.folder) return a.folder;
              const std::string lowerA = lowerCase(a.name);
              const std::string lowerB = lowerCase(b.name);
              return lowerA != lowerB ? lowerA < lowerB : a.name < b.name;
            });
  return listing;
}

}  // namespace acentric::ui
