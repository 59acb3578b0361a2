#pragma once
/// Which part of an axis is shown when a few values lie far from all others.

#include <span>

namespace acentric {

struct PlotRange {
  double low = 0, high = 1;
  bool holds(double value) const { return value >= low && value <= high; }
};

/// From the least to the largest of the values within 1.5 times the distance of the quartiles beyond them
/// (Tukey's fences; of logarithms where the axis is `logarithmic`, values above 0 then), and all of `always`.
/// Fewer than five values are all shown. Neither may both be empty.
PlotRange plotRange(std::span<const double> values, std::span<const double> always, bool logarithmic);

}  // namespace acentric
