#pragma once
/// What the importer process does: read a model, and say which files that took. Private to this folder.

#include "engine/scene/import.h"
#include "engine/scene/scene_file.h"

namespace acentric {

/// `memoryBytes`: that the scene may take; 0: as many as it likes.
Result<SceneFile> parseModel(const std::filesystem::path& path, const ImportOptions& options,
                             const Progress& progress, std::uint64_t memoryBytes = 0);

}  // namespace acentric
