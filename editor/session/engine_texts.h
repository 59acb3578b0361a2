#pragma once
/// Texts that the engine, which has no catalogue, makes and the editor shows in other languages. Which ones:
/// engine_names.h, engine_import.h, engine_errors.h, engine_walk_errors.h.

#include <string>

#include "engine/base/result.h"

namespace acentric::editor {

/// What the engine says in the language in force, if it is in these lists, or is such texts with ", " between
/// them, or is an error behind "place: ". What is unknown in it stays English. Safe from any thread; a text
/// that was asked for before is found at once.
std::string engineText(const std::string& english);

/// One line for a person, as Error::describe() makes it.
std::string engineText(const Error& error);

}  // namespace acentric::editor
