#pragma once
/// What a session is given by whoever makes it: where things lie, and for tests how often it looks.

#include <filesystem>
#include <functional>
#include <optional>

#include "engine/pipeline/shipped_walk.h"

namespace acentric::editor {

struct SessionOptions {
  ImportHost importHost;
  std::filesystem::path preferencesFile;  ///< empty = nothing is remembered
  int processors = 0;                     ///< 0 = what the machine has
  std::optional<double> autosaveSeconds;  ///< instead of the preference
  std::filesystem::path program;          ///< `acentric`; empty = beside the running program
  std::filesystem::path page;  ///< folder of the page for browsers; empty = where it is installed or built
  std::filesystem::path unsavedFolder;  ///< for autosaves of work that has no file yet; empty = it has none
  double watchSeconds = 2;              ///< between looks at files that others may change
  /// Inspects each layout soon after an edit for the list of problems, also while the plan does not show it.
  bool inspectAlways = false;
  std::uint64_t regionsAtOnce = kRegionsAtOnce;  ///< walks of more are read page by page
  std::function<void()> wake;                    ///< ends the main thread's sleep; any thread
};

}  // namespace acentric::editor
