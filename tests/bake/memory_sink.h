#pragma once
/// Captures kept in memory, for tests.

#include <functional>
#include <map>
#include <mutex>

#include "engine/bake/bake.h"

namespace acentric::test {

class MemorySink final : public CaptureSink {
 public:
  bool has(const ContentKey& key) const override { return find(key) != nullptr; }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token&) override {
    if (onPut) onPut();
    const std::lock_guard lock(mutex_);
    if (captures_.size() >= room) return fail(ErrorKind::outOfSpace, "the disk is full", "sink");
    captures_[key] = capture;
    return {};
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return captures_.size();
  }
  /// Null if there is none.
  const Capture* find(const ContentKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = captures_.find(key);
    return found == captures_.end() ? nullptr : &found->second;
  }

  std::function<void()> onPut;
  std::size_t room = 1000;

 private:
  mutable std::mutex mutex_;
  std::map<ContentKey, Capture> captures_;
};

}  // namespace acentric::test
