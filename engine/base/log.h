#pragma once
/// Messages for whoever runs the program. The library is handed a sink; only the top prints.

#include <functional>
#include <string>

namespace acentric {

enum class LogLevel { info, warning, error };
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// A sink that writes lines with time and level to stderr (spdlog), for programs.
LogSink standardErrorLog();

}  // namespace acentric
