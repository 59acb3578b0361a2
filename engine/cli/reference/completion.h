#pragma once
/// Completion of a command line by shells: commands, options, their choices, and files where they are taken.

#include <functional>
#include <string>

#include "engine/cli/reference/reference.h"

namespace acentric::cli {

std::string bashCompletion(const ReferenceCommand& program);
std::string fishCompletion(const ReferenceCommand& program);
std::string zshCompletion(const ReferenceCommand& program);

/// Commands below it, then itself.
void forEachCommand(const ReferenceCommand& command, const std::function<void(const ReferenceCommand&)>& act);
std::vector<std::string> lastNamesBelow(const ReferenceCommand& command);
/// "_acentric_bench_walk_growth".
std::string functionNameOf(const ReferenceCommand& command);
/// On one line in single quotes, with `quote` for one.
std::string inQuotes(const std::string& text, const char* quote);

}  // namespace acentric::cli
