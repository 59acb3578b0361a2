#include "engine/base/task_runner.h"

#include "engine/base/contract.h"

namespace acentric {

TaskRunner::TaskRunner(int workers, const Gate* gate) : gate_(gate) {
  require(workers >= 0 && workers <= 4096, "worker count out of range");
  for (int i = 0; i < workers; ++i) workers_.emplace_back([this](std::stop_token stop) { workerLoop(stop); });
}

TaskRunner::~TaskRunner() {
  for (auto& worker : workers_) worker.request_stop();
}

void TaskRunner::parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (workers_.empty()) {
    for (std::size_t i = 0; i < count; ++i) {
      if (gate_) gate_->pass();
      body(i);
    }
    return;
  }
  std::unique_lock lock(mutex_);
  require(body_ == nullptr, "TaskRunner::parallelFor is not re-entrant");
  body_ = &body;
  next_ = 0;
  count_ = count;
  wake_.notify_all();
  lock.unlock();
  drain();
  lock.lock();
  done_.wait(lock, [this] { return next_ >= count_ && running_ == 0; });
  body_ = nullptr;
}

void TaskRunner::drain() {
  std::unique_lock lock(mutex_);
  while (body_ != nullptr && next_ < count_) {
    const std::size_t index = next_++;
    const auto* body = body_;
    ++running_;
    lock.unlock();
    if (gate_) gate_->pass();
    (*body)(index);
    lock.lock();
    --running_;
  }
  if (running_ == 0) done_.notify_all();
}

void TaskRunner::workerLoop(std::stop_token stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return body_ != nullptr && next_ < count_; })) return;
    }
    drain();
  }
}

}  // namespace acentric
