#pragma once
/// Programs in processes of their own.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

/// Where what a program writes goes; nowhere unless told.
struct SpawnOutputs {
  int output = -1;                 ///< an open descriptor
  std::filesystem::path errors{};  ///< a file, begun anew
  bool together = false;           ///< errors go where the output goes
};

/// Starts `arguments[0]`, a file or a program on PATH, with the others; reads nothing, and signals mean to it
/// what they usually do. Whoever calls waits for it.
Result<pid_t> spawnProgram(const std::vector<std::string>& arguments, const SpawnOutputs& outputs);

}  // namespace acentric
