#include "engine/cli/machine/machine.h"

#include <ctime>
#include <fstream>

#include "engine/cli/machine/commit.h"

namespace acentric::cli {

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

double processorSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

nlohmann::ordered_json measuredOn(int threads) {
  return {{"version", ACENTRIC_VERSION},
          {"commit", commitName()},
          {"processor", processorName()},
          {"threads", threads}};
}

}  // namespace acentric::cli
