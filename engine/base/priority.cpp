#include "engine/base/priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace acentric {

void lowerThreadPriority() {
  constexpr int kBackground = 10;
  // Linux keeps this by thread, and hands it on; refused it changes nothing but the speed of others.
  (void)::setpriority(PRIO_PROCESS, id_t(::gettid()), kBackground);
}

}  // namespace acentric
