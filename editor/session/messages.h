#pragma once
/// What the program told its user, newest last.

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric::editor {

enum class MessageLevel { info, good, warning, error };

struct Message {
  MessageLevel level = MessageLevel::info;
  std::string text;
  std::string time;    ///< local, HH:MM:SS
  bool modal = false;  ///< the user's request failed: say so in a dialog
};

class Messages {
 public:
  static constexpr std::size_t kMost = 500;

  void add(MessageLevel level, std::string text);
  /// A request of the user's that failed; a cancelled one is no failure.
  void addFailure(const std::string& what, const Error& error);

  const std::vector<Message>& all() const { return all_; }
  /// Those that were added since the last call, for toasts and dialogs.
  std::vector<Message> takeNew();

 private:
  std::vector<Message> all_;
  std::vector<Message> fresh_;
};

}  // namespace acentric::editor
