#include "editor/session/messages.h"

#include <fmt/chrono.h>

#include <ctime>
#include <utility>

#include "editor/session/engine_texts.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::string clockTime() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("{:%H:%M:%S}", fmt::localtime(now));
}

}  // namespace

void Messages::add(MessageLevel level, std::string text) {
  all_.push_back({level, std::move(text), clockTime(), false});
  fresh_.push_back(all_.back());
  if (all_.size() > kMost) all_.erase(all_.begin());
}

void Messages::addFailure(const std::string& what, const Error& error) {
  if (error.kind == ErrorKind::cancelled) return add(MessageLevel::info, trf("{} was cancelled", what));
  add(MessageLevel::error, trf("{} failed. {}", what, engineText(error)));
  all_.back().modal = true;
  fresh_.back().modal = true;
}

std::vector<Message> Messages::takeNew() { return std::exchange(fresh_, {}); }

}  // namespace acentric::editor
