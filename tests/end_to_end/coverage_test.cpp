/// The coverage command, as a user types it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/end_to_end/sample_project.h"
#include "tests/support/scenes.h"

namespace acentric::test {
namespace {

class CoverageTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    // Laid so that there are holes enough to correlate.
    project = new SampleProject("coverage", "-6.5,-4.5;6.5,-4.5;6.5,4.5;-6.5,4.5");
    Json laid = project->read();
    laid["storeys"][0]["layout"]["latticeOrigin"] = {0, 0};
    project->write(laid);
  }
  static void TearDownTestSuite() { delete project; }
  void SetUp() override { ASSERT_EQ(project->made().exitCode, 0) << project->made().errors; }
  std::string path(const char* name) const { return (project->folder() / name).string(); }
  static std::size_t lines(const std::string& file) {
    std::ifstream in(file);
    return std::size_t(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
  }
  static inline SampleProject* project = nullptr;
};

TEST_F(CoverageTest, OfThePlanHasEachCoverHoldThePlaneOnce) {
  const auto run = acentric({"coverage", project->file(), "--plan", "--grid", "128", "-o", path("plan.svg"),
                             "--csv", path("plan.csv"), "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  double sum = 0;
  for (const Json& share : report["byCount"]) sum += share.get<double>();
  EXPECT_NEAR(sum, 1, 1e-9);
  ASSERT_EQ(report["kinds"].size(), 2u);  // rings and gap triangles
  for (const Json& kind : report["kinds"]) EXPECT_EQ(kind["coverHoldsOnce"].get<double>(), 1);
  EXPECT_GT(report["mean"].get<double>(), 1);
  EXPECT_TRUE(std::filesystem::exists(path("plan.svg")));
  const Json& grid = report["grid"];
  EXPECT_EQ(lines(path("plan.csv")),
            1 + grid["columns"].get<std::size_t>() * grid["rows"].get<std::size_t>());
}

TEST_F(CoverageTest, OfTheSurfacesAddsUp) {
  const auto run = acentric({"coverage", project->file(), "--surfaces", "--points", "500", "--eyes", "3",
                             "-o", path("surfaces.png"), "--csv", path("surfaces.csv"), "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  EXPECT_EQ(report["points"].get<int>(), 500);
  double sum = 0;
  for (const auto& [name, share] : report["all"]["shares"].items()) sum += share.get<double>();
  EXPECT_NEAR(sum, 1, 1e-9);
  // A bake this coarse samples almost every surface less densely than the display shows it.
  EXPECT_GT(report["all"]["shares"]["under"].get<double>(), 0.5);
  EXPECT_EQ(lines(path("surfaces.csv")), 501u);
  EXPECT_TRUE(std::filesystem::exists(path("surfaces.png")));
}

TEST_F(CoverageTest, ForetellsTheHolesOfRenderedFrames) {
  // With one layer, so that there are holes to foretell.
  Json shallow = Json::parse(std::ifstream(project->file()));
  shallow["bake"]["maxLayers"] = 1;
  const auto file = std::filesystem::path(project->file()).replace_filename("shallow.acentric.json").string();
  std::ofstream(file) << shallow;
  const auto baked = acentric({"bake", file, "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  const auto run = acentric({"coverage", file, "--correlate", "--frames", "12", "--size", "160x90", "--csv",
                             path("holes.csv"), "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  EXPECT_EQ(report["eyes"].get<int>(), 12);
  EXPECT_EQ(report["frames"].size(), 72u);
  EXPECT_EQ(lines(path("holes.csv")), 73u);
  EXPECT_GT(report["open"]["pearson"].get<double>(), 0.7);
  EXPECT_GT(report["open"]["spearman"].get<double>(), 0.6);
}

TEST_F(CoverageTest, ForetellsTheHolesThatPruningLeavesAtTheUsualLayers) {
  Json pruned = Json::parse(std::ifstream(project->file()));
  ASSERT_TRUE(pruned["bake"]["pruning"].get<bool>());
  ASSERT_EQ(pruned["bake"]["maxLayers"].get<int>(), 8);
  pruned["bake"]["samplesPerDegree"] = 2.5;
  pruned["bake"]["ambientRays"] = 0;
  const auto file = std::filesystem::path(project->file()).replace_filename("pruned.acentric.json").string();
  std::ofstream(file) << pruned;
  const auto baked = acentric({"bake", file, "--light", "without", "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  const auto run =
      acentric({"coverage", file, "--correlate", "--frames", "20", "--size", "160x90", "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  EXPECT_GT(report["pixels"]["holes"].get<int>(), 200) << "else there is nothing to foretell";
  EXPECT_GE(report["open"]["pearson"].get<double>(), 0.9) << report["open"];
}

class ForeseenHoles : public testing::TestWithParam<const char*> {};

TEST_P(ForeseenHoles, AreThoseOfRenderedFramesAtTheUsualSettings) {
  ACENTRIC_NEEDS_SCENES();
  const std::filesystem::path model = scenesFolder() / GetParam();
  if (!std::filesystem::exists(model)) GTEST_SKIP() << "no " << model;
  const TemporaryFolder folder("foreseen");
  const std::string file = (folder.path() / "p.acentric.json").string();
  const auto made = acentric({"new", model.string(), "-o", file, "--samples-per-degree", "2.5"});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  Json project = Json::parse(std::ifstream(file));
  project["bake"]["ambientRays"] = 0;  // light, which opens no holes
  std::ofstream(file) << project;
  const auto baked = acentric({"bake", file, "--light", "without"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  const auto run =
      acentric({"coverage", file, "--correlate", "--frames", "60", "--size", "320x180", "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  EXPECT_GT(report["pixels"]["holes"].get<int>(), 100) << "else there is nothing to foretell";
  // Of 20 million pixels a few hundred are holes, so chance has its share.
  EXPECT_GE(report["open"]["pearson"].get<double>(), 0.8) << report["open"];
  EXPECT_GE(report["open"]["spearman"].get<double>(), 0.6) << report["open"];
}

INSTANTIATE_TEST_SUITE_P(SharedScenes, ForeseenHoles, testing::Values("country_kitchen/country_kitchen.glb"),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(0, name.find('/'));
                         });

TEST_F(CoverageTest, TellsWhatPruningLosesAndHowManyEyesMorePrecisionTakes) {
  const auto run = acentric({"coverage", project->file(), "--pruning", "--json"});
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const Json report = Json::parse(run.output);
  const Json& rows = report["byLoss"];
  ASSERT_GT(rows.size(), 4u);
  EXPECT_EQ(rows[0]["mayLose"].get<double>(), 0) << "those placed evenly alone";
  EXPECT_EQ(rows[0]["eyesPerRegion"].get<double>(), report["placedEyes"].get<double>());
  for (std::size_t n = 1; n < rows.size(); ++n) {
    EXPECT_GE(rows[n]["eyesPerRegion"].get<double>(), rows[n - 1]["eyesPerRegion"].get<double>());
    EXPECT_LE(rows[n]["share"].get<double>(), rows[n]["mayLose"].get<double>());
    EXPECT_GT(rows[n]["atMost"].get<double>(), rows[n]["share"].get<double>());
  }
  EXPECT_LT(rows.back()["lost"].get<int>(), rows[0]["lost"].get<int>());
  const Json& byEyes = report["byEyes"];
  ASSERT_EQ(byEyes.size(), 4u);
  EXPECT_EQ(byEyes[3]["seenByFewerThan"].get<double>(), 1);
  EXPECT_GT(byEyes[0]["share"].get<double>(), byEyes[3]["share"].get<double>()) << "what hardly any eye sees";
  EXPECT_GT(byEyes[3]["looks"].get<int>(), byEyes[0]["looks"].get<int>());
  Json unpruned = Json::parse(std::ifstream(project->file()));
  unpruned["bake"]["pruning"] = false;
  const auto file =
      std::filesystem::path(project->file()).replace_filename("unpruned.acentric.json").string();
  std::ofstream(file) << unpruned;
  const auto none = acentric({"coverage", file, "--pruning"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_THAT(none.errors, testing::HasSubstr("nothing is lost"));
}

TEST_F(CoverageTest, SaysWhatIsWrong) {
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    const char* said;
  };
  const std::vector<Case> cases = {
      {{"coverage", path("none.acentric.json"), "--plan"}, 1, "none.acentric.json"},
      {{"coverage", project->file(), "--plan", "--surfaces"}, 1, "--plan"},
      {{"coverage", project->file(), "--correlate", "-o", path("x.png")}, 1, "--csv"},
      {{"coverage", project->file(), "--plan", "-o", path("x.txt")}, 1, "x.txt"},
      {{"coverage", project->file(), "--points", "0"}, 2, "--points"},
  };
  for (const Case& c : cases) {
    const auto result = acentric(c.arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.said << ": " << result.errors;
    EXPECT_NE((result.errors + result.output).find(c.said), std::string::npos)
        << c.said << " not in: " << result.errors;
  }
}

}  // namespace
}  // namespace acentric::test
