#include "engine/bake/capture_writer.h"

#include <chrono>
#include <exception>

namespace acentric {
namespace {

/// A sink is handed in from outside: what it throws must not end the program from a thread of ours.
Status putSafely(CaptureSink& sink, const ContentKey& key, const Capture& capture,
                 const std::stop_token& stop) {
  try {
    return sink.put(key, capture, stop);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to write a capture", key.toHex());
  } catch (const std::exception& e) {
    return fail(ErrorKind::internal, std::string("writing a capture failed: ") + e.what(), key.toHex());
  }
}

/// While it is encoded a capture is there twice more: as planes, and as the file's bytes.
constexpr std::size_t kCopies = 3;

/// After a stop, for what waits.
constexpr auto kGrace = std::chrono::milliseconds(500);

}  // namespace

CaptureWriter::CaptureWriter(CaptureSink& sink, MemoryBudget& budget, std::stop_token stop)
    : sink_(sink), stop_(std::move(stop)), budget_(budget), thread_([this] { loop(); }) {}

CaptureWriter::~CaptureWriter() { (void)finish(); }

Status CaptureWriter::status() const {
  if (error_) return tl::unexpected(*error_);
  return {};
}

Status CaptureWriter::put(const ContentKey& key, Capture capture) {
  Job job{key, std::move(capture), MemoryBudget::Share(budget_)};
  const std::size_t bytes = job.capture.bytes();
  job.held.set(bytes);
  const bool room = job.held.setWhenRoom(kCopies * bytes, stop_);
  const std::lock_guard lock(mutex_);
  if (error_) return status();
  if (!room) return fail(ErrorKind::cancelled, "the bake was stopped");
  job.held.pass();
  ++unfinished_;
  waiting_.push_back(std::move(job));
  changed_.notify_all();
  return {};
}

Status CaptureWriter::finish() {
  {
    std::unique_lock lock(mutex_);
    closed_ = true;
    changed_.notify_all();
    const auto done = [this] { return unfinished_ == 0 || error_; };
    if (!changed_.wait(lock, stop_, done) && !changed_.wait_for(lock, kGrace, done)) {
      error_ = Error{ErrorKind::cancelled, "the bake was stopped", {}};
      giveUp_.request_stop();
    }
  }
  if (thread_.joinable()) thread_.join();
  const std::lock_guard lock(mutex_);
  return status();
}

void CaptureWriter::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !waiting_.empty() || closed_; });
    if (waiting_.empty() || error_) return;
    std::optional<Job> job(std::move(waiting_.front()));
    waiting_.pop_front();
    lock.unlock();
    Status done = putSafely(sink_, job->key, job->capture, giveUp_.get_token());
    if (!done && sink_.passesOver(job->key, done.error())) done = {};
    job.reset();
    lock.lock();
    --unfinished_;
    changed_.notify_all();
    if (!done) {
      if (!error_) error_ = done.error();
      waiting_.clear();
      changed_.notify_all();
    }
  }
}

}  // namespace acentric
