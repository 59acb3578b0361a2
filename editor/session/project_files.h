#pragma once
/// Files around a project: its autosave, the captures beside it, and moving it to another folder.

#include <filesystem>
#include <optional>

#include "engine/pipeline/project.h"

namespace acentric::editor {

inline constexpr const char* kProjectEnding = ".acentric.json";
inline constexpr const char* kWalkEnding = ".acentric";

bool isProjectFile(const std::filesystem::path& file);
/// What is to be opened as a shipped walk where `file` was chosen: the walk itself, or a folder, also by the
/// index of the bundle in it. Empty: `file` is something else.
std::filesystem::path shippedWalkOf(const std::filesystem::path& file);
/// Where a model's project would be kept: beside it, "gallery.glb" -> "gallery.acentric.json".
std::filesystem::path suggestedProjectFile(const std::filesystem::path& model);

/// "gallery.acentric.json" -> "gallery.acentric.json.autosave"
std::filesystem::path autosaveFileFor(const std::filesystem::path& projectFile);
/// Never touches the project file itself.
Status writeAutosave(const Project& project, const std::filesystem::path& projectFile);
void removeAutosave(const std::filesystem::path& projectFile);
/// What a crashed run left behind, if it differs from `saved`; the error says that it cannot be read.
Result<std::optional<Project>> recoverableAutosave(const std::filesystem::path& projectFile,
                                                   const Project& saved);
/// Puts a file that cannot be read out of the way, "x" -> "x.damaged", so that nothing is written over it.
/// Where it lies then; empty where that failed.
std::filesystem::path putAside(const std::filesystem::path& file);
/// "walk.acentric.json" -> "walk copy.acentric.json", or the first of "walk copy 2" ... that is free.
std::filesystem::path freeCopyName(const std::filesystem::path& projectFile);

/// The same project for another file. A model that then lies outside the file's folder is brought there
/// (pipeline/collect_model.h), as a link where the cache of `host` does not know which files it has; one that
/// is gone is stated as before.
Result<Project> movedProject(const Project& project, const std::filesystem::path& from,
                             const std::filesystem::path& to, const ImportHost& host);
/// Makes the captures of `from` known to `to` (links where the disk can, else copies). Captures are found by
/// content, so ones that `to` has already are left alone. Returns how many files were added.
Result<int> shareCaptures(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace acentric::editor
