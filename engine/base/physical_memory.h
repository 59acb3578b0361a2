#pragma once
/// How much memory there is to share out.

#include <cstddef>

namespace acentric {

/// Bytes that this process may take: the machine's, or those of the control group it runs in if they are
/// fewer.
std::size_t physicalMemory();

/// From now on memory of a quarter MiB and more goes back to the system as soon as it is freed. What walks
/// load and evict leaves holes in the heap else, which one stream after another does not fill. For programs,
/// at their beginning.
void giveBackLargeMemory();

}  // namespace acentric
