#include "engine/measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace acentric {

double percentileOf(const std::vector<double>& ascendingValues, double share) {
  if (ascendingValues.empty()) return 0;
  // The small allowance keeps 0.07 * 100 at rank 7, though the product lies a little above 7.
  const double rank =
      std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(ascendingValues.size()) - 1e-9);
  return ascendingValues[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

Spread spreadOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const bool odd = values.size() % 2 == 1;
  return {values.front(), odd ? values[middle] : std::midpoint(values[middle - 1], values[middle]),
          percentileOf(values, 0.99), values.back(), static_cast<int>(values.size())};
}

}  // namespace acentric
