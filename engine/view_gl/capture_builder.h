#pragma once
/// Readies captures for the graphics card on a thread of its own, one after the other, so that no frame waits
/// for it. No capture is kept in memory but the one that is worked on.

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/task_runner.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// `Task` has a `capture` (weak pointer), a `name` for messages and `sameAs`; `Packed`, what becomes of it,
/// has `bytes()`.
template <class Task, class Packed>
class CaptureBuilder {
 public:
  using Pack = std::function<Result<Packed>(const DisplayCapture& capture, const Task& task,
                                            TaskRunner& runner, const std::stop_token& stop)>;
  struct Built {
    Task task;
    Result<Packed> packed;
  };
  /// While more than this is built and not taken, nothing else begins.
  static constexpr std::size_t kMostBytesBuilt = std::size_t(64) << 20;

  /// On so many threads, of the usual priority: what is drawn waits for it. `wake` is called from another
  /// thread whenever something is built.
  CaptureBuilder(Pack pack, int threads, std::function<void()> wake)
      : pack_(std::move(pack)),
        threads_(threads),
        wake_(std::move(wake)),
        thread_([this](const std::stop_token& stop) { loop(stop); }) {}
  /// What is being built is given up within milliseconds.
  ~CaptureBuilder() {
    thread_.request_stop();
    {
      const std::lock_guard lock(mutex_);
      cancel_.request_stop();
    }
    thread_.join();
  }
  CaptureBuilder(const CaptureBuilder&) = delete;
  CaptureBuilder& operator=(const CaptureBuilder&) = delete;

  /// What is to be built, the first first, instead of what was: what has begun goes on.
  void want(std::vector<Task> tasks) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.clear();
      for (Task& task : tasks) {
        const auto same = [&](const Task& other) { return task.sameAs(other); };
        const bool begun = running_ && same(*running_) && !cancel_.stop_requested();
        if (!begun && std::ranges::none_of(built_, same, &Built::task)) waiting_.push_back(std::move(task));
      }
    }
    changed_.notify_one();
  }
  /// Gives up what is not `useful`, begun and built too.
  template <class Useful>
  void keepOnly(const Useful& useful) {
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(waiting_, [&](const Task& task) { return !useful(task); });
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
  bool anyBuilt() const {
    const std::lock_guard lock(mutex_);
    return !built_.empty();
  }

 private:
  bool room() const {
    std::size_t bytes = 0;
    for (const Built& built : built_) bytes += built.packed ? built.packed->bytes() : 0;
    return bytes <= kMostBytesBuilt;
  }

  /// The next, with its capture; its `cancel_` is new. Nothing when stopped.
  std::optional<Task> next(const std::stop_token& stop, std::shared_ptr<const DisplayCapture>& capture,
                           std::stop_token& cancelled) {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, stop, [this] { return !waiting_.empty() && room(); });
      if (stop.stop_requested()) return std::nullopt;
      Task task = std::move(waiting_.front());
      waiting_.pop_front();
      capture = task.capture.lock();
      if (!capture) continue;  // evicted
      running_ = std::move(task);
      cancel_ = {};
      cancelled = cancel_.get_token();
      return running_;
    }
  }

  Result<Packed> packOrTell(const DisplayCapture& capture, const Task& task, TaskRunner& runner,
                            const std::stop_token& stop) {
    try {
      return pack_(capture, task, runner, stop);
    } catch (const std::bad_alloc&) {
      return fail(ErrorKind::outOfSpace,
                  "not enough memory to ready it for the graphics card: use smaller captures", task.name);
    }
  }

  void loop(const std::stop_token& stop) {
    TaskRunner runner(threads_ - 1);
    std::shared_ptr<const DisplayCapture> capture;
    std::stop_token cancelled;
    while (std::optional<Task> task = next(stop, capture, cancelled)) {
      Result<Packed> packed = packOrTell(*capture, *task, runner, cancelled);
      capture.reset();
      bool kept = false;
      {
        const std::lock_guard lock(mutex_);
        running_.reset();
        kept = !cancelled.stop_requested();
        if (kept) built_.push_back({std::move(*task), std::move(packed)});
      }
      if (kept && wake_) wake_();
    }
  }

  const Pack pack_;
  const int threads_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Task> waiting_;
  std::optional<Task> running_;
  std::stop_source cancel_;  ///< of running_
  std::deque<Built> built_;
  std::jthread thread_;
};

}  // namespace acentric
