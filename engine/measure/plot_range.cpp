#include "engine/measure/plot_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/contract.h"
#include "engine/measure/statistics.h"

namespace acentric {

PlotRange plotRange(std::span<const double> values, std::span<const double> always, bool logarithmic) {
  constexpr std::size_t kFew = 5;
  constexpr double kFence = 1.5;
  require(!values.empty() || !always.empty(), "a range is of something");
  double least = -std::numeric_limits<double>::infinity(), most = -least;
  if (values.size() >= kFew) {
    const auto scaled = [&](double value) { return logarithmic ? std::log(value) : value; };
    std::vector<double> sorted;
    for (const double value : values) sorted.push_back(scaled(value));
    std::ranges::sort(sorted);
    const double low = percentileOf(sorted, 0.25), high = percentileOf(sorted, 0.75);
    const double reach = kFence * (high - low);
    if (reach > 0) least = low - reach, most = high + reach;
    if (logarithmic) least = std::exp(least), most = std::exp(most);
  }
  PlotRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto show = [&](double value) {
    range.low = std::min(range.low, value), range.high = std::max(range.high, value);
  };
  for (const double value : values)
    if (value >= least && value <= most) show(value);
  for (const double value : always) show(value);
  return range;
}

}  // namespace acentric
