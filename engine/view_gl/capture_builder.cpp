#include "engine/view_gl/capture_builder.h"

#include <new>

namespace acentric {
namespace {

Result<PackedCapture> packOrTell(const DisplayCapture& capture, const CaptureTask& task,
                                 const std::stop_token& stop) {
  try {
    return packCapture(capture, task, stop);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace,
                "not enough memory to ready it for the graphics card: use smaller captures", task.name);
  }
}

}  // namespace

CaptureBuilder::CaptureBuilder(std::function<void()> wake, std::size_t mostBytesBuilt)
    : wake_(std::move(wake)),
      mostBytesBuilt_(mostBytesBuilt),
      thread_([this](const std::stop_token& stop) { loop(stop); }) {}

CaptureBuilder::~CaptureBuilder() {
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    cancel_.request_stop();
  }
  thread_.join();
}

void CaptureBuilder::want(std::vector<CaptureTask> tasks) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    for (CaptureTask& task : tasks) {
      const auto same = [&](const CaptureTask& other) { return task.sameAs(other); };
      const bool begun = running_ && same(*running_) && !cancel_.stop_requested();
      if (!begun && std::ranges::none_of(built_, same, &Built::task)) waiting_.push_back(std::move(task));
    }
  }
  changed_.notify_one();
}

bool CaptureBuilder::anyBuilt() const {
  const std::lock_guard lock(mutex_);
  return !built_.empty();
}

bool CaptureBuilder::room() const {
  std::size_t bytes = 0;
  for (const Built& built : built_) bytes += built.packed ? built.packed->bytes() : 0;
  return bytes <= mostBytesBuilt_;
}

std::optional<CaptureTask> CaptureBuilder::next(const std::stop_token& stop,
                                                std::shared_ptr<const DisplayCapture>& capture,
                                                std::stop_token& cancelled) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return !waiting_.empty() && room(); });
    if (stop.stop_requested()) return std::nullopt;
    CaptureTask task = std::move(waiting_.front());
    waiting_.pop_front();
    capture = task.capture.lock();
    if (!capture) continue;  // evicted
    running_ = std::move(task);
    cancel_ = {};
    cancelled = cancel_.get_token();
    return running_;
  }
}

void CaptureBuilder::loop(const std::stop_token& stop) {
  std::shared_ptr<const DisplayCapture> capture;
  std::stop_token cancelled;
  while (std::optional<CaptureTask> task = next(stop, capture, cancelled)) {
    Result<PackedCapture> packed = packOrTell(*capture, *task, cancelled);
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

}  // namespace acentric
