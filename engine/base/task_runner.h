#pragma once
/// Runs independent pieces of work on a fixed number of threads. Injected by reference, never global.
/// Zero workers run everything inline on the caller, in index order: tests are then deterministic.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "engine/base/gate.h"

namespace acentric {

class TaskRunner {
 public:
  /// `workers` extra threads; the calling thread works too, so `threads() == workers + 1`. Each piece of work
  /// passes `gate`, if there is one, before it begins; it outlives the runner.
  explicit TaskRunner(int workers = 0, const Gate* gate = nullptr);
  ~TaskRunner();
  TaskRunner(const TaskRunner&) = delete;
  TaskRunner& operator=(const TaskRunner&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls `body(index)` once for each index in [0, count), in any order, and returns when all are done.
  /// Not re-entrant: a body must not call parallelFor on the same runner. Bodies do not throw.
  void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void workerLoop(std::stop_token stop);
  void drain();

  const Gate* gate_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable done_;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::size_t running_ = 0;
  std::vector<std::jthread> workers_;
};

}  // namespace acentric
