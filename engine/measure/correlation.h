#pragma once
/// How well one series of measurements foretells another.

#include <vector>

namespace acentric {

/// Pearson's coefficient: how nearly they lie on a line. NaN where either series does not vary.
double pearson(const std::vector<double>& x, const std::vector<double>& y);
/// Spearman's: Pearson's of the ranks; equal values share the mean of their ranks.
double spearman(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace acentric
