#pragma once
/// Who may include what. The engine's order is read from engine/CMakeLists.txt, so it is written once: a
/// folder may include itself and the folders listed before it. Third-party headers each have a home.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

struct Include {
  std::string file;    ///< path from the root, with '/'
  int line = 0;        ///< 1-based
  std::string target;  ///< what stands between the quotes or brackets
  bool quoted = false;
};

/// Every #include of C++ and C sources below `root`/engine, ui and editor, in order of path and line.
Result<std::vector<Include>> scanIncludes(const std::filesystem::path& root);

struct EngineFolder {
  std::string name;
  int level = 0;
};

/// From lines "add_subdirectory(NAME) # LEVEL" of engine/CMakeLists.txt, in their order.
/// Fails where a line has no level or the levels do not ascend.
Result<std::vector<EngineFolder>> readEngineOrder(const std::filesystem::path& root);

/// One line for each include that breaks a rule: "engine/base/a.cpp:3: includes ...: why".
std::vector<std::string> findViolations(const std::filesystem::path& root,
                                        const std::vector<Include>& includes,
                                        const std::vector<EngineFolder>& order);

}  // namespace acentric
