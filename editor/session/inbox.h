#pragma once
/// How background work reaches the main thread: closures are posted from any thread and run by deliver().

#include <functional>
#include <mutex>
#include <vector>

namespace acentric::editor {

class Inbox {
 public:
  using Message = std::function<void()>;

  /// `wake` ends the main thread's sleep; called from the posting thread.
  explicit Inbox(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

  void post(Message message);
  /// Runs what has arrived, in order; true if there was anything. Main thread only.
  bool deliver();

 private:
  std::mutex mutex_;
  std::vector<Message> messages_;
  std::function<void()> wake_;
};

}  // namespace acentric::editor
