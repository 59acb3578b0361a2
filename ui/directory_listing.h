#pragma once
/// What a file dialog shows of a folder. No window needed.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace acentric::ui {

struct DirectoryEntry {
  std::string name;
  bool folder = false;
  std::uint64_t bytes = 0;
};

struct DirectoryListing {
  std::vector<DirectoryEntry> entries;  ///< folders first, then files, each by name without regard to case
  std::string problem;                  ///< why it could not be read, else empty
};

/// Files are kept when their name ends with one of `endings` (".glb", lower case; none given = all). Hidden
/// entries are left out unless asked for.
DirectoryListing listDirectory(const std::filesystem::path& folder, const std::vector<std::string>& endings,
                               bool showHidden = false);

bool endsWithAny(const std::string& name, const std::vector<std::string>& endings);  ///< case does not matter
std::string lowerCase(std::string text);                                             ///< ASCII letters only

}  // namespace acentric::ui
