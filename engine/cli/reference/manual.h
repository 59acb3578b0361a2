#pragma once
/// Manual pages of a command line, in the macros of man(7).

#include <string>
#include <utility>
#include <vector>

#include "engine/cli/reference/reference.h"

namespace acentric::cli {

/// Names ("acentric-bake") with their texts: the program's, which lists its commands, and one for each of
/// them.
std::vector<std::pair<std::string, std::string>> manualPages(const ReferenceCommand& program,
                                                             const std::string& exitStatus);

}  // namespace acentric::cli
