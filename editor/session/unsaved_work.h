#pragma once
/// Autosaves of projects that have no file of their own yet: kept in a folder of the user's, one for each
/// editor and project. What a process left that is gone is offered at the next start.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/pipeline/project.h"

namespace acentric::editor {

struct UnsavedWork {
  std::filesystem::path autosave;
  std::filesystem::path projectFile;  ///< where it would be saved
  std::string since;                  ///< local time, of its last autosave
  Project project;
};

/// $XDG_STATE_HOME/acentric/unsaved, else ~/.local/state/acentric/unsaved; empty without a home.
std::filesystem::path unsavedWorkFolder();
/// Of this process.
std::filesystem::path unsavedWorkFile(const std::filesystem::path& folder,
                                      const std::filesystem::path& projectFile);
Status writeUnsavedWork(const std::filesystem::path& folder, const std::filesystem::path& projectFile,
                        const Project& project);
Result<UnsavedWork> readUnsavedWork(const std::filesystem::path& autosave);
struct UnsavedWorks {
  std::vector<UnsavedWork> works;  ///< of processes that are gone, newest first
  std::vector<std::filesystem::path> damaged;
};
UnsavedWorks listUnsavedWork(const std::filesystem::path& folder);

}  // namespace acentric::editor
