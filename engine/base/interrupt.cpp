#include "engine/base/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace acentric {

std::stop_token stopOnInterrupt() {
  // Signals are taken by a thread of their own, so that no handler runs code that is unsafe in one.
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::stop_source source;
  std::thread([source, signals]() mutable {
    int signal = 0;
    sigwait(&signals, &signal);
    source.request_stop();
    // One that follows at once is the same: timeout(1) sends it to the process and to its group.
    const auto first = std::chrono::steady_clock::now();
    do sigwait(&signals, &signal);
    while (std::chrono::steady_clock::now() - first < std::chrono::milliseconds(500));
    ::_exit(130);
  }).detach();
  return source.get_token();
}

}  // namespace acentric
