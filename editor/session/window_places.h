#pragma once
/// Where the window was left on each monitor, kept between runs in $XDG_STATE_HOME/acentric/windows.json
/// (else
/// ~/.local/state). A file that cannot be read, or is damaged, is as none.

#include <filesystem>
#include <vector>

#include "engine/base/result.h"
#include "ui/window_place.h"

namespace acentric::editor {

std::filesystem::path windowPlacesFile();  ///< empty without a home: nothing is kept
/// Newest first. Entries that are not whole are left out.
std::vector<ui::WindowPlace> loadWindowPlaces(const std::filesystem::path& file);
/// Beside what is known of other monitors; written as a whole, or not at all.
Status keepWindowPlace(const ui::WindowPlace& place, const std::filesystem::path& file);

}  // namespace acentric::editor
