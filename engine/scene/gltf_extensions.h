#pragma once
/// Which extensions of glTF are played, and what a file loses of those that are not. Private to this folder.

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

class ReportLines;

/// Refuses a file that requires what is not played; of what it merely uses, says what is lost.
Status checkExtensions(const std::vector<std::string>& required, const std::vector<std::string>& used,
                       ReportLines& ignored);

}  // namespace acentric
