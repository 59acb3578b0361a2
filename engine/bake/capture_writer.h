#pragma once
/// Hands finished captures to the sink on a thread of its own, so that the next camera is traced while the
/// last is compressed and written. What waits or is being written is counted against a budget: beyond its
/// limit the bake waits, and memory stays bounded. A capture that is larger by itself goes alone. After a
/// stop what waits is still written for a moment; what is not done by then is given up, and was traced in
/// vain.

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "engine/bake/bake.h"

namespace acentric {

class CaptureWriter {
 public:
  CaptureWriter(CaptureSink& sink, MemoryBudget& budget, std::stop_token stop = {});
  ~CaptureWriter();  ///< finishes
  CaptureWriter(const CaptureWriter&) = delete;
  CaptureWriter& operator=(const CaptureWriter&) = delete;

  /// Waits while there is no room. The first error that the sink does not pass over comes back here, and
  /// nothing is written after it. `cancelled` when stopped.
  Status put(const ContentKey& key, Capture capture);
  /// Waits until all is written, or stopped and given up.
  Status finish();

 private:
  struct Job {
    ContentKey key;
    Capture capture;
    MemoryBudget::Share held;
  };
  void loop();
  Status status() const;  ///< with mutex_ held

  CaptureSink& sink_;
  std::stop_token stop_;
  std::stop_source giveUp_;  ///< what is being written
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> waiting_;
  MemoryBudget& budget_;
  int unfinished_ = 0;  ///< that wait or are being written
  bool closed_ = false;
  std::optional<Error> error_;
  std::jthread thread_;
};

}  // namespace acentric
