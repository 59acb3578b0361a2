#pragma once
/// The terminal's side: a progress bar on stderr, and Ctrl-C turned into a stop request.

#include <stop_token>

#include "engine/base/progress.h"

namespace acentric::cli {

/// Draws one line, rewritten at most ten times a second with rate-based time left; `finishProgress` clears
/// it. Empty when stderr is not a terminal.
Progress terminalProgress();
void finishProgress();

/// A token that Ctrl-C (or SIGTERM) sets; a second Ctrl-C ends the program at once.
std::stop_token stopOnInterrupt();

}  // namespace acentric::cli
