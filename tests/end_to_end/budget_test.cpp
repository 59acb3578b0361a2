/// Budgets of triangles, as a user types them.

#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

class BudgetCommandTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(project.made().exitCode, 0) << project.made().errors; }
  Json report(std::vector<std::string> arguments, int exitCode = 0) {
    arguments.push_back("--json");
    const auto result = acentric(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.errors;
    return Json::parse(result.output, nullptr, false);
  }
  std::string path(const char* name) const { return (project.folder() / name).string(); }

  SampleProject project{"budget"};
};

TEST_F(BudgetCommandTest, CountsEveryRegionAndNamesThoseOverTheBudget) {
  const Json counted = report({"budget", project.file()});
  const Json info = report({"info", project.file(), "--regions"});
  ASSERT_EQ(counted["regions"].size(), info["regions"].size());
  for (std::size_t r = 0; r < counted["regions"].size(); ++r) {
    EXPECT_EQ(counted["regions"][r]["cell"], info["regions"][r]["cell"]);
    EXPECT_EQ(counted["regions"][r]["triangles"], info["regions"][r]["localTriangles"]);
  }
  const int most = counted["most"];
  EXPECT_EQ(report({"budget", project.file(), "--max", std::to_string(most)})["over"].size(), 0u);
  const Json over =
      report({"budget", project.file(), "--max", std::to_string(most - 1), "-o", path("plan.png")});
  ASSERT_GE(over["over"].size(), 1u);
  EXPECT_EQ(over["over"][0]["triangles"], most);
  EXPECT_GT(std::filesystem::file_size(path("plan.png")), 10000u);
}

TEST_F(BudgetCommandTest, FitsCellsAndWritesThemOnlyWhenAsked) {
  const int most = report({"budget", project.file()})["most"];
  const std::string limit = std::to_string(most * 8 / 10);
  const Json before = project.read();
  const Json fitted = report({"fit", project.file(), "--max", limit, "-o", path("fit.svg")});
  EXPECT_TRUE(fitted["satisfied"].get<bool>());
  EXPECT_GE(fitted["curve"].size(), 20u);
  EXPECT_TRUE(std::filesystem::exists(path("fit.svg")));
  EXPECT_EQ(project.read(), before);
  const Json applied = report({"fit", project.file(), "--max", limit, "--apply"});
  EXPECT_TRUE(applied["applied"].get<bool>());
  EXPECT_EQ(project.read()["layout"]["cellSize"], fitted["cellSize"]);
  const Json after = report({"budget", project.file(), "--max", limit});
  EXPECT_EQ(after["most"], fitted["most"]);
  EXPECT_EQ(after["over"].size(), 0u);
}

TEST_F(BudgetCommandTest, SaysWhereNothingFits) {
  const Json before = project.read();
  const Json fitted = report({"fit", project.file(), "--max", "1", "--min-cell", "1"}, 1);
  EXPECT_FALSE(fitted["satisfied"].get<bool>());
  EXPECT_GE(fitted["over"].size(), 1u);
  EXPECT_EQ(report({"fit", project.file(), "--max", "1", "--min-cell", "1", "--apply"}, 1)["error"]["kind"],
            "invalidArgument");
  EXPECT_EQ(project.read(), before);
  EXPECT_EQ(acentric({"fit", project.file()}).exitCode, 2) << "--max is required";
  EXPECT_EQ(acentric({"budget", project.file(), "-o", path("plan.txt")}).exitCode, 1);
}

}  // namespace
}  // namespace acentric::test
