#include "engine/base/work_clock.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace acentric {

WorkClock::WorkClock() : atFirst_(threadsNow()) {}

WorkClock::Threads WorkClock::threadsNow() {
  Threads threads;
  const int priority = ::getpriority(PRIO_PROCESS, id_t(::gettid()));
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc/self/task", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string number = entry->path().filename().string();
    if (::getpriority(PRIO_PROCESS, id_t(std::stoul(number))) != priority) continue;
    // Nanoseconds: on a processor, and ready to run on one.
    double running = 0, waiting = 0;
    if (std::ifstream file(entry->path() / "schedstat"); file >> running >> waiting)
      threads[number] = {1e-9 * running, 1e-9 * waiting};
  }
  return threads;
}

// A thread that waits ready to run half of the time takes twice as long, and so does work on many such
// threads: the share counts, not how many threads there were. Nor is more lost than all of them waited,
// however long they rested.
double WorkClock::seconds() const {
  const double wall = wall_.seconds();
  Times sum;
  for (const auto& [number, now] : threadsNow()) {
    const auto before = atFirst_.find(number);
    const Times first = before == atFirst_.end() ? Times{} : before->second;
    sum.running += now.running - first.running, sum.waiting += now.waiting - first.waiting;
  }
  if (!(sum.running > 0 && sum.waiting > 0)) return wall;
  return wall - std::min(sum.waiting, wall * sum.waiting / (sum.running + sum.waiting));
}

}  // namespace acentric
