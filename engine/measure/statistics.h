#pragma once
/// Summaries of repeated measurements, for reports and benchmarks.

#include <vector>

namespace acentric {

struct Spread {
  double min = 0;
  double median = 0;  ///< of an even number of values: the mean of the two in the middle
  double p99 = 0;     ///< the smallest value that 99 % of the values do not exceed
  double max = 0;
  int count = 0;  ///< values that are numbers; the others are left out. 0: all of the above are 0
};

Spread spreadOf(std::vector<double> values);

/// The smallest of the ascending `values` that `share` (0..1) of them do not exceed; 0 if there is none.
double percentileOf(const std::vector<double>& ascendingValues, double share);

}  // namespace acentric
