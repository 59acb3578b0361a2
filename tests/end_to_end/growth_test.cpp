/// How frame times grow with a scene: the town in a forest, from one that any renderer draws to one that
/// polygons cannot hold.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::HasSubstr;

const std::string kWalk = std::string(ACENTRIC_SOURCE_DIR) + "/projects/forest/paths/walk.json";

/// A project of so many triangles: polygons and ray tracing need nothing baked.
std::string projectOf(const TemporaryFolder& folder, const std::string& triangles) {
  const std::string scene = (folder.path() / (triangles + ".glb")).string(),
                    file = (folder.path() / (triangles + ".acentric.json")).string();
  EXPECT_EQ(runProcess({ACENTRIC_SAMPLE_FOREST, triangles, scene}).exitCode, 0);
  const ProcessResult made = acentric({"new", scene, "-o", file, "--config", "b", "--cell", "3", "--outline",
                                       "-3,-12;3,-12;3,12;-3,12", "--no-estimate"});
  EXPECT_EQ(made.exitCode, 0) << made.errors;
  EXPECT_THAT(made.output, HasSubstr("at z = 0.00 m"));
  Json project = Json::parse(std::ifstream(file), nullptr, false);
  project["bake"]["ambientRays"] = 1;
  std::ofstream(file) << project.dump(2);
  return file;
}

TEST(BenchGrowth, LeavesOutRenderersWhereTheyCannotHoldTheScene) {
  const TemporaryFolder folder("growth");
  const std::string few = projectOf(folder, "100000"), many = projectOf(folder, "20000000");
  const std::string chart = (folder.path() / "growth.svg").string();
  const std::vector<std::string> command{
      "bench", "growth", many,    few,       "--renderers", "polygons,truth",  "--path", kWalk, "--frames",
      "1",     "--size", "96x54", "--chart", chart,         "--processor-time"};
  const ProcessResult told = acentric(command);
  ASSERT_EQ(told.exitCode, 0) << told.errors;
  EXPECT_THAT(told.output, HasSubstr("left out"));
  EXPECT_THAT(told.output, HasSubstr("polygons cannot hold"));
  std::vector<std::string> asJson = command;
  asJson.push_back("--json");
  const ProcessResult reported = acentric(asJson);
  ASSERT_EQ(reported.exitCode, 0) << reported.errors;
  const Json json = Json::parse(reported.output, nullptr, false);
  ASSERT_EQ(json["projects"].size(), 2u);
  const Json &small = json["projects"][0], &large = json["projects"][1];
  EXPECT_NEAR(small["triangles"].get<double>(), 1e5, 5e3);
  EXPECT_NEAR(large["triangles"].get<double>(), 2e7, 1e6) << "all places are counted";
  EXPECT_EQ(small["renderers"].size(), 2u);
  EXPECT_TRUE(small["leftOut"].empty());
  EXPECT_EQ(large["renderers"].size(), 1u);
  ASSERT_EQ(large["leftOut"].size(), 1u);
  EXPECT_EQ(large["leftOut"][0]["renderer"], "polygons");
  for (const Json& renderer : large["renderers"])
    EXPECT_GT(renderer["processorMs"]["median"].get<double>(), 0);
  EXPECT_TRUE(json["spread"].contains("truth"));
  EXPECT_TRUE(std::filesystem::exists(chart));
}

TEST(BenchWalkGrowth, WalksThroughEachLayoutAndTellsWhatItTook) {
  const TemporaryFolder folder("walk-growth");
  const std::string chart = (folder.path() / "growth.svg").string();
  const Json json =
      jsonOf({"bench", "walk-growth", "--regions", "800,60", "--frames", "40", "--samples-per-degree", "1",
              "--size", "96x54", "--memory", "4", "--speed", "6", "--chart", chart});
  ASSERT_EQ(json["walks"].size(), 2U);
  const Json &small = json["walks"][0], &large = json["walks"][1];
  EXPECT_GE(small["regions"], 60);
  EXPECT_GE(large["regions"], 800);
  EXPECT_GT(large["pages"], small["pages"]);
  for (const Json& walk : json["walks"]) {
    EXPECT_EQ(walk["frames"], 40);
    EXPECT_GT(walk["regionsWalked"], 2);
    EXPECT_GT(walk["loads"], 0);
    EXPECT_GT(walk["evictions"], 0);
    EXPECT_GT(walk["frameMsMedian"].get<double>(), 0);
    EXPECT_GT(walk["processorMs"].get<double>(), 0);
    EXPECT_GT(walk["residentBytesPeak"].get<double>(), walk["peakBytes"].get<double>());
    EXPECT_EQ(walk["limitBytes"], 4000000);
    EXPECT_TRUE(walk["warnings"].empty()) << walk["warnings"];
  }
  EXPECT_LT(large["openBytes"].get<double>(), large["indexBytes"].get<double>() / 4);
  EXPECT_LT(large["pageRegions"], large["regions"]);
  EXPECT_TRUE(std::filesystem::exists(chart));
}

}  // namespace
}  // namespace acentric::test
