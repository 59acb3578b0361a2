#include "engine/pipeline/bake_limit.h"

#include <gtest/gtest.h>

#include <vector>

namespace acentric {
namespace {

/// Ground that `all` cameras serve, each of which takes `rate` seconds; a few of those asked for are not
/// used, as in layouts.
struct Ground {
  std::size_t all = 0;
  double rate = 1;
  bool known = true;  ///< is a forecast there in time?
  std::vector<std::size_t> asked = {};
  LaidOut laid = {};
  int forecasts = 0;

  Result<LimitedBy> within(double seconds, std::size_t mostCameras) {
    BakeLimit limit;
    limit.seconds = seconds, limit.mostCameras = mostCameras;
    limit.layOut = [this](std::size_t most) -> Result<LaidOut> {
      asked.push_back(most);
      laid.whole = most == 0 || all <= most;
      laid.cameras = laid.whole ? all : most - most / 40;
      return laid;
    };
    limit.predict = [this]() -> std::optional<double> {
      ++forecasts;
      return known ? std::optional(rate * double(laid.cameras)) : std::nullopt;
    };
    return layOutWithin(limit);
  }
  double seconds() const { return rate * double(laid.cameras); }
};

TEST(BakeLimit, LaysOutAsMuchOfATownAsBakesInTime) {
  for (const double rate : {0.05, 0.5, 2.0, 2.4, 5.0, 17.0}) {
    Ground town{200'000, rate};
    EXPECT_EQ(town.within(1200, 2000).value(), rate * 2000 < 1200 ? LimitedBy::cameras : LimitedBy::minutes);
    EXPECT_FALSE(town.laid.whole);
    EXPECT_LE(town.laid.cameras, 2000u);
    EXPECT_LE(town.seconds(), kPartAllowance * 1200) << rate;
    if (rate * 2000 > 1200) {
      EXPECT_GE(town.seconds(), kPartShare * 1200) << rate;
    }
    EXPECT_LE(town.asked.size(), 4u);
    EXPECT_LE(town.forecasts, 3);
  }
}

TEST(BakeLimit, IsNotAskedOfARoom) {
  for (const double rate : {0.1, 100.0}) {
    Ground room{194, rate};
    EXPECT_EQ(room.within(1200, 2000).value(), LimitedBy::nothing);
    EXPECT_TRUE(room.laid.whole);
    EXPECT_EQ(room.forecasts, 0);
  }
}

TEST(BakeLimit, LaysOutAllOfAStreetThatBakesInNotMuchMore) {
  Ground street{672, 3.4};  // 38 minutes of 20
  EXPECT_EQ(street.within(1200, 2000).value(), LimitedBy::nothing);
  EXPECT_EQ(street.laid.cameras, 672u);
  Ground longer{672, 4.0};
  EXPECT_EQ(longer.within(1200, 2000).value(), LimitedBy::minutes);
  EXPECT_LE(longer.seconds(), kPartAllowance * 1200);
  Ground few{672, 0.1};
  EXPECT_EQ(few.within(1200, 600).value(), LimitedBy::cameras);
}

TEST(BakeLimit, LeavesARegionHoweverLittleTimeThereIs) {
  Ground town{200'000, 2.0};
  EXPECT_EQ(town.within(1, 2000).value(), LimitedBy::minutes);
  EXPECT_EQ(town.asked.back(), kFewestCameras);
  Ground fewer{200'000, 2.0};
  EXPECT_EQ(fewer.within(1, 20).value(), LimitedBy::cameras);
  EXPECT_EQ(fewer.asked.back(), 20u);
}

TEST(BakeLimit, KeepsTheTrialWhereNothingIsKnownInTime) {
  Ground town{200'000, 2.0, false};
  EXPECT_EQ(town.within(1200, 2000).value(), LimitedBy::unknown);
  EXPECT_EQ(town.asked, std::vector<std::size_t>{kTrialCameras});
  Ground small{400, 2.0, false};
  EXPECT_EQ(small.within(1200, 2000).value(), LimitedBy::nothing);
}

TEST(BakeLimit, MayBeOfCamerasAloneOrOfNothing) {
  Ground town{200'000, 2.0};
  EXPECT_EQ(town.within(0, 2000).value(), LimitedBy::cameras);
  EXPECT_EQ(town.asked, std::vector<std::size_t>{2000});
  Ground all{200'000, 2.0};
  EXPECT_EQ(all.within(0, 0).value(), LimitedBy::nothing);
  EXPECT_TRUE(all.laid.whole);
  Ground timed{200'000, 2.0};
  EXPECT_EQ(timed.within(1200, 0).value(), LimitedBy::minutes);
  EXPECT_LE(timed.seconds(), kPartAllowance * 1200);
}

TEST(BakeLimit, PassesFailuresOn) {
  BakeLimit limit;
  limit.layOut = [](std::size_t) -> Result<LaidOut> { return fail(ErrorKind::notFound, "no floor"); };
  limit.predict = []() { return std::optional(1.0); };
  for (const double seconds : {0.0, 60.0}) {
    limit.seconds = seconds;
    const auto failed = layOutWithin(limit);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "no floor");
  }
}

}  // namespace
}  // namespace acentric
