#include "engine/cli/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>

namespace acentric::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// State of the one line that a progress bar owns.
struct Bar {
  std::mutex mutex;
  std::string stage;
  Clock::time_point stageBegan = Clock::now();
  Clock::time_point drawn{};
  double stageFirst = 0;

  void show(const ProgressState& state) {
    const std::lock_guard lock(mutex);
    const auto now = Clock::now();
    const std::string kind = state.stage.substr(0, state.stage.find_first_of("0123456789"));
    if (kind != stage) stage = kind, stageBegan = now, stageFirst = state.done, drawn = {};
    if (now - drawn < std::chrono::milliseconds(100) && state.done < state.total) return;
    drawn = now;
    std::string line = state.stage;
    if (state.total > 0) {
      const double share = std::min(1.0, state.done / state.total);
      const int filled = int(share * 24);
      line = fmt::format("[{}{}] {:3.0f} % {}", std::string(std::size_t(filled), '#'),
                         std::string(std::size_t(24 - filled), '-'), share * 100, state.stage);
      const double seconds = std::chrono::duration<double>(now - stageBegan).count();
      if (seconds > 2 && state.done > stageFirst) {
        const double left = (state.total - state.done) * seconds / (state.done - stageFirst);
        line += fmt::format(", {:.0f} s left", left);
      }
    }
    fmt::print(stderr, "\r\033[K{}", line.substr(0, 110));
    std::fflush(stderr);
  }
};

}  // namespace

Progress terminalProgress() {
  if (!::isatty(STDERR_FILENO)) return {};
  return [bar = std::make_shared<Bar>()](const ProgressState& state) { bar->show(state); };
}

void finishProgress() {
  if (::isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
}

}  // namespace acentric::cli
