/// What a bake will take, told before it begins; and how soon a new project has its first view.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST(BakeForecastTold, AsALineBeforeTheBakeAndNotWhereNothingIsToBeDone) {
  const SampleProject project("forecast-line", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto some =
      acentric({"bake", project.file(), "--only", "0,1", "--light", "without", "--threads", "2"});
  EXPECT_EQ(some.exitCode, 0) << some.errors;
  EXPECT_THAT(some.errors,
              ContainsRegex("acentric: 2 cameras to bake: about [0-9.]+ s with 2 threads, [0-9.]+ MB "
                            "on disk, at most [0-9]+ MB of memory"));
  const auto again = acentric({"bake", project.file(), "--only", "0,1", "--light", "without"});
  EXPECT_THAT(again.errors, Not(HasSubstr("to bake")));
  const auto more = acentric({"bake", project.file(), "--only", "0,1,2", "--light", "without"});
  EXPECT_THAT(more.errors, HasSubstr("1 camera to bake"));
  const auto preview = acentric({"bake", project.file(), "--quality", "preview"});
  EXPECT_EQ(preview.exitCode, 0) << preview.errors;
  EXPECT_THAT(preview.errors, ContainsRegex("[0-9]+ cameras to bake"));
}

TEST(BakeForecastTold, AsAnEventAndInTheReportOfJson) {
  const SampleProject project("forecast-json", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto baked = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  const Json report = Json::parse(baked.output);
  const Json& forecast = report["forecast"];
  EXPECT_EQ(forecast["cameras"], report["baked"]);
  EXPECT_EQ(forecast["lights"], 1);
  for (const char* figure : {"seconds", "captureSeconds", "lightSeconds", "bytes", "memoryBytes"})
    EXPECT_GT(forecast[figure].get<double>(), 0) << figure;
  const Json event = Json::parse(baked.errors);
  EXPECT_EQ(event["event"], "bakeForecast");
  EXPECT_EQ(event["seconds"], forecast["seconds"]);
  const auto idle = acentric({"bake", project.file(), "--json"});
  EXPECT_EQ(idle.errors, "");
  EXPECT_EQ(Json::parse(idle.output)["forecast"]["cameras"], 0);
}

TEST(BakeForecastTold, ByBenchBakeForAllItsSetsAndRepeats) {
  const SampleProject project("forecast-bench-bake");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto ran = acentric({"bench", "bake", project.file(), "--side", "48", "--cameras", "6", "--repeats",
                             "1", "--threads", "2"});
  ASSERT_EQ(ran.exitCode, 0) << ran.errors;
  EXPECT_THAT(ran.errors, ContainsRegex("acentric: 54 cameras in 9 bakes to bake: about [0-9.]+ (s|min) with "
                                        "2 threads, [0-9.]+ MB on disk, at most [0-9]+ MB of memory"));
  const auto wrong = acentric({"bench", "bake", project.file(), "--side", "1"});
  EXPECT_THAT(wrong.errors, Not(HasSubstr("to bake")));
}

TEST(BakeForecastTold, ByBenchHolesWhoseCapturesStayInMemory) {
  const SampleProject project("forecast-bench-holes", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const std::vector<std::string> bench = {"bench",    "holes", project.file(), "--size", "96x54",
                                          "--frames", "1",     "--json"};
  const auto first = acentric(bench);
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  const Json told = Json::parse(first.errors);
  EXPECT_EQ(told["event"], "bakeForecast");
  EXPECT_EQ(told["bakes"], 2);
  EXPECT_EQ(told["cameras"].get<int>() % 2, 0);
  EXPECT_GT(told["cameras"].get<int>(), 2 * 6) << "a ring and a panorama";
  EXPECT_EQ(told["lights"], 1);
  EXPECT_EQ(told["bytes"], 0);
  EXPECT_GT(told["seconds"].get<double>(), 0);
  ASSERT_EQ(acentric({"bake", project.file(), "--light", "only"}).exitCode, 0);
  EXPECT_EQ(Json::parse(acentric(bench).errors)["lights"], 0) << "the project's is taken";
}

TEST(BakeForecastTold, ByBenchRepresentationsForWhatNoEarlierRunBaked) {
  const SampleProject project("forecast-bench-representations", "-2,-2;2,-2;2,2;-2,2");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto bench = [&](const std::string& only) {
    return acentric({"bench", "representations", project.file(), "-o", (project.folder() / "ways").string(),
                     "--poses", "2", "--size", "96x54", "--tolerance", "0.5", "--json", "--only", only});
  };
  const auto first = bench("grid");
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  const Json told = Json::parse(first.errors);
  EXPECT_EQ(told["event"], "bakeForecast");
  EXPECT_EQ(told["bakes"], 2);
  int cameras = 0;
  const Json report = Json::parse(first.output);
  for (const Json& way : report["representations"]) cameras += way["cameras"].get<int>();
  EXPECT_EQ(told["cameras"], cameras);
  EXPECT_GT(told["bytes"].get<double>(), 0);
  EXPECT_EQ(bench("grid").errors, "") << "all of it is there";
  const auto more = bench("grid,mesh");
  ASSERT_EQ(more.exitCode, 0) << more.errors;
  EXPECT_EQ(Json::parse(more.errors)["cameras"], 0);
  EXPECT_EQ(Json::parse(more.errors)["lights"], 1) << "the mesh's";
}

TEST(BakeForecastTold, ByFarmBeforeJobsAreMade) {
  const SampleProject project("forecast-farm", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto farm = acentric({"farm", "slurm", project.file()});
  ASSERT_EQ(farm.exitCode, 0) << farm.errors;
  EXPECT_THAT(farm.errors, ContainsRegex("acentric: [0-9]+ cameras and light on surfaces to bake: about"));
}

TEST(FirstViewBench, TellsWhenItIsCoarseFullAndLit) {
  const auto bench = acentric({"bench", "first-view", ACENTRIC_SAMPLE_SCENE, "--cell-size", "2.5",
                               "--samples-per-degree", "1", "--json"});
  ASSERT_EQ(bench.exitCode, 0) << bench.errors;
  const Json scene = Json::parse(bench.output)["scenes"][0];
  const Json told = Json::parse(bench.errors);
  EXPECT_EQ(told["event"], "bakeForecast");
  EXPECT_EQ(told["cameras"], scene["cameras"]);
  EXPECT_EQ(scene["cellSize"], 2.5);
  EXPECT_GT(scene["firstCameras"].get<int>(), 0);
  EXPECT_LT(scene["firstCameras"].get<int>(), scene["cameras"].get<int>());
  EXPECT_GT(scene["importSeconds"].get<double>(), 0);
  EXPECT_GT(scene["coarseSeconds"].get<double>(), 0);
  EXPECT_GT(scene["fullSeconds"], scene["coarseSeconds"]);
  EXPECT_GT(scene["lightSeconds"], scene["fullSeconds"]);
  const auto none = acentric({"bench", "first-view", "none.glb"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_THAT(none.errors, HasSubstr("none.glb"));
}

}  // namespace
}  // namespace acentric::test
