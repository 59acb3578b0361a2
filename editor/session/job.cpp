#include "editor/session/job.h"

#include <chrono>
#include <mutex>

namespace acentric::editor {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kProgressInterval = std::chrono::milliseconds(50);

/// Lets a report through when the last is old enough, a stage begins, or the work is done.
class ReportGate {
 public:
  bool open(const ProgressState& state) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    const bool complete = state.total > 0 && state.done >= state.total;
    if (state.stage == stage_ && !complete && now - last_ < kProgressInterval) return false;
    stage_ = state.stage;
    last_ = now;
    return true;
  }

 private:
  std::mutex mutex_;
  Clock::time_point last_{};
  std::string stage_;
};

}  // namespace

Job::~Job() {
  alive_.reset();
  if (thread_) thread_->request_stop();
}

void Job::restart(std::string label, Work work) {
  if (!running()) return start({std::move(label), std::move(work)});
  thread_->request_stop();
  ++generation_;  // what the stopped work still posts is stale
  waiting_ = Waiting{std::move(label), std::move(work)};
}

void Job::cancel() {
  waiting_.reset();
  if (running()) thread_->request_stop();
}

void Job::abandon() {
  cancel();
  ++generation_;
}

void Job::start(Waiting next) {
  label_ = std::move(next.label);
  progress_ = {};
  const std::uint64_t generation = ++generation_;
  const std::weak_ptr<Job*> alive = alive_;
  Inbox& inbox = inbox_;

  const auto postIfCurrent = [alive, generation, &inbox](std::function<void()> message) {
    inbox.post([alive, generation, run = std::move(message)] {
      const auto job = alive.lock();
      if (job && (*job)->generation_ == generation) run();
    });
  };
  Context context;
  context.post_ = postIfCurrent;
  context.progress_ = [alive, postIfCurrent,
                       gate = std::make_shared<ReportGate>()](const ProgressState& state) {
    if (!gate->open(state)) return;
    postIfCurrent([alive, state] {
      if (const auto job = alive.lock()) (*job)->progress_ = state;
    });
  };
  thread_.emplace([context, work = std::move(next.work), alive, &inbox](const std::stop_token& stop) mutable {
    context.stop_ = stop;
    work(context);
    inbox.post([alive] {
      if (const auto job = alive.lock()) (*job)->ended();
    });
  });
}

void Job::ended() {
  thread_.reset();  // joins: the work has returned
  if (!waiting_) return;
  Waiting next = std::move(*waiting_);
  waiting_.reset();
  start(std::move(next));
}

}  // namespace acentric::editor
