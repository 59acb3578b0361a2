#include "engine/pipeline/bake_forecast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/pipeline/estimate_bake.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

using test::SceneBuilder;

class BakeForecastTest : public FolderTest {
 protected:
  OpenProject openRoom(double samplesPerDegree) const {
    SceneBuilder builder;
    const int matte = builder.material(test::matte());
    builder.box(matte, {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5f}, 50);
    builder.box(matte, {2, 2, 0}, {2.5f, 2.5f, 2});
    Project project = test::smallProject(1.5, samplesPerDegree);
    project.bake.ambientRays = 8;
    return test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
  }
  static BakeForecast forecastOf(const OpenProject& open, const BakeRequest& request) {
    TaskRunner runner(1);
    const BakeShare share = missingOf(open, request);
    const auto forecast = forecastBake(std::span(&share, 1), {}, runner);
    EXPECT_TRUE(forecast) << (forecast ? "" : forecast.error().describe());
    return forecast ? *forecast : BakeForecast{};
  }
};

TEST_F(BakeForecastTest, IsScaledToOtherNumbersOfCameras) {
  BakeForecast forecast;
  forecast.cameras = 200, forecast.lights = 1;
  forecast.captureSeconds = 300, forecast.lightSeconds = 20;
  forecast.captureBytes = 4e6, forecast.lightBytes = 1e6;
  const BakeForecast half = forecast.ofSoManyCameras(100);
  EXPECT_EQ(half.cameras, 100);
  EXPECT_EQ(half.lights, 1);
  EXPECT_DOUBLE_EQ(half.seconds(), 160);
  EXPECT_DOUBLE_EQ(half.bytes(), 2.5e6);
  EXPECT_TRUE(BakeForecast{}.ofSoManyCameras(100).nothing());
}

TEST_F(BakeForecastTest, LeavesOutWhatIsThere) {
  const OpenProject open = openRoom(1);
  const int cameras = int(open.keys.size());
  ASSERT_GT(cameras, 6);
  const BakeForecast all = forecastOf(open, {});
  EXPECT_EQ(all.cameras, cameras);
  EXPECT_EQ(all.lights, 1);
  EXPECT_EQ(all.threads, 2);
  EXPECT_GT(all.captureSeconds, 0);
  EXPECT_GT(all.lightSeconds, 0);
  EXPECT_GT(all.captureBytes, 0);
  EXPECT_EQ(all.memoryBytes, MemoryBudget::kUsual);
  EXPECT_FALSE(std::filesystem::exists(captureFolderFor(open.file))) << "asking bakes nothing";

  TaskRunner runner(1);
  BakeRequest some;
  some.surfaceLight = false;
  some.cameras = std::vector{1, 4, 5};
  ASSERT_TRUE(bakeProject(open, some, runner));
  EXPECT_TRUE(forecastOf(open, some).nothing());
  EXPECT_EQ(forecastOf(open, {}).cameras, cameras - 3);
  some.cameras = std::vector{1, 2};
  const BakeForecast one = forecastOf(open, some);
  EXPECT_EQ(one.cameras, 1);
  EXPECT_EQ(one.lights, 0);
  EXPECT_EQ(one.lightSeconds, 0);
  ASSERT_TRUE(bakeProject(open, {}, runner));
  EXPECT_TRUE(forecastOf(open, {}).nothing());
  EXPECT_EQ(forecastOf(open, {}).probeSeconds, 0) << "nothing is probed for nothing";
}

TEST_F(BakeForecastTest, OnceThatIsEnoughTheOthersAreLikeTheFirst) {
  const OpenProject open = openRoom(1);
  BakeRequest some;
  some.cameras = std::vector{0, 1, 2};
  const std::vector<BakeShare> shares{missingOf(open, some), missingOf(open, {}), missingOf(open, {})};
  TaskRunner runner(1);
  BakeForecastOptions options;
  options.enoughSeconds = 0;
  const auto all = forecastBake(shares, options, runner);
  const auto first = forecastBake(std::span(shares).first(1), options, runner);
  ASSERT_TRUE(all && first);
  const int cameras = int(3 + 2 * open.keys.size());
  EXPECT_EQ(all->cameras, cameras);
  EXPECT_EQ(all->lights, 3);
  EXPECT_NEAR(all->bytes(), first->bytes() * cameras / 3, 0.2 * all->bytes());
  EXPECT_GT(all->seconds(), first->seconds());
}

TEST_F(BakeForecastTest, CountsPreviewsThatComeFirst) {
  const OpenProject open = openRoom(4);
  BakeRequest request;
  EXPECT_EQ(missingOf(open, request).previews, 0);
  request.coarseFirst = true;
  EXPECT_NEAR(missingOf(open, request).previews, 1.0 / 64, 0.003) << "an eighth of the resolution";
  request.surfaceLight = false;
  TaskRunner runner(1);
  ASSERT_TRUE(bakeProject(atQuality(open, Quality::preview), request, runner));
  EXPECT_EQ(missingOf(open, request).previews, 0) << "those are there";
}

TEST_F(BakeForecastTest, ForetellsBrieflyWhatTheBakeDoesWithinAFactorOfTwo) {
  const OpenProject open = openRoom(2);
  TaskRunner runner(1);
  EstimateOptions brief;
  brief.brief = true;
  const auto estimate = estimateProjectBake(open, {}, brief, runner);
  ASSERT_TRUE(estimate) << estimate.error().describe();
  EXPECT_LE(estimate->probedCameras, 10);
  const auto report = bakeProject(open, {}, runner);
  ASSERT_TRUE(report) << report.error().describe();
  const BakeReport& captures = report->captures;
  EXPECT_EQ(estimate->cameras, captures.baked);
  const auto within = [](double foretold, double found, const char* what) {
    EXPECT_GT(foretold, found / 2) << what;
    EXPECT_LT(foretold, found * 2) << what;
  };
  // What time is spent on; how long that takes depends on what else the machine does.
  within(estimate->rays.value, double(captures.counts.rays.total() - captures.counts.rays.visibility),
         "rays");
  within(estimate->samples.value, double(captures.counts.samples.keptInAll()), "samples");
  within(
      estimate->bytes.value,
      double(report->bytes + CaptureStore::open(captureFolderFor(open.file))->bytesOf(open.surfaceLightKey)),
      "bytes");
  const auto light = CaptureStore::open(captureFolderFor(open.file))->getSurfaceLight(open.surfaceLightKey);
  ASSERT_TRUE(light);
  within(estimate->lightSamples.value, double(light->light.size()), "samples of light");
  std::printf("[ bench    ] foretold: %.2f of the seconds that it took\n",
              estimate->seconds.value / (captures.seconds + report->surfaceLightSeconds));
}

TEST_F(BakeForecastTest, OfABenchCountsEachBakeAndGathersLightOnce) {
  const OpenProject open = openRoom(2);
  TaskRunner runner(1);
  const auto forecastOf = [&](const std::optional<TrialBake>& trial) {
    const BakeShare share{&open, {0, 1, 2}, false, 0, trial};
    const auto forecast = forecastBake(std::span(&share, 1), {}, runner);
    EXPECT_TRUE(forecast) << (forecast ? "" : forecast.error().describe());
    return forecast.value_or(BakeForecast{});
  };
  const BakeForecast once = forecastOf({});
  EXPECT_EQ(once.bakes, 0);
  TrialBake trial{10, 10.0};
  trial.kept = TrialBake::Kept::letGo;
  const BakeForecast often = forecastOf(trial);
  EXPECT_EQ(often.bakes, 10);
  EXPECT_EQ(often.cameras, 30);
  EXPECT_EQ(often.bytes(), 0);
  EXPECT_GT(often.seconds(), once.seconds());
  TrialBake larger;
  larger.packedBytes = 4 * once.packedBytes;
  const BakeForecast grown = forecastOf(larger);
  EXPECT_NEAR(grown.packedBytes, *larger.packedBytes, 1);
  EXPECT_NEAR(grown.captureBytes / once.captureBytes, 4, 0.01);
  BakeForecast sum = once;
  sum += often;
  EXPECT_EQ(sum.cameras, 33);
  EXPECT_EQ(sum.seconds(), once.seconds() + often.seconds());
}

TEST(BakeForecast, IsOneLineForAPerson) {
  BakeForecast forecast;
  EXPECT_EQ(describe(forecast), "nothing to bake: all of it is there");
  forecast.cameras = 1;
  forecast.captureSeconds = 5.24;
  forecast.captureBytes = 2.04e6;
  forecast.memoryBytes = 1'500'000'000;
  EXPECT_EQ(
      describe(forecast),
      "1 camera to bake: about 5.2 s with 1 thread, 2.0 MB on disk, at most 1500 MB of memory besides the "
      "scene");
  forecast.cameras = 1200, forecast.lights = 1, forecast.threads = 2;
  forecast.lightSeconds = 200;
  EXPECT_EQ(describe(forecast),
            "1200 cameras and light on surfaces to bake: about 3.4 min with 2 threads, 2.0 MB on disk, at "
            "most 1500 "
            "MB of memory besides the scene");
  forecast.bakes = 6, forecast.lights = 0, forecast.captureBytes = forecast.lightBytes = 0;
  EXPECT_EQ(describe(forecast),
            "1200 cameras in 6 bakes to bake: about 3.4 min with 2 threads, nothing on disk, at most 1500 MB "
            "of memory besides the scene");
}

}  // namespace
}  // namespace acentric
