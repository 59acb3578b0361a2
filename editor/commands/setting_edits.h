#pragma once
/// Edits of everything that is not the layout. Pure: project in, edit out.

#include <optional>

#include "editor/commands/edit.h"
#include "engine/pipeline/bake_presets.h"

namespace acentric::editor {

/// Any change of bake or view settings, named by the field that changed.
Edit setBakeSettings(const Project& project, const BakeSettings& bake, const char* field);
/// All of the bake's settings that trade accuracy for time and bytes.
Edit setBakePreset(const Project& project, BakePreset preset);
Edit setBudget(const Project& project, const TriangleBudget& budget, const char* field);
Edit setViewSettings(const Project& project, const ViewSettings& view, const char* field);
Edit setFieldOfView(const Project& project, double degreesValue);
Edit setExposure(const Project& project, float exposure);
Edit setSpawn(const Project& project, const Spawn& spawn);
/// Nothing: as the scene calls for.
Edit setEffect(const Project& project, Effect effect, std::optional<bool> override);
/// Another model file: relative to the project file's folder.
Edit setScene(const Project& project, const std::filesystem::path& scene);
Edit setImport(const Project& project, const ImportOptions& import, const char* field);

}  // namespace acentric::editor
