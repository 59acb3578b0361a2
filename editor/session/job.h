#pragma once
/// One kind of background work (import, layout, bake, ...), at most one at a time. The work gets an immutable
/// snapshot by capture; it answers by messages that the main thread runs. Results of work that was replaced
/// or cancelled are dropped. All members belong to the main thread; only Context is used by the work.

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "editor/session/inbox.h"
#include "engine/base/progress.h"

namespace acentric::editor {

class Job {
 public:
  class Context {
   public:
    std::stop_token stop() const { return stop_; }
    /// For the engine's functions: posts at most about 20 times a second.
    Progress progress() const { return progress_; }
    /// Runs `message` on the main thread, unless this work was replaced or cancelled meanwhile.
    void post(std::function<void()> message) const { post_(std::move(message)); }

   private:
    friend class Job;
    std::stop_token stop_;
    Progress progress_;
    std::function<void(std::function<void()>)> post_;
  };
  using Work = std::function<void(const Context&)>;

  explicit Job(Inbox& inbox) : inbox_(inbox), alive_(std::make_shared<Job*>(this)) {}
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Starts, or stops what runs and starts as soon as it has ended (the newest waiting work wins).
  void restart(std::string label, Work work);
  /// Asks the work to stop, and forgets what waits.
  void cancel();
  /// The same, and nothing that the work still posts is run.
  void abandon();

  bool running() const { return thread_.has_value(); }
  bool cancelling() const { return running() && thread_->get_stop_token().stop_requested(); }
  const std::string& label() const { return label_; }
  const ProgressState& progress() const { return progress_; }

 private:
  struct Waiting {
    std::string label;
    Work work;
  };
  void start(Waiting next);
  void ended();

  Inbox& inbox_;
  std::shared_ptr<Job*> alive_;  // messages outlive jobs: they hold this weakly
  std::optional<std::jthread> thread_;
  std::optional<Waiting> waiting_;
  std::string label_;
  ProgressState progress_;
  std::uint64_t generation_ = 0;
};

}  // namespace acentric::editor
