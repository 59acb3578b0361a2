#pragma once
/// Small files of the editor's own, beside its unsaved work: preferences, places of windows.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/base/result.h"

namespace acentric::editor {

/// As a whole or not at all; makes the folder. Names that are not UTF-8 are replaced rather than refused:
/// losing one entry is no reason to fail.
Status saveSettings(const nlohmann::json& settings, const std::filesystem::path& file);

}  // namespace acentric::editor
