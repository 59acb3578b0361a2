#pragma once
/// Packs captures for the graphics card on a thread of its own, one after the other, so that no frame waits
/// for it. No capture is kept in memory but the one that is worked on.

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/view_gl/packed_capture.h"

namespace acentric {

class CaptureBuilder {
 public:
  struct Built {
    CaptureTask task;
    Result<PackedCapture> packed;
  };
  /// Of the usual priority: what is drawn waits for it. `wake` is called from another thread whenever
  /// something is built. While more than `mostBytesBuilt` are built and not taken, nothing else begins.
  explicit CaptureBuilder(std::function<void()> wake, std::size_t mostBytesBuilt = std::size_t(64) << 20);
  /// What is being built is given up within milliseconds.
  ~CaptureBuilder();
  CaptureBuilder(const CaptureBuilder&) = delete;
  CaptureBuilder& operator=(const CaptureBuilder&) = delete;

  /// What is to be built, the first first, instead of what was: what has begun goes on.
  void want(std::vector<CaptureTask> tasks);
  /// Gives up what is not `useful`, begun and built too.
  template <class Useful>
  void keepOnly(const Useful& useful) {
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(waiting_, [&](const CaptureTask& task) { return !useful(task); });
      std::erase_if(built_, [&](const Built& built) { return !useful(built.task); });
      if (running_ && !useful(*running_)) cancel_.request_stop();
    }
    changed_.notify_one();
  }
  /// The first that is built and that `wanted` says yes to, once.
  template <class Wanted>
  std::optional<Built> takeBuilt(const Wanted& wanted) {
    std::optional<Built> taken;
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::ranges::find_if(built_, wanted, &Built::task);
      if (found == built_.end()) return taken;
      taken = std::move(*found);
      built_.erase(found);
    }
    changed_.notify_one();
    return taken;
  }
  bool anyBuilt() const;

 private:
  bool room() const;
  /// The next, with its capture; its `cancel_` is new. Nothing when stopped.
  std::optional<CaptureTask> next(const std::stop_token& stop, std::shared_ptr<const DisplayCapture>& capture,
                                  std::stop_token& cancelled);
  void loop(const std::stop_token& stop);

  const std::function<void()> wake_;
  const std::size_t mostBytesBuilt_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<CaptureTask> waiting_;
  std::optional<CaptureTask> running_;
  std::stop_source cancel_;  ///< of running_
  std::deque<Built> built_;
  std::jthread thread_;
};

}  // namespace acentric
