#include "engine/base/large_vector.h"

#include <sys/mman.h>

namespace acentric {

void adviseLargePages(void* memory, std::size_t bytes) {
  // Advice: where it is not taken the pages are small ones.
  (void)madvise(memory, bytes, MADV_HUGEPAGE);
}

}  // namespace acentric
