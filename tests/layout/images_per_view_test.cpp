/// How many images a view needs: the table that people are shown, counted again with real covers.

#include "engine/layout/images_per_view.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <sstream>

namespace acentric {
namespace {

constexpr int kConfigurations = int(Configuration::g) + 1;

TEST(ImagesPerView, IsWhatTheCoversOfEachConfigurationNeed) {
  for (int c = 0; c < kConfigurations; ++c) {
    const ImagesPerView& told = imagesPerView(Configuration(c));
    for (const auto& [fov, table] : {std::pair(60.0, told.at60), std::pair(90.0, told.at90)}) {
      const auto counted = countImages(Configuration(c), {.fovDegrees = fov, .views = 20'000, .seed = 99});
      ASSERT_TRUE(counted.has_value()) << counted.error().describe();
      ASSERT_LE(counted->shares.size(), table.size());
      for (std::size_t n = 0; n < table.size(); ++n) {
        const double share = n < counted->shares.size() ? 100 * counted->shares[n] : 0;
        // Four deviations of a count of 20,000, and the table's last digit.
        EXPECT_NEAR(share, table[n], 1.5) << nameOf(Configuration(c)) << " at " << fov << ": " << n;
      }
      EXPECT_NEAR(std::accumulate(table.begin(), table.end(), 0.0), 100, 0.5);
    }
  }
}

TEST(ImagesPerView, CountsOfAnyViewAddUpAndGrowWithIt) {
  double before = 0;
  for (const double fov : {10.0, 40.0, 100.0, 170.0}) {
    const auto counted = countImages(Configuration::c, {.fovDegrees = fov, .views = 2000});
    ASSERT_TRUE(counted.has_value());
    EXPECT_NEAR(std::accumulate(counted->shares.begin(), counted->shares.end(), 0.0), 1, 1e-9);
    EXPECT_EQ(counted->shares[0], 0) << "a view without an image";
    EXPECT_LE(counted->most(), 6) << "a hexagon's ring has six cameras";
    EXPECT_GT(counted->mean(), before);
    before = counted->mean();
  }
}

TEST(ImagesPerView, RefusesViewsThatAreNone) {
  EXPECT_FALSE(countImages(Configuration::b, {.fovDegrees = 0}).has_value());
  EXPECT_FALSE(countImages(Configuration::b, {.fovDegrees = 180}).has_value());
  EXPECT_FALSE(countImages(Configuration::b, {.views = 0}).has_value());
}

TEST(ImagesPerView, StandsInTheDocumentAsInTheTable) {
  std::ifstream file(ACENTRIC_SOURCE_FOLDER "/docs/configurations.md");
  std::stringstream text;
  text << file.rdbuf();
  for (int c = 0; c < kConfigurations; ++c) {
    const ImagesPerView& told = imagesPerView(Configuration(c));
    const std::string row = std::string("| ") + nameOf(Configuration(c)) + " | " + sharesText(told.at60) +
                            " | " + sharesText(told.at90) + " |";
    EXPECT_NE(text.str().find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace acentric
