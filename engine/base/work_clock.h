#pragma once
/// Seconds that work takes while nothing else runs on the machine: wall-clock time, less the share for which
/// its threads waited for a processor: those of this process with the priority of the thread that asks, so
/// that a window's threads do not count for work in the background. What other work does to caches and memory
/// stays in it.

#include <map>
#include <string>

#include "engine/base/stopwatch.h"

namespace acentric {

/// Begins when it is made. Where the system does not tell of waiting threads (Linux does), a Stopwatch.
class WorkClock {
 public:
  WorkClock();
  double seconds() const;

 private:
  struct Times {
    double running = 0, waiting = 0;  ///< seconds
  };
  using Threads = std::map<std::string, Times>;  ///< by number
  static Threads threadsNow();

  Threads atFirst_;
  Stopwatch wall_;
};

}  // namespace acentric
