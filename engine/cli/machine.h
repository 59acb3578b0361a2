#pragma once
/// What a figure was measured on.

#include <string>

namespace acentric::cli {

/// As the processor calls itself.
std::string processorName();

}  // namespace acentric::cli
