#pragma once
/// How much memory there is to share out.

#include <cstddef>

namespace acentric {

/// Bytes that this process may take: the machine's, or those of the control group it runs in if they are
/// fewer.
std::size_t physicalMemory();

}  // namespace acentric
