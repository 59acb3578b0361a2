#include "engine/cli/machine/figure.h"

#include <algorithm>

#include "engine/measure/statistics.h"

namespace acentric::cli {

void putSpread(nlohmann::ordered_json& figure, const std::vector<double>& values) {
  const Spread spread = spreadOf(values);
  figure["median"] = spread.median, figure["min"] = spread.min, figure["max"] = spread.max;
  figure["count"] = spread.count;
}

void putBeside(nlohmann::ordered_json& figure, const std::vector<double>& values,
               const std::string& otherName, const std::vector<double>& other) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(values.size(), other.size()); ++i)
    if (other[i] > 0) ratios.push_back(values[i] / other[i]);
  figure["beside"] = {{"name", otherName}};
  putSpread(figure["beside"], other);
  figure["ratio"] = spreadOf(ratios).median;
}

}  // namespace acentric::cli
