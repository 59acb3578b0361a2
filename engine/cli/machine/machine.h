#pragma once
/// What a figure was measured on, and with.

#include <nlohmann/json.hpp>
#include <string>

namespace acentric::cli {

/// As the processor calls itself.
std::string processorName();

/// What the reports of all benches begin with: "version", "commit" (of the sources, "-dirty" where they
/// differ from it, "unknown" outside a checkout), "processor", "threads".
nlohmann::ordered_json measuredOn(int threads);

/// That all threads of this process took until now.
double processorSeconds();

}  // namespace acentric::cli
