#pragma once
/// What the editor remembers between runs: $XDG_CONFIG_HOME/acentric/editor.json (else ~/.config). A file
/// that cannot be read, or is damaged, is as none; unknown or wrong values are left at their defaults.

#include <filesystem>
#include <vector>

#include "engine/base/result.h"

namespace acentric::editor {

struct Preferences {
  static constexpr std::size_t kMostRecent = 10;

  std::vector<std::filesystem::path> recent;  ///< projects, newest first
  std::filesystem::path lastFolder;
  int bakeThreads = 0;       ///< 0 = all but one
  int bakeMegabytes = 1536;  ///< that what is baked may take until it is written
  int walkMegabytes = 0;     ///< for captures of the walk in memory; 0 = half of the machine's
  double walkMetresPerSecond = 1.4;
  float settingsWidth = 324;  ///< pixels
  float walkWidth = 600;
  float bottomHeight = 214;

  void addRecent(const std::filesystem::path& file);
};

std::filesystem::path preferencesFile();
Preferences loadPreferences(const std::filesystem::path& file);
Status savePreferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace acentric::editor
