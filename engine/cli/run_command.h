#pragma once
/// Runs another program to its end and takes what it says.

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric::cli {

struct CommandOutput {
  int exitCode = 0;  ///< 128 + the signal's number where one ended it
  std::string text;  ///< standard output and standard error
};

/// arguments[0] is looked up on PATH. Fails where it cannot be started.
Result<CommandOutput> runCommand(const std::vector<std::string>& arguments);

/// Is there such a program on PATH?
bool onPath(const std::string& program);

}  // namespace acentric::cli
