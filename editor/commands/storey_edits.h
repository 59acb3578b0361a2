#pragma once
/// Edits of a project's storeys. Pure: project in, edit out.

#include <optional>

#include "editor/commands/edit.h"

namespace acentric::editor {

/// The storey that is worked on, and where the walk begins.
Edit showStorey(const Project& project, int storey);
/// The next storey above (`steps` 1) or below (-1) by floor height, past pieces of stairs; nothing at the
/// ends.
std::optional<int> storeyBeside(const Project& project, int steps);
Edit renameStorey(const Project& project, std::string name);
/// The current one; a project keeps at least one.
Edit removeStorey(const Project& project);

}  // namespace acentric::editor
