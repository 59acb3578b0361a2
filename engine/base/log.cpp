#include "engine/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace acentric {

LogSink standardErrorLog() {
  auto logger =
      std::make_shared<spdlog::logger>("acentric", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%H:%M:%S %^%l%$ %v");
  return [logger](LogLevel level, const std::string& message) {
    switch (level) {
      case LogLevel::info:
        logger->info(message);
        break;
      case LogLevel::warning:
        logger->warn(message);
        break;
      case LogLevel::error:
        logger->error(message);
        break;
    }
  };
}

}  // namespace acentric
