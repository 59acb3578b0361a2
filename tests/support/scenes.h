#pragma once
/// Where the shared scenes lie that some tests read; those are skipped where there are none.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace acentric::test {

inline std::filesystem::path scenesFolder() {
  const char* given = std::getenv("ACENTRIC_SCENES");
  return given ? std::filesystem::path(given)
               : std::filesystem::path(ACENTRIC_SOURCE_DIR) / "../shared/scenes";
}

#define ACENTRIC_NEEDS_SCENES()                                       \
  if (!std::filesystem::is_directory(acentric::test::scenesFolder())) \
  GTEST_SKIP() << "no scenes at " << acentric::test::scenesFolder() << "; set ACENTRIC_SCENES"

}  // namespace acentric::test
