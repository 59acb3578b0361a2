#pragma once
/// Random edits, of every command that there is (editor/commands).

#include <random>
#include <string>
#include <vector>

#include "editor/commands/edit.h"

namespace acentric::editor {

using Random = std::mt19937;

struct GeneratedCommand {
  const char* name;  ///< of the function
  Edit (*make)(const Project&, Random&);
};

/// One for each function of editor/commands that gives an Edit. A new command needs an entry here: its name,
/// and how to call it with values that a user could give, some of them out of range.
const std::vector<GeneratedCommand>& generatedCommands();

}  // namespace acentric::editor
