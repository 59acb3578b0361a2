#pragma once
/// The terminal's side: a progress bar on stderr.

#include "engine/base/progress.h"

namespace acentric::cli {

/// Draws one line, rewritten at most ten times a second with rate-based time left; `finishProgress` clears
/// it. Empty when stderr is not a terminal.
Progress terminalProgress();
void finishProgress();

}  // namespace acentric::cli
