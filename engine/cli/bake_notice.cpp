#include "engine/cli/bake_notice.h"

#include <algorithm>

namespace acentric::cli {

Json toJson(const BakeForecast& forecast) {
  return {{"cameras", forecast.cameras},
          {"bakes", forecast.bakes},
          {"lights", forecast.lights},
          {"threads", forecast.threads},
          {"seconds", forecast.seconds()},
          {"captureSeconds", forecast.captureSeconds},
          {"lightSeconds", forecast.lightSeconds},
          {"relativeError", forecast.relativeError},
          {"bytes", forecast.bytes()},
          {"memoryBytes", forecast.memoryBytes},
          {"probeSeconds", forecast.probeSeconds}};
}

void tell(const BakeForecast& forecast, const Common& common) {
  if (!common.notice) return;
  Json event = {{"event", "bakeForecast"}};
  event.update(toJson(forecast));
  common.notice(describe(forecast), event);
}

BakeTeller tellerTo(const Common& common) {
  return [&common](const BakeForecast& forecast) {
    if (!forecast.nothing()) tell(forecast, common);
  };
}

Result<BakeForecast> foretellBake(std::span<const BakeShare> shares, std::size_t memoryBytes,
                                  const Common& common, TaskRunner& runner) {
  if (std::ranges::none_of(shares, &BakeShare::any)) {
    BakeForecast nothing;
    nothing.threads = runner.threads();
    return nothing;
  }
  BakeForecastOptions options;
  options.enoughSeconds = BakeForecastOptions::kUsuallyEnough;
  options.memoryBytes = memoryBytes;
  auto forecast = forecastBake(shares, options, runner, common.progress, common.stop);
  if (forecast) tell(*forecast, common);
  return forecast;
}

}  // namespace acentric::cli
