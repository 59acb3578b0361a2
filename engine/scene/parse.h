#pragma once
/// What the importer process does: read a model, and say which files that took. Private to this folder.

#include "engine/scene/import.h"
#include "engine/scene/scene_file.h"

namespace acentric {

Result<SceneFile> parseModel(const std::filesystem::path& path, const ImportOptions& options,
                             const Progress& progress);

}  // namespace acentric
