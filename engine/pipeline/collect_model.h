#pragma once
/// A project's model lies in the folder of its file or below it, so that the folder can be moved, shared and
/// kept as a whole. A model that lies elsewhere is brought there, with the files that it names.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/base/progress.h"
#include "engine/pipeline/project.h"

namespace acentric {

/// A model's way from the project's folder; the error says that it lies outside.
Result<std::filesystem::path> scenePathFor(const std::filesystem::path& model,
                                           const std::filesystem::path& projectFile);

enum class Collect {
  files,  ///< its files: hard links where the disk can, else copies
  link,   ///< a symbolic link to the model where it lies: nothing to copy, nothing to move along
};

struct CollectedModel {
  std::filesystem::path scene;   ///< as the project states it
  std::filesystem::path folder;  ///< that was made; empty: the model lay there already
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  /// Hidden files, and what lies neither below the model's folder nor beside it: not brought along, since a
  /// model must not decide what of a disk is shared.
  std::vector<std::filesystem::path> left;
};

/// The model as it lies in the project's folder, or brought to models/NAME below that. `files`: the model's,
/// itself first, as importedFiles() gives them; for a link they are not needed.
Result<CollectedModel> collectModel(const std::filesystem::path& model,
                                    const std::filesystem::path& projectFile,
                                    const std::vector<std::filesystem::path>& files, Collect how);

/// The same for a model whose files are not known: imports it first.
Result<CollectedModel> collectModel(const std::filesystem::path& model,
                                    const std::filesystem::path& projectFile, const ImportOptions& import,
                                    Collect how, const ImportHost& host, const Progress& progress = {},
                                    std::stop_token stop = {});

/// What a project file states as its model where that is refused because it leaves the project's folder;
/// nothing where it does not, or where the file is none.
std::optional<std::filesystem::path> sceneOutside(const std::filesystem::path& projectFile);

/// Brings a project's model into its folder (also one that it reaches by a link), and writes the project so.
/// All else in the file is read as ever.
Result<CollectedModel> collectProject(const std::filesystem::path& projectFile, Collect how,
                                      const ImportHost& host, const Progress& progress = {},
                                      std::stop_token stop = {});

}  // namespace acentric
