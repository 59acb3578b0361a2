#include "engine/measure/correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace acentric {
namespace {

TEST(Correlation, OfALineIsOneOrMinusOne) {
  const std::vector<double> x{1, 2, 4, 8}, up{3, 5, 9, 17}, down{-1, -2, -4, -8};
  EXPECT_NEAR(pearson(x, up), 1, 1e-12);
  EXPECT_NEAR(pearson(x, down), -1, 1e-12);
  EXPECT_NEAR(spearman(x, down), -1, 1e-12);
}

TEST(Correlation, OfRanksAsksOnlyForTheOrder) {
  const std::vector<double> x{0.1, 0.2, 0.5, 0.9}, y{1, 10, 100, 1e6};
  EXPECT_NEAR(spearman(x, y), 1, 1e-12);
  EXPECT_LT(pearson(x, y), 0.95);
}

TEST(Correlation, SharesTheMeanRankAmongEquals) {
  // Ranks 0.5 0.5 2 3 against 0 1 2 3, worked out by hand.
  const double mean = 1.5;
  const double a[] = {0.5, 0.5, 2, 3}, b[] = {0, 1, 2, 3};
  double aa = 0, bb = 0, ab = 0;
  for (int i = 0; i < 4; ++i) {
    aa += (a[i] - mean) * (a[i] - mean), bb += (b[i] - mean) * (b[i] - mean);
    ab += (a[i] - mean) * (b[i] - mean);
  }
  EXPECT_NEAR(spearman({7, 7, 8, 9}, {1, 2, 3, 4}), ab / std::sqrt(aa * bb), 1e-12);
}

TEST(Correlation, OfNoiseIsNearZeroAndOfAConstantNotANumber) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  std::vector<double> x(4000), y(4000);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = normal(engine), y[i] = normal(engine);
  EXPECT_NEAR(pearson(x, y), 0, 0.06);
  EXPECT_NEAR(spearman(x, y), 0, 0.06);
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = 0.6 * x[i] + 0.8 * y[i];
  EXPECT_NEAR(pearson(x, y), 0.6, 0.05);
  EXPECT_TRUE(std::isnan(pearson(x, std::vector<double>(x.size(), 3))));
  EXPECT_TRUE(std::isnan(pearson({}, {})));
  EXPECT_TRUE(std::isnan(spearman({1}, {2})));
}

}  // namespace
}  // namespace acentric
