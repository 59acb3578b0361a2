#pragma once
/// A sweep as one HTML file that needs nothing else: plots, a table, the worst frames.

#include <filesystem>
#include <string>

#include "engine/measure/sweep.h"

namespace acentric {

/// `folder`: where the pictures that the points name are. Those that are not there are left out.
Result<std::string> sweepReport(const Sweep& sweep, const std::filesystem::path& folder);

/// A page of that look around `body`, which is HTML.
std::string reportPage(const std::string& title, const std::string& body);

}  // namespace acentric
