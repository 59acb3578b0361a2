#include "engine/view_gl/mesh_builder.h"

#include <algorithm>
#include <new>
#include <utility>

namespace acentric {
namespace {

Result<PackedMesh> packOrTell(const DisplayCapture& capture, const MeshTask& task, TaskRunner& runner,
                              const std::stop_token& stop) {
  try {
    return packMesh(capture, task, runner, stop);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to build its mesh: use smaller captures",
                task.name);
  }
}

}  // namespace

MeshBuilder::MeshBuilder(int threads, std::function<void()> wake)
    : threads_(threads),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { loop(stop); }) {}

MeshBuilder::~MeshBuilder() {
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    cancel_.request_stop();
  }
  thread_.join();
}

void MeshBuilder::want(std::vector<MeshTask> tasks) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    for (MeshTask& task : tasks) {
      const auto same = [&](const MeshTask& other) { return task.sameAs(other); };
      const bool begun = running_ && same(*running_) && !cancel_.stop_requested();
      if (!begun && std::ranges::none_of(built_, same, &Built::task)) waiting_.push_back(std::move(task));
    }
  }
  changed_.notify_one();
}

void MeshBuilder::keepOnly(const std::function<bool(const MeshTask&)>& useful) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const MeshTask& task) { return !useful(task); });
  std::erase_if(built_, [&](const Built& built) { return !useful(built.task); });
  if (running_ && !useful(*running_)) cancel_.request_stop();
}

std::vector<MeshBuilder::Built> MeshBuilder::takeBuilt() {
  const std::lock_guard lock(mutex_);
  return std::exchange(built_, {});
}

bool MeshBuilder::anyBuilt() const {
  const std::lock_guard lock(mutex_);
  return !built_.empty();
}

std::optional<MeshTask> MeshBuilder::next(const std::stop_token& stop,
                                          std::shared_ptr<const DisplayCapture>& capture,
                                          std::stop_token& cancelled) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (stop.stop_requested()) return std::nullopt;
    MeshTask task = std::move(waiting_.front());
    waiting_.pop_front();
    capture = task.capture.lock();
    if (!capture) continue;  // evicted
    running_ = std::move(task);
    cancel_ = {};
    cancelled = cancel_.get_token();
    return running_;
  }
}

void MeshBuilder::loop(const std::stop_token& stop) {
  TaskRunner runner(threads_ - 1);
  std::shared_ptr<const DisplayCapture> capture;
  std::stop_token cancelled;
  while (std::optional<MeshTask> task = next(stop, capture, cancelled)) {
    Result<PackedMesh> mesh = packOrTell(*capture, *task, runner, cancelled);
    capture.reset();
    bool kept = false;
    {
      const std::lock_guard lock(mutex_);
      running_.reset();
      kept = !cancelled.stop_requested();
      if (kept) built_.push_back({std::move(*task), std::move(mesh)});
    }
    if (kept && wake_) wake_();
  }
}

}  // namespace acentric
