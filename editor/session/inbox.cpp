#include "editor/session/inbox.h"

namespace acentric::editor {

void Inbox::post(Message message) {
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  if (wake_) wake_();
}

bool Inbox::deliver() {
  std::vector<Message> arrived;
  {
    const std::lock_guard lock(mutex_);
    arrived.swap(messages_);
  }
  for (const Message& message : arrived) message();
  return !arrived.empty();
}

}  // namespace acentric::editor
