#include "engine/base/physical_memory.h"

#include <malloc.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace acentric {

std::size_t physicalMemory() {
  constexpr long kAtLeast = 1;  // where the system does not tell
  std::size_t bytes =
      std::size_t(std::max(::sysconf(_SC_PHYS_PAGES), kAtLeast)) * std::size_t(::sysconf(_SC_PAGESIZE));
  std::size_t most = 0;  // stays 0 where the group's file says "max" or is not there
  if (std::ifstream group("/sys/fs/cgroup/memory.max"); group >> most) bytes = std::min(bytes, most);
  return bytes;
}

void giveBackLargeMemory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, 256 << 10);
#endif
}

}  // namespace acentric
